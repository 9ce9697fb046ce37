// SPDX-License-Identifier: BSD-3-Clause
#include "parts/split_view.h"

#include "tuning/parts_tuning.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <array>

namespace pcl_sq::detail {

namespace {

using namespace tuning::split_view;
using namespace tuning::part;
/** \brief How far the best cut is moved, over half the piece's size. */
constexpr std::array<double, 4> SHIFTS = {-0.1, -0.05, 0.05, 0.1};

struct Split {
  Cut cut;
  bool shifted = false; ///< believed of solids of revolution only: others bend to it
  bool final = false;   ///< all families were tried
  Piece first{}, second{};
  double score = 1e300;
};

/** \brief Score of a piece without a bend: a bent rod goes through the tops of two
 * balls, and hides for the time being that they are two. */
double unbent(const Piece& piece) {
  return piece.fit.chosen.shape == ShapeClass::BENT ? piece.straight_score
                                                    : piece.score;
}

/** \brief A cut and quick fits of its parts; score 1e300 where that exceeds \a most. */
Split split(const PieceContext& context,
            const Piece& piece,
            const Cut& cut,
            double most) {
  Split s{cut};
  s.first = cutPiece(context, piece, cut);
  s.second = cutPiece(context, piece, cut.flipped());
  if (s.first.points.empty() || s.second.points.empty())
    return s;
  if (s.first.points.size() < s.second.points.size())
    std::swap(s.first, s.second);
  fitPiece(context, s.first, Effort::QUICK);
  // the second part's score is no less than minus half the outline's lines
  if (s.first.score - 0.5 * context.options.silhouette_lines > most)
    return s;
  fitPiece(context, s.second, Effort::QUICK);
  s.score = s.first.score + s.second.score;
  return s;
}

bool betterSplit(const Split& a, const Split& b) {
  return a.score < b.score;
}

/** \brief Fits the parts of a cut by the straight families, which rank cuts. Bare
 * points of one view leave the depth so open that all must be compared. */
void fitInFull(const PieceContext& context, Split& s, const Superquadric* axis) {
  s.final = context.observed.pixels.cells.empty();
  const Effort effort = s.final ? Effort::AGAIN : Effort::STRAIGHT;
  fitPiece(context, s.first, effort, axis);
  fitPiece(context, s.second, effort, axis ? axis : axisOf(s.first));
  s.score = unbent(s.first) + unbent(s.second);
}

/** \brief Adds the best cut moved to where its two parts fit better: a bottle's
 * shoulder is as long as several of the profile's bins, and either may take it. */
void addShifted(const PieceContext& context,
                const Piece& piece,
                double most,
                std::vector<Split>& splits) {
  const auto best = std::min_element(splits.begin(), splits.end(), betterSplit);
  if (best == splits.end() || !(best->score < most))
    return;
  const double size = halfSize(context, piece);
  std::vector<Split> shifted(SHIFTS.size());
  parallelFor(SHIFTS.size(), context.options.fit.threads, [&](std::size_t i) {
    const Cut cut = shiftedCut(context, best->cut, SHIFTS[i] * size);
    shifted[i] = split(context, piece, cut, best->score);
    shifted[i].shifted = true;
  });
  Split& next = *std::min_element(shifted.begin(), shifted.end(), betterSplit);
  if (next.score < best->score)
    splits.push_back(std::move(next));
}

/** \brief Leaves the cuts that are worth full fits, of scores up to \a most. */
void keepPromising(std::vector<Split>& splits, double most) {
  std::sort(splits.begin(), splits.end(), betterSplit);
  if (!splits.empty())
    most = std::min(most, QUICK_FACTOR * (splits.front().score + 0.5 * QUICK_SLACK));
  while (!splits.empty() &&
         (splits.size() > tuning::split_view::TRIED || splits.back().score > most))
    splits.pop_back();
}

/** \brief Fits the two parts of a cut with more families than before, with bends where
 * those left something unexplained, and takes what explains them better. */
void fitBetter(const PieceContext& context,
               Split& s,
               Effort effort,
               const Superquadric* axis) {
  const auto again = [&](Piece& piece, const Superquadric* shared) {
    if (effort == Effort::AGAIN &&
        !(piece.misfit > tuning::family::MISFIT * observations(context, piece)))
      return;
    Piece next = piece;
    fitPiece(context, next, effort, shared);
    if (next.score < piece.score)
      piece = std::move(next);
  };
  again(s.first, axis);
  again(s.second, axis ? axis : axisOf(s.first));
  s.score = unbent(s.first) + unbent(s.second);
}

/** \brief Whether a piece's model is a body: splinters thinner than the noise and
 * needles longer than the object are none. */
bool isPart(const PieceContext& context, const Piece& piece) {
  const Eigen::Vector3d half = piece.fit.fit.model.halfSizes();
  return half.minCoeff() > context.noise &&
         half.maxCoeff() < 2.0 * context.observed.extent;
}

/** \brief The best way to cut a piece in two; score 1e300 if there is none.
 * \param[in] axis of another part, or nullptr \param[in] limit what it is to beat */
Split bestSplit(const PieceContext& context,
                const Piece& piece,
                const Superquadric* axis,
                double limit) {
  Split best;
  if (standsOff(context, piece, best.first, best.second)) {
    fitPiece(context, best.first, Effort::FULL);
    fitHandle(context, best.second, piece.fit.fit.model);
    // a bottle's neck is no handle: without it the body is no vessel
    if (best.first.fit.chosen.shape == ShapeClass::VESSEL)
      best.score = best.first.score + best.second.score;
    best.final = true;
  }
  // with a handle it is already as good as that
  const double most = std::min(limit, best.score) + QUICK_SLACK;
  const std::vector<Cut> cuts = proposeCuts(context, piece);
  std::vector<Split> splits(cuts.size());
  parallelFor(cuts.size(), context.options.fit.threads, [&](std::size_t i) {
    splits[i] = split(context, piece, cuts[i], most);
  });
  addShifted(context, piece, most, splits);
  keepPromising(splits, most);
  parallelFor(splits.size(), context.options.fit.threads, [&](std::size_t i) {
    fitInFull(context, splits[i], axis);
  });
  for (Split& s : splits)
    if (s.score < best.score && isPart(context, s.first) && isPart(context, s.second) &&
        (!s.shifted || (axisOf(s.first) && axisOf(s.second))))
      best = std::move(s);
  if (!best.final && best.score < 1e299)
    fitBetter(context, best, Effort::UNBENT, axis);
  return best;
}

/** \brief A piece that was cut, and where its two parts are. */
struct Parting {
  Piece whole;
  std::size_t first, second;
};

/** \brief Joins again what did not pay in the end, from the last cut to the first. The
 * first of two cuts that pay together may pay only against a straight body: a dumbbell
 * is a worse pair than a bent rod, and better as three. */
void takeBack(const std::vector<Parting>& partings,
              std::vector<Piece>& pieces,
              double min_gain) {
  std::vector<double> score(pieces.size());
  std::vector<std::size_t> belongs_to(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    score[k] = pieces[k].score;
    belongs_to[k] = k;
  }
  std::vector<bool> gone(pieces.size(), false);
  for (auto p = partings.rbegin(); p != partings.rend(); ++p) {
    const bool pays = p->whole.score - (score[p->first] + score[p->second]) > min_gain;
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (belongs_to[k] == p->first || belongs_to[k] == p->second) {
        belongs_to[k] = p->first;
        gone[k] = gone[k] || (!pays && k != p->first);
      }
    if (pays) {
      score[p->first] += score[p->second];
      continue;
    }
    pieces[p->first] = p->whole;
    score[p->first] = p->whole.score;
  }
  for (std::size_t k = pieces.size(); k-- > 0;)
    if (gone[k])
      pieces.erase(pieces.begin() + std::ptrdiff_t(k));
}

/** \brief Merges pairs of parts while one explains them as well as two. */
void mergeParts(const PieceContext& context,
                std::vector<Piece>& pieces,
                double min_gain) {
  while (pieces.size() > 2) {
    double best = -min_gain;
    std::size_t first = 0, second = 0;
    Piece chosen;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t j = i + 1; j < pieces.size(); ++j) {
        Piece merged = mergePieces(pieces[i], pieces[j]);
        fitPiece(context, merged, Effort::QUICK);
        const double gain = pieces[i].score + pieces[j].score - merged.score;
        if (gain > best) {
          best = gain;
          first = i;
          second = j;
          chosen = std::move(merged);
        }
      }
    if (chosen.points.empty())
      return;
    fitPiece(context, chosen, Effort::FULL);
    pieces[first] = std::move(chosen);
    pieces.erase(pieces.begin() + std::ptrdiff_t(second));
  }
}

} // namespace

double observations(const PieceContext& context, const Piece& piece) {
  return context.observed.effective_points * double(piece.points.size()) /
         double(context.observed.points.cols());
}

const Superquadric* axisOf(const Piece& piece) {
  return piece.fit.chosen.shape == ShapeClass::ROTATIONAL ? &piece.fit.fit.model
                                                          : nullptr;
}

std::size_t largestOfRevolution(const std::vector<Piece>& pieces) {
  std::size_t largest = pieces.size();
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (axisOf(pieces[k]) && (largest == pieces.size() ||
                              pieces[k].points.size() > pieces[largest].points.size()))
      largest = k;
  return largest;
}

void splitView(const PieceContext& context,
               std::vector<Piece>& pieces,
               int wanted,
               double min_gain) {
  const bool exactly = context.options.parts > 0;
  std::vector<Parting> partings;
  while (int(pieces.size()) < wanted) {
    Split best;
    std::size_t which = 0;
    double gain = exactly ? -1e300 : min_gain;
    const std::size_t main = largestOfRevolution(pieces);
    const auto axisFor = [&](std::size_t i) {
      return main < pieces.size() && main != i ? axisOf(pieces[main]) : nullptr;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Piece& piece = pieces[i];
      Piece body, handle;
      const double explained = GOOD_FIT * observations(context, piece);
      const bool good =
          piece.straight_misfit < explained && !standsOff(context, piece, body, handle);
      if (piece.final || (good && !exactly))
        continue;
      const double whole =
          exactly || piece.misfit < explained ? piece.score : unbent(piece);
      // the two may be tapered in the end as well, but are to pay without a bend
      const double limit = piece.fit.fit.model.isBent() ? whole : piece.straight_score;
      Split s = bestSplit(context, piece, axisFor(i), exactly ? 1e299 : limit);
      if (whole - s.score > gain) {
        gain = whole - s.score;
        best = std::move(s);
        which = i;
      } else if (!exactly)
        piece.final = true;
    }
    if (best.score > 1e299)
      break;
    if (!best.final)
      fitBetter(context, best, Effort::AGAIN, axisFor(which));
    partings.push_back({pieces[which], which, pieces.size()});
    pieces[which] = best.first;
    pieces.push_back(best.second);
  }
  if (exactly)
    return;
  takeBack(partings, pieces, min_gain);
  mergeParts(context, pieces, min_gain);
}

} // namespace pcl_sq::detail
