// SPDX-License-Identifier: BSD-3-Clause
#include "parts/whole_search.h"
#include "tuning/parts_tuning.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::whole_search;

ObjectFitOptions withoutFamilies(ObjectFitOptions options) {
  options.fit.taper = options.fit.bend = options.fit.vessel = false;
  return options;
}

/** \brief The best of some descriptions; score 1e300 if there is none. */
Description bestOf(std::vector<Description>& tries) {
  Description best;
  for (Description& t : tries)
    if (t.score < best.score)
      best = std::move(t);
  return best;
}

} // namespace

WholeMoves::WholeMoves(const PieceContext& context, int wanted, double min_gain)
    : context_(context),
      plain_options_(withoutFamilies(context.options)), plain_{context.observed,
                                                               plain_options_,
                                                               context.noise,
                                                               context.precision,
                                                               context.limits},
      graph_(context.observed.points), wanted_(wanted), min_gain_(min_gain),
      threads_(context.options.fit.threads) {}

double WholeMoves::score(const std::vector<Member>& members) const {
  std::vector<const Part*> parts;
  for (const Member& m : members)
    parts.push_back(&m.part);
  return scoreOf(context_, parts);
}

/** \brief Gives points to the nearest part and fits the parts again while that pays. */
void WholeMoves::settle(Description& d) const {
  d.score = score(d.members);
  for (int round = 0; round < ROUNDS && d.score < 1e299; ++round) {
    std::vector<Part> parts;
    for (const Member& m : d.members)
      parts.push_back(m.part);
    if (!assignPoints(context_, parts))
      return;
    Description next;
    next.members.resize(parts.size());
    parallelFor(parts.size(), threads_, [&](std::size_t k) {
      next.members[k] = d.members[k];
      if (parts[k].piece.points == d.members[k].part.piece.points)
        return;
      fitPart(context_, parts[k], Effort::SAME);
      next.members[k] = {std::move(parts[k]), next.members[k].ways};
    });
    next.score = score(next.members);
    if (!(next.score < d.score))
      return;
    d = std::move(next);
  }
}

void WholeMoves::askFamilies(Description& d) const {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < d.members.size() && d.score < 1e299; ++k)
    if (!d.members[k].asked)
      open.push_back(k);
  std::vector<Part> again(open.size());
  parallelFor(open.size(), threads_, [&](std::size_t i) {
    again[i] = d.members[open[i]].part;
    fitPart(context_, again[i], Effort::AGAIN);
  });
  bool changed = false;
  for (std::size_t i = 0; i < open.size(); ++i) {
    Member& member = d.members[open[i]];
    member.asked = true;
    std::swap(member.part, again[i]);
    const double with = score(d.members);
    if (with < d.score) {
      d.score = with;
      member.is_current = false;
      changed = true;
    } else
      std::swap(member.part, again[i]);
  }
  if (changed)
    settle(d);
}

std::vector<Description> WholeMoves::cutOnce(Description& d) const {
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
         (choices.size() > tuning::whole_search::TRIED ||
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
      fitPart(context_, member.part, Effort::UNBENT);
      if (p == 0)
        members[c.member] = std::move(member);
      else
        members.push_back(std::move(member));
    }
    tries[i].score = score(members);
  });
  std::map<std::size_t, double> least; // by the number of parts: more explain more
  for (const Description& t : tries) {
    double& known = least.emplace(t.members.size(), 1e299).first->second;
    known = std::min(known, t.score);
  }
  parallelFor(tries.size(), threads_, [&](std::size_t i) {
    if (tries[i].score < least.at(tries[i].members.size()) + QUICK_SLACK)
      settle(tries[i]);
  });
  std::vector<Description> best;
  for (const auto& entry : least) {
    best.emplace_back();
    for (Description& t : tries)
      if (t.members.size() == entry.first && t.score < best.back().score)
        best.back() = std::move(t);
    askFamilies(best.back());
  }
  return best;
}

/** \brief Two members that become one; the same one twice: it is left out. */
struct WholeMoves::Join {
  std::size_t a, b;
  Part part; ///< the two as one, quickly fitted
  double score = 1e300;
};

/** \brief The best joins of neighbours, by quick fits. */
std::vector<WholeMoves::Join> WholeMoves::joinsOf(const Description& d) {
  std::vector<Join> joins;
  for (std::size_t i = 0; i < d.members.size(); ++i)
    for (std::size_t j = i; j < d.members.size(); ++j)
      if (i == j ||
          graph_.touch(d.members[i].part.piece.points, d.members[j].part.piece.points))
        joins.push_back({i, j, {}, 1e300});
  const auto key = [&](const Join& join) {
    return std::make_pair(traceNumber(d.members[join.a].part),
                          traceNumber(d.members[join.b].part));
  };
  parallelFor(joins.size(), threads_, [&](std::size_t t) {
    Join& join = joins[t];
    std::vector<const Part*> parts;
    for (std::size_t i = 0; i < d.members.size(); ++i)
      if (i != join.a && i != join.b)
        parts.push_back(&d.members[i].part);
    if (join.a != join.b) {
      const auto known = known_.find(key(join));
      if (known != known_.end())
        join.part = known->second;
      else {
        join.part.piece =
            mergePieces(d.members[join.a].part.piece, d.members[join.b].part.piece);
        fitPart(plain_, join.part, Effort::QUICK);
      }
      parts.push_back(&join.part);
    }
    join.score = scoreOf(context_, parts);
  });
  for (const Join& join : joins)
    if (join.a != join.b)
      known_.emplace(key(join), join.part);
  std::stable_sort(joins.begin(), joins.end(), [](const Join& x, const Join& y) {
    return x.score < y.score;
  });
  if (joins.size() > tuning::whole_search::TRIED)
    joins.erase(joins.begin() + tuning::whole_search::TRIED, joins.end());
  return joins;
}

Description WholeMoves::joined(const Description& d, const Join& join) const {
  Description next = d;
  next.members.erase(next.members.begin() + std::ptrdiff_t(join.b));
  if (join.a != join.b) {
    next.members[join.a] = {join.part, nullptr};
    fitPart(context_, next.members[join.a].part, Effort::UNBENT);
  } else {
    std::vector<Part> parts;
    for (const Member& m : next.members)
      parts.push_back(m.part);
    const std::vector<int>& points = d.members[join.a].part.piece.points;
    const std::vector<std::size_t> owner = nearestParts(parts, points);
    for (std::size_t i = 0; i < owner.size(); ++i)
      parts[owner[i]].piece.points.push_back(points[i]);
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (parts[k].piece.points.size() != next.members[k].part.piece.points.size()) {
        fitPart(context_, parts[k], Effort::SAME);
        next.members[k] = {std::move(parts[k]), next.members[k].ways};
      }
  }
  settle(next);
  return next;
}

Description WholeMoves::mergeOnce(const Description& d) {
  const std::vector<Join> joins = joinsOf(d);
  std::vector<Description> tries(joins.size());
  parallelFor(joins.size(), threads_, [&](std::size_t t) {
    if (joins[t].score < 1e299)
      tries[t] = joined(d, joins[t]);
  });
  Description best = bestOf(tries);
  askFamilies(best);
  return best;
}

} // namespace pcl_sq::detail
