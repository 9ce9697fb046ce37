// SPDX-License-Identifier: BSD-3-Clause
// One object, as few superquadrics as the data allow: split while it pays.
#include "pcl_sq/fit_object.h"

#include "parts/object_piece.h"
#include "parts/outline_gaps.h"
#include "parts/whole_cloud.h"
#include "util/option_check.h"
#include "util/parallel_for.h"
#include "util/point_set.h"
#include "view_fit/view_problem.h"

#include <algorithm>
#include <array>

namespace pcl_sq {

namespace {

using namespace detail;

constexpr double MIN_GAIN = 10.0; ///< of the score, for one more part
constexpr double GOOD_FIT = 1.6;  ///< cost per observation of a part that needs no cut
constexpr double SMALL_GAIN = 0.02; ///< of the observations: the model's own error
constexpr std::size_t TRIED = 4;    ///< best cuts that are fitted in full
/** \brief Score of quick fits from which on a cut is not worth full ones: over what it
 * is to beat, and the factor over the best cut's. */
constexpr double QUICK_SLACK = 60.0, QUICK_FACTOR = 1.5;
/** \brief Share of a vessel's points off it that are no handle: more are another part,
 * such as a bottle's neck. */
constexpr double MOST_UNEXPLAINED = 0.05;
/** \brief Share of a vessel's points that may be its handle's. */
constexpr double MOST_OF_HANDLE = 0.15;
constexpr double BACK_SLACK = 0.2;  ///< behind the object's back, over its size
constexpr double BACK_SIGMA = 0.05; ///< of the object's back, over its size
/** \brief How far the best cut is moved, over half the piece's size. */
constexpr std::array<double, 4> SHIFTS = {-0.1, -0.05, 0.05, 0.1};
/** \brief Things are no superquadrics: their surface's distance to the best one, over
 * the object's size. */
constexpr double MODEL_ERROR = 0.005;
/** \brief What a depth image's neighbours share and their scatter does not show, over
 * the depth: locking to whole pixels, smoothing over the matched window. */
constexpr double SENSOR_ERROR = 7e-4;
/** \brief By how much measurements lie beside their pixels [px]: what a matching window
 * takes from its side nearer to the camera, a depth camera's lateral noise. */
constexpr double SIDEWAYS = 0.5;

struct Split {
  Cut cut;
  bool shifted = false; ///< believed of solids of revolution only: others bend to it
  Piece first, second;
  double score = 1e300;
};

bool isBareView(const ObservedObject& observed) {
  return observed.hasCamera() && observed.pixels.cells.empty();
}

double observations(const PieceContext& context, const Piece& piece) {
  return context.observed.effective_points * double(piece.points.size()) /
         double(context.observed.points.cols());
}

Split split(const PieceContext& context, const Piece& piece, const Cut& cut) {
  Split s;
  s.cut = cut;
  s.first = cutPiece(context, piece, cut);
  s.second = cutPiece(context, piece, cut.flipped());
  if (s.first.points.empty() || s.second.points.empty())
    return s;
  if (s.first.points.size() < s.second.points.size())
    std::swap(s.first, s.second);
  fitPiece(context, s.first, Effort::QUICK);
  fitPiece(context, s.second, Effort::QUICK);
  s.score = s.first.score + s.second.score;
  return s;
}

bool betterSplit(const Split& a, const Split& b) {
  return a.score < b.score;
}

/** \brief Axis that the second of two parts may share. */
const Superquadric* axisOf(const Piece& piece) {
  return piece.fit.chosen.shape == ShapeClass::ROTATIONAL ? &piece.fit.fit.model
                                                          : nullptr;
}

void fitInFull(const PieceContext& context, Split& s, const Superquadric* axis) {
  fitPiece(context, s.first, Effort::AGAIN, axis);
  fitPiece(context, s.second, Effort::AGAIN, axis ? axis : axisOf(s.first));
  s.score = s.first.score + s.second.score;
}

/** \brief Adds the best cut moved to where its two parts fit better: a bottle's
 * shoulder is as long as several of the profile's bins, and either part may have to
 * take it. */
void addShifted(const PieceContext& context,
                const Piece& piece,
                std::vector<Split>& splits) {
  const auto best = std::min_element(splits.begin(), splits.end(), betterSplit);
  if (best == splits.end() || !(best->score < 1e299))
    return;
  const double size = halfSize(context, piece);
  std::vector<Split> shifted(SHIFTS.size());
  parallelFor(SHIFTS.size(), context.options.fit.threads, [&](std::size_t i) {
    shifted[i] =
        split(context, piece, shiftedCut(context, best->cut, SHIFTS[i] * size));
    shifted[i].shifted = true;
  });
  Split& next = *std::min_element(shifted.begin(), shifted.end(), betterSplit);
  if (next.score < best->score)
    splits.push_back(std::move(next));
}

/** \brief Leaves the cuts that are worth full fits.
 * \param[in] limit what the score is to beat */
void keepPromising(std::vector<Split>& splits, double limit) {
  std::sort(splits.begin(), splits.end(), betterSplit);
  if (!splits.empty())
    limit = std::min(limit + QUICK_SLACK,
                     QUICK_FACTOR * (splits.front().score + 0.5 * QUICK_SLACK));
  while (!splits.empty() && (splits.size() > TRIED || splits.back().score > limit))
    splits.pop_back();
}

/** \brief Whether a piece's model is a body: splinters thinner than the noise and
 * needles longer than the object are none. */
bool isPart(const PieceContext& context, const Piece& piece) {
  const Eigen::Vector3d half = piece.fit.fit.model.halfSizes();
  return half.minCoeff() > context.noise &&
         half.maxCoeff() < 2.0 * context.observed.extent;
}

/** \brief The best way to cut a piece in two; score 1e300 if there is none.
 * \param[in] axis another part whose axis the two may share, or nullptr
 * \param[in] limit what the score is to beat */
Split bestSplit(const PieceContext& context,
                const Piece& piece,
                const Superquadric* axis,
                double limit) {
  const std::vector<Cut> cuts = proposeCuts(context, piece);
  std::vector<Split> splits(cuts.size());
  const unsigned int threads = context.options.fit.threads;
  parallelFor(cuts.size(), threads, [&](std::size_t i) {
    splits[i] = split(context, piece, cuts[i]);
  });
  addShifted(context, piece, splits);
  keepPromising(splits, limit);
  parallelFor(splits.size(), threads, [&](std::size_t i) {
    fitInFull(context, splits[i], axis);
  });
  Split best;
  if (standsOff(context, piece, best.first, best.second)) {
    fitPiece(context, best.first, Effort::FULL);
    fitHandle(context, best.second, piece.fit.fit.model);
    // a bottle's neck is no handle: without it the body is no vessel
    if (best.first.fit.chosen.shape == ShapeClass::VESSEL)
      best.score = best.first.score + best.second.score;
  }
  for (Split& s : splits)
    if (s.score < best.score && isPart(context, s.first) && isPart(context, s.second) &&
        (!s.shifted || (axisOf(s.first) && axisOf(s.second))))
      best = std::move(s);
  return best;
}

/** \brief What a part's points leave open behind it, the whole object's may tell: no
 * part reaches much farther from the camera than the one superquadric of all points, or
 * the one solid of revolution, for where neither fits, the free one may be too flat. */
TangentPlane backOf(const ViewFit& whole, const ObservedObject& observed) {
  TangentPlane back;
  const Superquadric& body = whole.straight().model;
  back.normal = (body.center - observed.camera.center).normalized();
  back.offset = 0.0;
  double farthest = back.residual(body);
  // bare points have no outline worth the name that would tell
  if (!observed.pixels.cells.empty())
    for (const ShapeCandidate& c : whole.candidates)
      if (c.shape == ShapeClass::ROTATIONAL)
        farthest = std::max(farthest, back.residual(c.model));
  if (whole.chosen.shape ==
      ShapeClass::VESSEL) { // a solid says nothing; nor of a handle
    farthest = std::max(farthest, back.residual(whole.chosen.model));
    for (Eigen::Index i = 0; i < observed.points.cols(); ++i)
      farthest = std::max(farthest, back.normal.dot(observed.points.col(i)));
  }
  back.offset = farthest + BACK_SLACK * observed.extent;
  back.sigma = BACK_SIGMA * observed.extent;
  return back;
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

/** \brief The solid of revolution with the most points; the number of pieces if there
 * is none. */
std::size_t largestOfRevolution(const std::vector<Piece>& pieces) {
  std::size_t largest = pieces.size();
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (axisOf(pieces[k]) && (largest == pieces.size() ||
                              pieces[k].points.size() > pieces[largest].points.size()))
      largest = k;
  return largest;
}

/** \brief Cuts pieces of an object that a camera saw while that pays. */
void splitView(const PieceContext& context,
               std::vector<Piece>& pieces,
               int wanted,
               double min_gain) {
  const bool exactly = context.options.parts > 0;
  while (int(pieces.size()) < wanted) {
    Split best;
    std::size_t which = 0;
    double gain = exactly ? -1e300 : min_gain;
    const std::size_t main = largestOfRevolution(pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Piece& piece = pieces[i];
      Piece body, handle;
      const bool good =
          piece.straight_misfit < GOOD_FIT * observations(context, piece) &&
          !standsOff(context, piece, body, handle);
      if (piece.final || (good && !exactly))
        continue;
      Split s =
          bestSplit(context,
                    piece,
                    main < pieces.size() && main != i ? axisOf(pieces[main]) : nullptr,
                    exactly ? 1e299 : piece.straight_score);
      if (piece.score - s.score > gain) {
        gain = piece.score - s.score;
        best = std::move(s);
        which = i;
      } else if (!exactly)
        piece.final = true;
    }
    if (best.score > 1e299)
      break;
    pieces[which] = best.first;
    pieces.push_back(best.second);
  }
  if (!exactly)
    mergeParts(context, pieces, min_gain);
}

/** \brief A vessel seen from all round, and its handle. \return whether it explains the
 * cloud: a bottle's body is a vessel as well, its neck is no handle */
bool fitWholeVessel(PieceContext& context, std::vector<Piece>& pieces) {
  if (pieces[0].fit.chosen.shape != ShapeClass::VESSEL)
    return false;
  // not what points on both sides of its wall seemed to have
  const double noise = context.noise;
  context.noise = std::min(
      noise,
      std::max(scatter(context, pieces[0]), MODEL_ERROR * context.observed.extent));
  Piece body, handle;
  const bool has_handle = standsOff(context, pieces[0], body, handle);
  const double all = double(pieces[0].points.size());
  if (double(handle.points.size()) > MOST_OF_HANDLE * all ||
      double(pointsOff(context, pieces[0])) - double(handle.points.size()) >
          MOST_UNEXPLAINED * all) {
    context.noise = noise;
    return false;
  }
  if (!has_handle)
    return true;
  fitHandle(context, handle, pieces[0].fit.fit.model);
  body.fit = pieces[0].fit;
  body.score = pieces[0].score;
  pieces = {std::move(body), std::move(handle)};
  return true;
}

/** \brief The parts of a whole cloud, solids all of them. */
std::vector<Piece>
splitSolids(const PieceContext& context, Piece whole, int wanted, double min_gain) {
  const bool exactly = context.options.parts > 0;
  ObjectFitOptions options = context.options;
  options.fit.vessel = false;
  const PieceContext solids{
      context.observed, options, context.noise, context.precision, context.limits};
  if (whole.fit.chosen.shape == ShapeClass::VESSEL)
    fitPiece(solids, whole, Effort::AGAIN);
  return splitWholeCloud(solids, std::move(whole), wanted, exactly, min_gain);
}

/** \brief Last fits of all parts. They share the axis of the largest solid of
 * revolution among them where the data agree: what one part's points leave open,
 * another's may tell. */
void finish(const PieceContext& context, std::vector<Piece>& pieces) {
  const std::size_t largest = largestOfRevolution(pieces);
  const auto again = [&](std::size_t k, const Superquadric* axis) {
    if (!axis && !coversFreeSpace(pieces[k]))
      return;
    Piece next = pieces[k];
    fitPiece(context, next, Effort::FINAL, axis);
    if (next.score < pieces[k].score)
      pieces[k] = std::move(next);
  };
  if (largest < pieces.size())
    again(largest, nullptr);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (k != largest)
      again(k, largest < pieces.size() ? axisOf(pieces[largest]) : nullptr);
}

/** \brief Of each point: the noise's variance over that of its own, with what slant
 * adds (M10). */
std::vector<float> precisionOf(const ObservedObject& observed, double noise) {
  std::vector<float> precision;
  if (!(noise > 0.0))
    return precision;
  for (Eigen::Index i = 0; i < observed.sideways.size(); ++i) {
    const double own =
        observed.noise.size() > 0 ? double(observed.noise[i]) / noise : 1.0;
    const double slant = SIDEWAYS * double(observed.sideways[i]) / noise;
    precision.push_back(static_cast<float>(1.0 / (own * own + slant * slant)));
  }
  return precision;
}

/** \brief What most points err by at most, where that is known. */
double medianNoise(const ObservedObject& observed) {
  std::vector<float> noise(observed.noise.data(),
                           observed.noise.data() + observed.noise.size());
  const auto middle = noise.begin() + std::ptrdiff_t(noise.size() / 2);
  std::nth_element(noise.begin(), middle, noise.end());
  return double(*middle);
}

} // namespace

bool ObjectFitOptions::isValid(std::string* why) const {
  OptionCheck check(why);
  check.inRange("max_parts", max_parts, 1, 16);
  check.inRange("parts", parts, 0, 16);
  check.inRange("silhouette_lines", silhouette_lines, 8, 360);
  check.require(fit.precision.empty(),
                "fit.precision is found by fitObject() and must be empty");
  return check.passed() && fit.isValid(why);
}

ObjectFit fitObject(const ObservedObject& observed, const ObjectFitOptions& options) {
  ObjectFit fit;
  if (spannedDimensions(observed.points) < 3)
    return fit;
  double noise = options.fit.noise;
  const bool measured = observed.noise.size() > 0;
  if (!(noise > 0.0))
    noise = measured ? medianNoise(observed)
            : observed.hasCamera()
                ? localNoise(observed.points, observed.effective_points)
                : curvedNoise(observed.points);
  PieceContext context{observed, options, 0.0, precisionOf(observed, noise), {}};
  const double min_gain = std::max(MIN_GAIN, SMALL_GAIN * observed.effective_points);
  const int wanted = options.parts > 0 ? options.parts : options.max_parts;
  const bool split = wanted > 1 && (noise > 0.0 || options.parts > 0);
  std::vector<Piece> pieces(1, wholePiece(context));
  // where parts are compared, the first fit but tells the noise; bare points of one
  // view leave the depth so open that the families must all start from there
  fitPiece(context,
           pieces[0],
           split && !isBareView(observed) ? Effort::START : Effort::FULL);
  if (!pieces[0].fit.fit.ok())
    return fit;
  if (split) {
    context.noise =
        Eigen::Vector3d(measured ? noise : std::min(noise, pieces[0].fit.noise),
                        MODEL_ERROR * observed.extent,
                        measured || observed.pixels.cells.empty()
                            ? 0.0
                            : SENSOR_ERROR * observed.depth)
            .norm();
    fitPiece(context, pieces[0], Effort::AGAIN);
    fit.misfit = pieces[0].misfit / observations(context, pieces[0]);
    if (observed.hasCamera()) {
      context.limits.push_back(backOf(pieces[0].fit, observed));
      splitView(context, pieces, wanted, min_gain);
      if (wanted >= 4 && options.parts == 0)
        openGap(context, pieces, min_gain);
    } else if (!fitWholeVessel(context, pieces))
      pieces = splitSolids(context, std::move(pieces[0]), wanted, min_gain);
    finish(context, pieces);
  }
  fit.labels.assign(std::size_t(observed.points.cols()), -1);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    fit.bic += pieces[k].score;
    fit.model.parts.push_back(pieces[k].fit.fit.model);
    addDistances(gather(context, pieces[k].points), pieces[k].fit.fit);
    fit.parts.push_back(std::move(pieces[k].fit));
    for (const int i : pieces[k].points)
      fit.labels[std::size_t(i)] = int(k);
  }
  return fit;
}

} // namespace pcl_sq
