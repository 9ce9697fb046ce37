// SPDX-License-Identifier: BSD-3-Clause
// Which patches are one thing: what one body explains better than two, and what cannot
// stand by itself.
#include "patches/one_body.h"
#include "patches/patch_graph.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace pcl_sq::detail {

namespace {

constexpr double BULGE = -0.2; ///< the same, of an edge that one thing alone has
/** \brief The same where no body need explain both: printed things of many colours are
 * alike in the mean. */
constexpr double ONE_COLOR = 0.75;
constexpr double OVERLAP = 0.9; ///< of a footprint's radius: in each other's place
/** \brief The same of two round bodies of one size that touch is 2 over the square root
 * of 2; a body's own parts are nearer. */
constexpr double BESIDE = 1.2;

class Joiner : private PatchGraph {
public:
  Joiner(const SceneView& view, Patches patches)
      : PatchGraph(view, std::move(patches)) {}

  std::vector<Patch> run() {
    joinScraps();
    joinOverlapping();
    joinBulging();
    joinBodies();
    joinInterrupted();
    joinOverlapping();
    joinInLine();
    joinFloating();
    std::vector<Patch> things;
    for (Patch& patch : list_)
      if (!patch.pixels.empty())
        things.push_back(std::move(patch));
    return things;
  }

private:
  void join(int from, int into) {
    PatchGraph::join(from, into);
    for (auto it = scores_.begin(); it != scores_.end();)
      it = it->first.first == into || it->first.second == into ||
                   it->first.first == from || it->first.second == from
               ? scores_.erase(it)
               : std::next(it);
  }

  /** \brief Small patches join the neighbour whose colour is nearest, rather not across
   * a fold. */
  void joinScraps() {
    for (bool joined = true; joined;) {
      joined = false;
      double best = 1e300;
      int from = -1, into = -1;
      for (const auto& [pair, border] : borders_) {
        const std::size_t a = list_[std::size_t(pair.first)].pixels.size();
        const std::size_t b = list_[std::size_t(pair.second)].pixels.size();
        if (std::min(a, b) >= SCRAP || std::min(a, b) == 0 || !touches(border))
          continue;
        const double off = colorDistance(list_[std::size_t(pair.first)].sums,
                                         list_[std::size_t(pair.second)].sums) +
                           std::max(0.0, border.meanFold()) / CREASE;
        if (off < best) {
          best = off;
          from = a < b ? pair.first : pair.second;
          into = a < b ? pair.second : pair.first;
        }
      }
      if (from >= 0) {
        join(from, into);
        joined = true;
      }
    }
  }

  /** \brief Whether two patches touch, or are of one colour and one place. */
  bool areNear(int a, int b) const {
    const auto border = borders_.find({a, b});
    const bool contact = border != borders_.end() && touches(border->second);
    return contact || offset(a, b) < OVERLAP || (sameColor(a, b) && offset(a, b) < 1.0);
  }

  /** \brief Whether nothing is seen that would part two patches of one colour which one
   * body explains: a step in depth, which convex bodies do not have, or the background
   * beside neither, but that a vessel's rim is before. */
  bool isUnparted(std::pair<int, int> pair, const BodyScore& both) const {
    if (both.is_vessel)
      return true;
    if (isStep(pair))
      return false;
    return areNear(pair.first, pair.second) || !between(view_,
                                                        list_[std::size_t(pair.first)],
                                                        list_[std::size_t(pair.second)])
                                                    .background;
  }

  /** \brief Pairs that one body may explain: near each other, or of one colour. */
  std::vector<std::pair<int, int>> candidates() const {
    std::vector<std::pair<int, int>> pairs;
    for (int a = 0; a < int(list_.size()); ++a)
      for (int b = a + 1; b < int(list_.size()); ++b) {
        if (std::min(list_[std::size_t(a)].pixels.size(),
                     list_[std::size_t(b)].pixels.size()) < SCRAP)
          continue;
        if (areNear(a, b) || sameColor(a, b, ONE_COLOR) || mayShareRim(a, b))
          pairs.emplace_back(a, b);
      }
    return pairs;
  }

  /** \brief Joins pieces of one colour, the larger one given first, while any two are
   * one thing. */
  void joinAlike(const std::function<bool(int, int)>& areOne) {
    for (bool joined = true; joined;) {
      joined = false;
      for (int a = 0; a < int(list_.size()) && !joined; ++a)
        for (int b = 0; b < int(list_.size()) && !joined; ++b)
          if (a != b && alive(a) && alive(b) &&
              list_[std::size_t(a)].pixels.size() >=
                  list_[std::size_t(b)].pixels.size() &&
              sameColor(a, b, ONE_COLOR) && areOne(a, b)) {
            join(b, a);
            joined = true;
          }
    }
  }

  /** \brief Pieces where two bodies would overlap, such as the inside and the outside
   * of a bowl. */
  void joinOverlapping() {
    joinAlike([&](int a, int b) { return offset(a, b) < OVERLAP; });
  }

  /** \brief Pieces between which nothing is seen but what hides their middle, or
   * nothing at all and they are too near to be two. */
  void joinInterrupted() {
    joinAlike([&](int a, int b) {
      const Between gap = between(view_, list_[std::size_t(a)], list_[std::size_t(b)]);
      return !gap.background && !gap.apart_above &&
             (gap.hidden || offset(a, b) <= BESIDE);
    });
  }

  /** \brief Patches that meet in an edge that bulges to the camera, such as a box's
   * sides or a can's and its lid: two things leave a step or a groove. */
  void joinBulging() {
    for (bool joined = true; joined;) {
      joined = false;
      double best = BULGE;
      std::pair<int, int> which;
      for (const auto& [pair, border] : borders_)
        if (touches(border) && alive(pair.first) && alive(pair.second) &&
            isWide(pair, border.pairs - border.jumps) && border.meanFold() < best) {
          best = border.meanFold();
          which = pair;
          joined = true;
        }
      if (joined)
        join(which.second, which.first);
    }
  }

  void joinBodies() {
    for (;;) {
      const std::vector<std::pair<int, int>> pairs = candidates();
      std::vector<std::pair<int, int>> fresh;
      const auto demand = [&](std::pair<int, int> pair) {
        if (scores_.emplace(pair, BodyScore()).second)
          fresh.push_back(pair);
      };
      for (const auto& pair : pairs) {
        demand(pair);
        demand({pair.first, pair.first});
        demand({pair.second, pair.second});
      }
      parallelFor(fresh.size(), view_.threads, [&](std::size_t i) {
        std::vector<int> pixels = list_[std::size_t(fresh[i].first)].pixels;
        const std::vector<int>& more = list_[std::size_t(fresh[i].second)].pixels;
        if (fresh[i].first != fresh[i].second)
          pixels.insert(pixels.end(), more.begin(), more.end());
        scores_.find(fresh[i])->second = scoreOfBody(view_, pixels);
      });
      double best = 0.0;
      std::pair<int, int> which{-1, -1};
      for (const auto& pair : pairs)
        if (const double gain = gainOfOneBody(scores_.at({pair.first, pair.first}),
                                              scores_.at({pair.second, pair.second}),
                                              scores_.at(pair)) +
                                flush(pair);
            gain > best && isUnparted(pair, scores_.at(pair))) {
          best = gain;
          which = pair;
        }
      if (which.first < 0)
        return;
      join(which.second, which.first);
    }
  }

  /** \brief What goes on in a lower patch, such as a bottle above its label. */
  void joinInLine() {
    for (bool joined = true; joined;) {
      joined = false;
      for (int a = 0; a < int(list_.size()) && !joined; ++a)
        for (int b = 0; b < int(list_.size()) && !joined; ++b)
          if (a != b && alive(a) && alive(b) && !stands(list_[std::size_t(a)]) &&
              goesOnIn(a, b)) {
            join(a, b);
            joined = true;
          }
    }
  }

  /** \brief What does not reach the table belongs to what carries it. */
  void joinFloating() {
    for (;;) {
      double best = 1e300;
      int from = -1, into = -1;
      for (int a = 0; a < int(list_.size()); ++a) {
        if (!alive(a) || stands(list_[std::size_t(a)]) || isCarried(a) ||
            isHiddenBelow(a))
          continue;
        for (int b = 0; b < int(list_.size()); ++b) {
          if (b == a || !alive(b) ||
              list_[std::size_t(b)].low > list_[std::size_t(a)].low)
            continue;
          const double d = apart(a, b);
          if (d < best) {
            best = d;
            from = a;
            into = b;
          }
        }
      }
      if (from < 0)
        return;
      join(from, into);
    }
  }

  /** \brief Of two patches together; of one where both are the same. */
  std::map<std::pair<int, int>, BodyScore> scores_;
};

} // namespace

std::vector<Patch> joinPatches(const SceneView& view, Patches patches) {
  return Joiner(view, std::move(patches)).run();
}

} // namespace pcl_sq::detail
