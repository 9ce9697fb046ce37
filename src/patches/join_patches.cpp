// SPDX-License-Identifier: BSD-3-Clause
// Which patches are one thing: what one body explains better than two, and what cannot
// stand by itself.
#include "patches/one_body.h"
#include "patches/patches.h"
#include "sensor/observation.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t SCRAP = 150;  ///< pixels too few for a body of their own
constexpr double JUMPS = 0.5;       ///< of a border, at which it is an edge in depth
constexpr int LEAST_BORDER = 3;     ///< pairs of pixels that make a contact
constexpr double SAME_COLOR = 1.5;  ///< of colorDistance()
constexpr double CREASE = 0.35;     ///< mean angle of a fold that may part things [rad]
constexpr double BULGE = -0.2;      ///< the same, of an edge that one thing alone has
constexpr double CORRELATION = 7.0; ///< pixels that share their errors
/** \brief The same where no body need explain both: printed things of many colours are
 * alike in the mean. */
constexpr double ONE_COLOR = 0.75;
constexpr double WIDE = 0.5;    ///< of a patch's width, where its surface goes on
constexpr double STANDS = 3.0;  ///< standing heights: lower, and it reaches the table
constexpr double OVERLAP = 0.9; ///< of a footprint's radius: in each other's place
/** \brief The same of two round bodies of one size that touch is 2 over the square root
 * of 2; a body's own parts are nearer. */
constexpr double BESIDE = 1.2;
/** \brief Of a carrying thing's pixels, that show the face on which another stands, and
 * standing heights within which that is level. */
constexpr double LEDGE = 0.15, LEVEL = 2.0;
constexpr double AS_LARGE = 0.5; ///< over the carrying thing's pixels
constexpr double NEAR = 0.5;     ///< of the larger thing's size: belongs to it

class Joiner {
public:
  Joiner(const SceneView& view, Patches patches)
      : view_(view), list_(std::move(patches.list)),
        borders_(std::move(patches.borders)) {}

  std::vector<Patch> run() {
    joinScraps();
    joinOverlapping();
    joinBulging();
    joinBodies();
    joinInterrupted();
    joinOverlapping();
    joinFloating();
    std::vector<Patch> things;
    for (Patch& patch : list_)
      if (!patch.pixels.empty())
        things.push_back(std::move(patch));
    return things;
  }

private:
  bool alive(int k) const { return !list_[std::size_t(k)].pixels.empty(); }
  bool stands(const Patch& p) const {
    return p.low < STANDS * standingHeight(view_.table, p.sums.mean().z());
  }

  void join(int from, int into) {
    Patch& a = list_[std::size_t(into)];
    Patch& b = list_[std::size_t(from)];
    a.pixels.insert(a.pixels.end(), b.pixels.begin(), b.pixels.end());
    a.sums.add(b.sums);
    a.low = std::min(a.low, b.low);
    a.high = std::max(a.high, b.high);
    b.pixels.clear();
    std::map<std::pair<int, int>, Border> borders;
    for (const auto& [pair, border] : borders_) {
      const int i = pair.first == from ? into : pair.first;
      const int j = pair.second == from ? into : pair.second;
      if (i == j)
        continue;
      borders[std::minmax(i, j)].add(border);
    }
    borders_.swap(borders);
    for (auto it = scores_.begin(); it != scores_.end();)
      it = it->first.first == into || it->first.second == into ||
                   it->first.first == from || it->first.second == from
               ? scores_.erase(it)
               : std::next(it);
  }

  static bool touches(const Border& border) {
    return border.pairs >= LEAST_BORDER && border.jumps < JUMPS * border.pairs;
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

  /** \brief Pairs that one body may explain: they touch, or are of one colour and one
   * place. */
  std::vector<std::pair<int, int>> candidates() const {
    std::vector<std::pair<int, int>> pairs;
    for (int a = 0; a < int(list_.size()); ++a)
      for (int b = a + 1; b < int(list_.size()); ++b) {
        if (std::min(list_[std::size_t(a)].pixels.size(),
                     list_[std::size_t(b)].pixels.size()) < SCRAP)
          continue;
        const auto border = borders_.find({a, b});
        const bool contact = border != borders_.end() && touches(border->second);
        if (contact || offset(a, b) < OVERLAP ||
            (sameColor(a, b) && offset(a, b) < 1.0))
          pairs.emplace_back(a, b);
      }
    return pairs;
  }

  bool sameColor(int a, int b, double limit = SAME_COLOR) const {
    return colorDistance(list_[std::size_t(a)].sums, list_[std::size_t(b)].sums) <
           limit;
  }

  /** \brief Distance of two footprints over the larger one's radius. */
  double offset(int a, int b) const {
    const Footprint fa = footprintOf(view_.table, list_[std::size_t(a)]);
    const Footprint fb = footprintOf(view_.table, list_[std::size_t(b)]);
    return (fa.middle - fb.middle).norm() / std::max(fa.radius, fb.radius);
  }

  /** \brief Joins pieces of one colour, the larger one given first, while any two are
   * one thing. */
  void joinAlike(const std::function<bool(int, int)>& areOne) {
    for (bool joined = view_.colors.cols() > 0; joined;) {
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
      return !gap.background && (gap.hidden || offset(a, b) <= BESIDE);
    });
  }

  /** \brief Whether two patches meet along a good share of the smaller one's width. */
  bool isWide(std::pair<int, int> pair, const Border& border) const {
    const std::size_t least = std::min(list_[std::size_t(pair.first)].pixels.size(),
                                       list_[std::size_t(pair.second)].pixels.size());
    return double(border.pairs - border.jumps) > WIDE * std::sqrt(double(least));
  }

  /** \brief Evidence for one thing where the surface goes on from one patch to the
   * other: of two things that meet, each place where neighbours' errors differ would
   * have to be flush by chance. */
  double flush(std::pair<int, int> pair) const {
    const auto found = borders_.find(pair);
    if (found == borders_.end())
      return 0.0;
    const Border& border = found->second;
    if (!touches(border) || !isWide(pair, border) || border.meanFold() >= CREASE)
      return 0.0;
    return 2.0 * std::log(0.5 * M_PI / CREASE) * (border.pairs - border.jumps) /
           CORRELATION;
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
            isWide(pair, border) && border.meanFold() < best) {
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
            gain > best) {
          best = gain;
          which = pair;
        }
      if (which.first < 0)
        return;
      join(which.second, which.first);
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

  /** \brief Whether a patch stands on a ledge of another thing: a level face at its
   * foot that shows beside it. A lid or a cap leaves none. */
  bool isCarried(int a) const {
    const Patch& thing = list_[std::size_t(a)];
    if (thing.pixels.size() < SCRAP || isThin(thing.pixels, view_.width, view_.height))
      return false;
    const double slack = LEVEL * standingHeight(view_.table, thing.sums.mean().z());
    for (int b = 0; b < int(list_.size()); ++b) {
      const auto border = borders_.find(std::minmax(a, b));
      if (b == a || !alive(b) || border == borders_.end() || !touches(border->second) ||
          (view_.colors.cols() > 0 && sameColor(a, b)))
        continue;
      const std::vector<int>& pixels = list_[std::size_t(b)].pixels;
      const auto level = std::count_if(pixels.begin(), pixels.end(), [&](int c) {
        return std::abs(view_.table.height(view_.at(c)) - thing.low) < slack;
      });
      if (double(level) > std::max(double(SCRAP), LEDGE * double(pixels.size())) ||
          double(thing.pixels.size()) > AS_LARGE * double(pixels.size()))
        return true;
    }
    return false;
  }

  /** \brief Whether a patch ends at another thing before it, lower down, which may hide
   * its foot. */
  bool isHiddenBelow(int a) const {
    const Patch& thing = list_[std::size_t(a)];
    for (const auto& [pair, border] : borders_) {
      if ((pair.first != a && pair.second != a) || touches(border) ||
          border.pairs < LEAST_BORDER || thing.pixels.size() < SCRAP)
        continue;
      const int b = pair.first == a ? pair.second : pair.first;
      const Patch& other = list_[std::size_t(b)];
      if (alive(b) && stands(other) && !sameColor(a, b) &&
          other.sums.mean().z() < thing.sums.mean().z())
        return view_.colors.cols() > 0;
    }
    return false;
  }

  /** \brief How far a floating patch is from another, in sizes; infinite out of reach.
   */
  double apart(int a, int b) const {
    const auto border = borders_.find(std::minmax(a, b));
    const double color =
        colorDistance(list_[std::size_t(a)].sums, list_[std::size_t(b)].sums);
    if (border != borders_.end() && touches(border->second))
      return 0.1 * color / double(border->second.pairs);
    const double gap = offset(a, b);
    if (color > SAME_COLOR || gap > 1.0 + NEAR)
      return 1e300;
    return 1.0 + gap + color;
  }

  const SceneView& view_;
  std::vector<Patch> list_;
  std::map<std::pair<int, int>, Border> borders_;
  /** \brief Of two patches together; of one where both are the same. */
  std::map<std::pair<int, int>, BodyScore> scores_;
};

} // namespace

std::vector<Patch> joinPatches(const SceneView& view, Patches patches) {
  return Joiner(view, std::move(patches)).run();
}

} // namespace pcl_sq::detail
