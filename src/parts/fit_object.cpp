// SPDX-License-Identifier: BSD-3-Clause
// One object, as few superquadrics as the data allow: split while it pays.
#include "pcl_sq/fit_object.h"

#include "geometry/open_body.h"
#include "observe/sheets.h"
#include "outlines/outline_gaps.h"
#include "outlines/stalk.h"
#include "parts/split_view.h"
#include "parts/union_score.h"
#include "parts/verdict.h"
#include "parts/whole_search.h"
#include "tuning/parts_tuning.h"
#include "util/option_check.h"
#include "util/point_set.h"
#include "view_fit/search_view.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace {

using namespace detail;

using namespace tuning::fit_object;

bool isBareView(const ObservedObject& observed) {
  return observed.hasCamera() && observed.pixels.cells.empty();
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

/** \brief A vessel seen from all round, and its handle. \return whether it explains the
 * cloud: a bottle's body is a vessel as well, its neck is no handle */
bool fitWholeVessel(PieceContext& context, std::vector<Piece>& pieces) {
  if (pieces[0].fit.chosen.shape != ShapeClass::VESSEL ||
      covered(context, pieces[0].fit.fit.model) < MOSTLY)
    return false;
  // not what points on both sides of its wall seemed to have
  const double noise = context.noise;
  context.noise = std::min(
      noise,
      std::max(scatter(context, pieces[0]), MODEL_ERROR * context.observed.extent));
  Piece body, handle;
  const bool has_handle = standsOff(context, pieces[0], body, handle);
  const double all = double(pieces[0].points.size());
  PieceContext rough = context; // feet and rims thicker than the wall are no parts
  rough.noise = std::max(context.noise, FOOT * context.observed.extent);
  if (double(handle.points.size()) > MOST_OF_HANDLE * all ||
      double(pointsOff(rough, pieces[0])) - double(handle.points.size()) >
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

/** \brief The parts of a whole cloud, solids all of them.
 * \param[in] points_noise without the model's error [m] */
std::vector<Piece> splitSolids(const PieceContext& context,
                               double points_noise,
                               Piece whole,
                               int wanted,
                               double min_gain) {
  const bool exactly = context.options.parts > 0;
  ObjectFitOptions options = context.options;
  options.fit.vessel = false;
  PieceContext solids{
      context.observed, options, context.noise, context.precision, context.limits};
  // whoever names a largest number asks for the detail that so many tell
  if (options.max_parts == 0 || exactly) {
    solids.noise = std::max(context.noise, COARSE_ERROR * context.observed.extent);
    // what the points' own noise leaves of sigma is the model's error, and no evidence
    const double systematic = 1.0 - std::pow(points_noise / solids.noise, 2);
    min_gain = std::max(min_gain,
                        systematic * COARSE_GAIN * context.observed.effective_points);
  }
  Part one;
  one.piece = std::move(whole);
  traceAgain(solids, one);
  const bool is_solid = one.piece.fit.chosen.shape != ShapeClass::VESSEL;
  if (is_solid && !exactly && !mayBeCut(solids, one, min_gain))
    return {std::move(one.piece)}; // as finely fitted as it can be
  whole = std::move(one.piece);
  fitPiece(solids, whole, Effort::AGAIN);
  std::vector<Piece> pieces =
      splitWholeCloud(solids, std::move(whole), wanted, exactly, min_gain);
  solids.noise = context.noise;
  refineParts(solids, pieces);
  return pieces;
}

/** \brief Last fits of all parts. They share the axis of the largest solid of
 * revolution among them where the data agree: what one part's points leave open,
 * another's may tell. */
void finish(const PieceContext& context, std::vector<Piece>& pieces) {
  const std::size_t largest = largestOfRevolution(pieces);
  const auto again = [&](std::size_t k, const Superquadric* axis) {
    // of a bent handle fitHandle() knows more than its points tell
    const bool is_handle =
        !pieces[k].stands && pieces[k].fit.chosen.shape == ShapeClass::BENT;
    if (is_handle || (!axis && !coversFreeSpace(pieces[k])))
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

MultiSuperquadric modelOf(const std::vector<Piece>& pieces) {
  MultiSuperquadric model;
  for (const Piece& piece : pieces)
    model.parts.push_back(piece.fit.fit.model);
  return model;
}

/** \brief Goes back to one superquadric where parts make a model that is not to be
 * handed out, and that is: of a thing that is half hidden, parts may each follow a
 * scrap of what is seen. */
void takeWholeIfBetter(const PieceContext& context,
                       const Piece& whole,
                       std::vector<Piece>& pieces) {
  const auto isRefused = [&](const std::vector<Piece>& of) {
    double noise = 0.0;
    for (const Piece& piece : of)
      noise = std::max(noise, piece.fit.fit.sigma);
    return !judge(modelOf(of), context.observed, noise).objection().empty();
  };
  if (pieces.size() < 2 || !isRefused(pieces))
    return;
  std::vector<Piece> one(1, whole);
  finish(context, one);
  if (!isRefused(one))
    pieces = std::move(one);
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
  check.inRange("max_parts", max_parts, 0, 64);
  check.inRange("parts", parts, 0, 64);
  check.inRange("silhouette_lines", silhouette_lines, 8, 360);
  check.require(fit.precision.empty(),
                "fit.precision is found by fitObject() and must be empty");
  return check.passed() && fit.isValid(why);
}

ObjectFit fitObject(const ObservedObject& observed, const ObjectFitOptions& asked) {
  ObjectFit fit;
  if (spannedDimensions(observed.points) < 3)
    return fit;
  ObjectFitOptions options = asked;
  ObservedObject::Surface surface;
  if (!observed.hasCamera()) {
    surface = observed.surface ? *observed.surface : surfaceOf(observed.points);
    options.fit.vessel = options.fit.vessel && surface.two_sided;
  }
  double noise = options.fit.noise;
  const bool measured = observed.noise.size() > 0;
  if (!(noise > 0.0))
    noise = measured ? medianNoise(observed)
            : observed.hasCamera()
                ? localNoise(observed.points, observed.effective_points)
                : surface.noise;
  PieceContext context{
      observed, options, 0.0, precisionOf(observed, noise), {}, pixelStep(observed)};
  const double min_gain = std::max(MIN_GAIN, SMALL_GAIN * observed.effective_points);
  const int wanted = options.parts > 0       ? options.parts
                     : options.max_parts > 0 ? options.max_parts
                     : observed.hasCamera()  ? MOST_IN_VIEW
                                             : MOST_ALL_ROUND;
  // a whole cloud sampled from flat faces has none
  const bool split =
      wanted > 1 && (noise > 0.0 || options.parts > 0 || !observed.hasCamera());
  std::vector<Piece> pieces(1, wholePiece(context));
  // where parts are compared, the first fit but tells the noise; bare points of one
  // view leave the depth so open that the families must all start from there
  fitPiece(context,
           pieces[0],
           split && !isBareView(observed) ? Effort::START : Effort::FULL);
  if (!pieces[0].fit.fit.ok())
    return fit;
  if (split) {
    const double points_noise = measured ? noise : std::min(noise, pieces[0].fit.noise);
    context.noise = Eigen::Vector3d(points_noise,
                                    MODEL_ERROR * observed.extent,
                                    measured || observed.pixels.cells.empty()
                                        ? 0.0
                                        : SENSOR_ERROR * observed.depth)
                        .norm();
    if (observed.hasCamera())
      fitPiece(context, pieces[0], Effort::AGAIN);
    else { // beyond the points of all sides there is nothing
      Part whole;
      whole.piece = std::move(pieces[0]);
      fitPart(context, whole, Effort::AGAIN);
      pieces[0] = std::move(whole.piece);
    }
    fit.misfit = pieces[0].misfit / observations(context, pieces[0]);
    if (observed.hasCamera()) {
      const Piece whole = pieces[0];
      context.limits.push_back(backOf(pieces[0].fit, observed));
      splitView(context, pieces, wanted, min_gain);
      if (wanted >= 4 && options.parts == 0)
        openGap(context, pieces, min_gain);
      finish(context, pieces);
      if (options.parts == 0)
        addStalks(context, pieces, wanted);
      if (options.parts == 0)
        takeWholeIfBetter(context, whole, pieces);
    } else if (!fitWholeVessel(context, pieces))
      pieces =
          splitSolids(context, points_noise, std::move(pieces[0]), wanted, min_gain);
  }
  fit.labels.assign(std::size_t(observed.points.cols()), -1);
  for (Piece& piece : pieces)
    piece.fit.fit.model = withRimNearTop(piece.fit.fit.model);
  fit.model = modelOf(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    fit.bic += pieces[k].score;
    addDistances(gather(context, pieces[k].points), pieces[k].fit.fit);
    fit.parts.push_back(std::move(pieces[k].fit));
    for (const int i : pieces[k].points)
      fit.labels[std::size_t(i)] = int(k);
  }
  return fit;
}

} // namespace pcl_sq
