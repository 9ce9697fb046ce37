// SPDX-License-Identifier: BSD-3-Clause
// M28: where a part of a whole cloud may be cut.
#include "parts/whole_search.h"
#include "solver/surface_area.h"
#include "tuning/parts_tuning.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::whole_search;

double scoreWith(const PieceContext& context,
                 const Description& d,
                 std::size_t k,
                 const Way& way) {
  std::vector<const Part*> parts;
  for (std::size_t i = 0; i < d.members.size(); ++i)
    if (i != k)
      parts.push_back(&d.members[i].part);
  for (const Part& p : way.parts)
    parts.push_back(&p);
  return scoreOf(context, parts);
}

/** \brief Area, a taper or bend left out [m^2]. */
double areaOf(const Superquadric& s) {
  return std::exp(logArea(s.semi_axes, s.epsilon1, s.epsilon2).value);
}

bool hasTooFewPoints(const Way& way) {
  return std::any_of(way.parts.begin(), way.parts.end(), [](const Part& p) {
    return p.piece.points.size() < MIN_POINTS;
  });
}

void keepBest(std::vector<Way>& ways, std::size_t most) {
  std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
    return a.gain > b.gain;
  });
  if (ways.size() > most)
    ways.resize(most);
}

} // namespace

/** \brief Pieces of a part: both sides of planes, its limbs, what lies off its body. */
std::vector<Way> WholeMoves::proposals(const Part& part) const {
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

/** \brief Ways to cut a part, by quick fits and what points and areas alone say of
 * them. \param[in] rest area of the other parts [m^2] */
std::vector<Way> WholeMoves::quickWays(const Part& part, double rest, int room) const {
  std::vector<Way> ways = proposals(part);
  const auto isNone = [room](const Way& way) {
    return int(way.parts.size()) > room || hasTooFewPoints(way);
  };
  ways.erase(std::remove_if(ways.begin(), ways.end(), isNone), ways.end());
  std::vector<std::pair<std::size_t, std::size_t>> fits;
  for (std::size_t w = 0; w < ways.size(); ++w)
    for (std::size_t p = 0; p < ways[w].parts.size(); ++p)
      fits.emplace_back(w, p);
  parallelFor(fits.size(), threads_, [&](std::size_t i) {
    fitPiece(plain_, ways[fits[i].first].parts[fits[i].second].piece, Effort::QUICK);
  });
  for (Way& way : ways) {
    double misfit = 0.0, area = rest;
    for (const Part& p : way.parts) {
      misfit += p.piece.misfit;
      area += areaOf(p.piece.fit.fit.model);
    }
    way.gain = -misfit - 2.0 * context_.observed.effective_points * std::log(area) -
               min_gain_ * double(way.parts.size());
  }
  keepBest(ways, SCREENED);
  return ways;
}

/** \brief Gives the ways to cut a part the points that came to it since, and takes
 * those that have left it. \return whether they were few */
bool WholeMoves::adapt(const Part& part, std::vector<Way>& ways) const {
  if (ways.empty())
    return false;
  std::vector<int> points = part.piece.points, before, gained;
  for (const Part& p : ways.front().parts)
    before.insert(before.end(), p.piece.points.begin(), p.piece.points.end());
  std::sort(points.begin(), points.end());
  std::sort(before.begin(), before.end());
  std::set_difference(points.begin(),
                      points.end(),
                      before.begin(),
                      before.end(),
                      std::back_inserter(gained));
  const std::size_t lost = before.size() + gained.size() - points.size();
  if (double(gained.size() + lost) > FEW * double(points.size()))
    return false;
  for (Way& way : ways) {
    const std::vector<std::size_t> owner = nearestParts(way.parts, gained);
    for (Part& p : way.parts) {
      std::vector<int>& own = p.piece.points;
      const auto isLost = [&points](int i) {
        return !std::binary_search(points.begin(), points.end(), i);
      };
      own.erase(std::remove_if(own.begin(), own.end(), isLost), own.end());
    }
    for (std::size_t i = 0; i < gained.size(); ++i)
      way.parts[owner[i]].piece.points.push_back(gained[i]);
  }
  ways.erase(std::remove_if(ways.begin(), ways.end(), hasTooFewPoints), ways.end());
  return true;
}

/** \brief Looks for the ways to cut a member, the best ones first. */
void WholeMoves::findWays(Description& d, std::size_t k) const {
  Member& member = d.members[k];
  if (member.is_current)
    return;
  std::vector<Way> ways;
  if (member.ways)
    ways = *member.ways;
  if (!adapt(member.part, ways)) {
    double rest = 0.0;
    for (const Member& other : d.members)
      if (&other != &member)
        rest += areaOf(other.part.piece.fit.fit.model);
    ways = quickWays(member.part, rest, wanted_ - int(d.members.size()) + 1);
  }
  parallelFor(ways.size(), threads_, [&](std::size_t w) {
    for (Part& p : ways[w].parts)
      if (!p.trace)
        traceWithinBox(plain_, p);
    ways[w].gain = d.score - scoreWith(context_, d, k, ways[w]) -
                   min_gain_ * double(ways[w].parts.size() - 1);
  });
  keepBest(ways, KEPT);
  member.ways = std::make_shared<const std::vector<Way>>(std::move(ways));
  member.is_current = true;
}

} // namespace pcl_sq::detail
