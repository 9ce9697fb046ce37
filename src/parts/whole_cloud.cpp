// SPDX-License-Identifier: BSD-3-Clause
#include "parts/whole_cloud.h"

#include "parts/union_score.h"
#include "tuning/parts_tuning.h"
#include "util/cloud_graph.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::whole_cloud;

/** \brief Parts that may take another's place, quickly fitted. */
struct Way {
  std::vector<Part> parts;
  double gain = -1e300; ///< of the score, by quick fits
};

/** \brief A part and the ways to cut it, once they have been looked for. */
struct Member {
  Part part;
  std::shared_ptr<const std::vector<Way>> ways;
};

/** \brief A description of the object and its score, smaller is better. */
struct Description {
  std::vector<Member> members;
  double score = 1e300;
};

/** \brief M28: the search for the description that costs least. */
class WholeSearch {
public:
  WholeSearch(const PieceContext& context, int wanted, bool exactly, double min_gain)
      : context_(context), graph_(context.observed.points), wanted_(wanted),
        exactly_(exactly), min_gain_(min_gain), threads_(context.options.fit.threads) {}

  std::vector<Piece> run(Part whole);

private:
  double score(const std::vector<Member>& members) const {
    std::vector<const Part*> parts;
    for (const Member& m : members)
      parts.push_back(&m.part);
    return scoreOf(context_, parts);
  }
  double scoreWith(const Description& d, std::size_t k, const Way& way) const {
    std::vector<const Part*> parts;
    for (std::size_t i = 0; i < d.members.size(); ++i)
      if (i != k)
        parts.push_back(&d.members[i].part);
    for (const Part& p : way.parts)
      parts.push_back(&p);
    return scoreOf(context_, parts);
  }
  std::vector<Way> proposals(const Part& part) const;
  void findWays(Description& d, std::size_t k) const;
  void settle(Description& d) const;
  Description step(Description& d) const;
  bool mergeOnce(Description& d) const;

  const PieceContext& context_;
  CloudGraph graph_;
  int wanted_;
  bool exactly_;
  double min_gain_;
  unsigned int threads_;
};

/** \brief Pieces of a part: both sides of planes, its limbs, what lies off its body. */
std::vector<Way> WholeSearch::proposals(const Part& part) const {
  std::vector<Way> ways;
  for (const Cut& cut : proposeCuts(context_, part.piece)) {
    Way way;
    for (const Cut& side : {cut, cut.flipped()}) {
      way.parts.emplace_back();
      way.parts.back().piece = cutPiece(context_, part.piece, side);
    }
    ways.push_back(std::move(way));
  }
  const auto add = [&](const std::vector<Segment>& segments) {
    Way way;
    for (const Segment& s : segments) {
      way.parts.emplace_back();
      way.parts.back().piece.points = s;
    }
    ways.push_back(std::move(way));
  };
  const Segment& points = part.piece.points;
  for (const auto& segments :
       graph_.limbs(points, part.piece.fit.fit.model.rotation, MIN_POINTS))
    add(segments);
  Segment off, on;
  for (const int i : points)
    (std::abs(distanceOf(part, i)) > OFF * context_.noise ? off : on).push_back(i);
  std::vector<Segment> residual;
  for (Segment& component : graph_.components(off))
    if (component.size() >= MIN_POINTS)
      residual.push_back(std::move(component));
    else
      on.insert(on.end(), component.begin(), component.end());
  if (!residual.empty() && on.size() >= MIN_POINTS) {
    residual.push_back(on);
    add(residual);
  }
  return ways;
}

/** \brief Looks for the ways to cut a member, the best ones first. */
void WholeSearch::findWays(Description& d, std::size_t k) const {
  Member& member = d.members[k];
  if (member.ways)
    return;
  std::vector<Way> ways = proposals(member.part);
  const auto room = std::size_t(std::max(0, wanted_ - int(d.members.size()) + 1));
  ways.erase(std::remove_if(ways.begin(),
                            ways.end(),
                            [&](const Way& way) {
                              return way.parts.size() > room ||
                                     std::any_of(way.parts.begin(),
                                                 way.parts.end(),
                                                 [](const Part& p) {
                                                   return p.piece.points.size() <
                                                          MIN_POINTS;
                                                 });
                            }),
             ways.end());
  std::vector<std::pair<std::size_t, std::size_t>> fits;
  for (std::size_t w = 0; w < ways.size(); ++w)
    for (std::size_t p = 0; p < ways[w].parts.size(); ++p)
      fits.emplace_back(w, p);
  parallelFor(fits.size(), threads_, [&](std::size_t i) {
    fitPart(context_, ways[fits[i].first].parts[fits[i].second], Effort::QUICK);
  });
  parallelFor(ways.size(), threads_, [&](std::size_t w) {
    ways[w].gain = d.score - scoreWith(d, k, ways[w]);
  });
  std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
    return a.gain > b.gain;
  });
  if (ways.size() > KEPT)
    ways.resize(KEPT);
  member.ways = std::make_shared<const std::vector<Way>>(std::move(ways));
}

/** \brief Gives points to the nearest part and fits the parts again while that pays. */
void WholeSearch::settle(Description& d) const {
  d.score = score(d.members);
  for (int round = 0; round < ROUNDS && d.score < 1e299; ++round) {
    std::vector<Part> parts;
    for (const Member& m : d.members)
      parts.push_back(m.part);
    if (!assignPoints(context_, parts))
      return;
    Description next;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      next.members.push_back(d.members[k]);
      if (parts[k].piece.points != d.members[k].part.piece.points) {
        fitPart(context_, parts[k], Effort::AGAIN);
        next.members.back() = {std::move(parts[k]), nullptr};
      }
    }
    next.score = score(next.members);
    if (!(next.score < d.score))
      return;
    d = std::move(next);
  }
}

/** \brief The best description with one of the members cut; score 1e300 if none can
 * be. */
Description WholeSearch::step(Description& d) const {
  struct Choice {
    std::size_t member, way;
    double gain;
  };
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < d.members.size(); ++k) {
    findWays(d, k);
    for (std::size_t w = 0; w < d.members[k].ways->size(); ++w) {
      const Way& way = (*d.members[k].ways)[w];
      if (way.gain > -1e299 && int(d.members.size() + way.parts.size()) <= wanted_ + 1)
        choices.push_back({k, w, way.gain});
    }
  }
  std::stable_sort(choices.begin(),
                   choices.end(),
                   [](const Choice& a, const Choice& b) { return a.gain > b.gain; });
  while (!choices.empty() &&
         (choices.size() > TRIED ||
          choices.back().gain < choices.front().gain - 4.0 * QUICK_SLACK))
    choices.pop_back();
  std::vector<Description> tries(choices.size());
  parallelFor(choices.size(), threads_, [&](std::size_t i) {
    const Choice& c = choices[i];
    std::vector<Member>& members = tries[i].members;
    members = d.members;
    const std::vector<Part>& parts = (*d.members[c.member].ways)[c.way].parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Member member{parts[p], nullptr};
      fitPart(context_, member.part, Effort::AGAIN);
      if (p == 0)
        members[c.member] = std::move(member);
      else
        members.push_back(std::move(member));
    }
    tries[i].score = score(members);
  });
  double least = 1e299;
  for (const Description& t : tries)
    least = std::min(least, t.score);
  parallelFor(tries.size(), threads_, [&](std::size_t i) {
    if (tries[i].score < least + QUICK_SLACK)
      settle(tries[i]);
  });
  Description best;
  for (Description& t : tries)
    if (t.score < best.score)
      best = std::move(t);
  return best;
}

/** \brief Makes two neighbours one where that costs less than the gain of one more
 * part. \return whether it did */
bool WholeSearch::mergeOnce(Description& d) const {
  std::vector<Description> tries;
  for (std::size_t i = 0; i < d.members.size(); ++i)
    for (std::size_t j = i + 1; j < d.members.size(); ++j) {
      const Piece &a = d.members[i].part.piece, &b = d.members[j].part.piece;
      if (!graph_.touch(a.points, b.points))
        continue;
      Description next = d;
      next.members[i].part.piece = mergePieces(a, b);
      next.members[i].ways = nullptr;
      next.members.erase(next.members.begin() + std::ptrdiff_t(j));
      next.score = double(i);
      tries.push_back(std::move(next));
    }
  Description best;
  std::vector<std::size_t> merged(tries.size());
  parallelFor(tries.size(), threads_, [&](std::size_t t) {
    merged[t] = std::size_t(tries[t].score);
    fitPart(context_, tries[t].members[merged[t]].part, Effort::QUICK);
    tries[t].score = score(tries[t].members);
    if (tries[t].score > d.score + min_gain_ + QUICK_SLACK) {
      tries[t].score = 1e300;
      return;
    }
    fitPart(context_, tries[t].members[merged[t]].part, Effort::FULL);
    settle(tries[t]);
  });
  for (Description& t : tries)
    if (t.score < best.score)
      best = std::move(t);
  if (!(best.score < d.score + min_gain_))
    return false;
  d = std::move(best);
  return true;
}

std::vector<Piece> WholeSearch::run(Part whole) {
  Description now;
  now.members.emplace_back();
  now.members[0].part = std::move(whole);
  now.score = score(now.members);
  Description best = now;
  const auto worth = [&](const Description& d) { // with the price of its parts
    return d.score + min_gain_ * double(d.members.size());
  };
  int idle = 0;
  while (int(now.members.size()) < wanted_) {
    Description next = step(now);
    if (next.members.empty() || !(next.score < 1e299))
      break;
    now = std::move(next);
    if (exactly_ || worth(now) < worth(best)) {
      best = now;
      idle = 0;
    } else if (++idle >= PATIENCE)
      break;
  }
  while (!exactly_ && best.members.size() > 1 && mergeOnce(best)) {
  }
  std::vector<Piece> pieces;
  for (Member& m : best.members)
    pieces.push_back(std::move(m.part.piece));
  return pieces;
}

} // namespace

std::vector<Piece> splitWholeCloud(const PieceContext& context,
                                   Piece whole,
                                   int wanted,
                                   bool exactly,
                                   double min_gain) {
  Part one;
  one.piece = std::move(whole);
  traceAgain(context, one);
  const double price =
      min_gain + FEWEST_PARAMETERS * std::log(1.0 + context.observed.effective_points);
  if (!exactly && mostGain(context, one) < price)
    return {std::move(one.piece)};
  return WholeSearch(context, wanted, exactly, min_gain).run(std::move(one));
}

} // namespace pcl_sq::detail
