// SPDX-License-Identifier: BSD-3-Clause
#include "parts/object_piece.h"

#include "parts/body_outline.h"
#include "pcl_sq/line_intersection.h"
#include "view_fit/plane_cost.h"
#include "view_fit/view_problem.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MIN_POINTS = 24;
constexpr int QUICK_STARTS = 4;
constexpr std::size_t PIXEL_SAMPLE = 4000;
/** \brief How well a cut says where a part ends, over the part's size: parts overlap.
 */
constexpr double END_SIGMA = 0.25;
/** \brief Largest cost of one contradiction: -2 ln of an outlier's density over the
 * Gaussian's peak, as for the points. */
constexpr double MAX_COST = 9.2;
/** \brief How far parts stick out where the object is hollow, over its size: what is no
 * superquadric cannot be followed closer. */
constexpr double FREE_SIGMA = 0.03;
/** \brief Largest exponent of a part that a cut ends: composite things are made of
 * cans, boxes and balls. A pinched part follows errors of its points, and its hidden
 * side comes out too flat. */
constexpr double PART_EPSILON = 1.0;
/** \brief How far from a cut the outline may be the joint's or the other part's, over
 * the part's size: shoulders are round, and cuts are not placed better than that. A
 * line that touches what is left of a bottle's shoulder makes its neck as wide. */
constexpr double JOINT = 0.15;
constexpr int FREE_ROUNDS = 3;        ///< of holding the model off the free pixels
constexpr double WORTH_A_ROUND = 6.0; ///< cost of covered free pixels

double halfDiagonal(const Eigen::Matrix3Xd& points) {
  return 0.5 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/** \brief Whether a piece reaches the table: its lowest points are on it, or nobody
 * saw that it ends before. \param[in] whole whether it is all of the object */
bool reachesTable(const PieceContext& context,
                  const Eigen::Matrix3Xd& points,
                  bool whole) {
  if (!context.observed.table)
    return false;
  if (whole && context.observed.hidden_below)
    return true;
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    heights.push_back(context.observed.table->height(points.col(i)));
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 33);
  std::nth_element(heights.begin(), low, heights.end());
  // the lowest visible points of a body lie somewhat above its bottom's far edge
  return *low <
         0.18 * context.observed.extent + 3.0 * context.noise + context.observed.foot;
}

/** \brief Free pixels that a model covers. */
struct Covered {
  double cost = 0.0;
  /** \brief Planes through the rays that part them from the body: a convex body misses
   * a line exactly if there is one. */
  std::vector<TangentPlane> limits;
};

/** \brief A point of a ray well inside a body. \return false if the ray misses it */
bool insideOnRay(const Superquadric& body,
                 const Eigen::Vector3d& from,
                 const Eigen::Vector3d& ray,
                 Eigen::Vector3d& inside) {
  LineInterval chord;
  if (!intersectLineBox(body, from, ray, chord) ||
      !intersectLine(body, from, ray, chord))
    return false;
  // the middle of the chord lies about where the ray comes nearest to the centre
  inside = from + 0.5 * (chord.enter + chord.leave) * ray;
  return true;
}

/** \brief M11. */
Covered coveredFreeSpace(const PieceContext& context, const Superquadric& body) {
  const ObservedObject& o = context.observed;
  const double pixel = o.depth / std::sqrt(o.camera.fx * o.camera.fy); // [m]
  const double sigma = std::max(o.outline_sigma * pixel, FREE_SIGMA * o.extent);
  Covered covered;
  // beyond the outline of a body that is not plain no costly search along the ray
  const BodyOutline outline =
      body.isPlain() ? BodyOutline() : BodyOutline(body, o.camera.center, 24);
  for (const Eigen::Vector2d& p : o.free_space) {
    const Eigen::Vector3d ray = o.camera.ray(p);
    if (outline.misses(ray))
      continue;
    Eigen::Vector3d inside;
    if (!insideOnRay(body, o.camera.center, ray, inside))
      continue;
    TangentPlane limit;
    limit.normal = body.isCut()
                       ? body.gaugeGradient(inside)
                       : body.rotation * -body.logGaugeJacobian(inside).head<3>();
    limit.normal -= limit.normal.dot(ray) * ray;
    if (!(limit.normal.norm() > 1e-9))
      continue;
    limit.normal.normalize();
    limit.offset = limit.normal.dot(inside);
    limit.sigma = sigma / std::sqrt(o.free_weight);
    const double z = limit.residual(body) / sigma;
    covered.cost += o.free_weight * std::min(z * z, MAX_COST);
    covered.limits.push_back(limit);
  }
  return covered;
}

double hingeCost(const std::vector<TangentPlane>& limits, const Superquadric& body) {
  double cost = 0.0;
  for (const TangentPlane& limit : limits)
    cost += std::pow(std::max(0.0, limit.residual(body)) / limit.sigma, 2);
  return cost;
}

/** \brief Sine of the angle of a pixel's ray above a plane through the camera's centre:
 * the ray itself would have to be turned into the world first. */
class AngleAbove {
public:
  AngleAbove(const PinholeCamera& camera, const Eigen::Vector3d& normal)
      : normal_(camera.rotation.transpose() * normal), center_(camera.cx, camera.cy),
        per_pixel_(1.0 / camera.fx, 1.0 / camera.fy) {}
  double operator()(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d d = (pixel - center_).cwiseProduct(per_pixel_);
    return (normal_.head<2>().dot(d) + normal_.z()) / std::sqrt(d.squaredNorm() + 1.0);
  }

private:
  Eigen::Vector3d normal_;
  Eigen::Vector2d center_, per_pixel_;
};

/** \brief Width of the strip at a cut in which a piece has no outline of its own; the
 * sine of its angle. */
double stripWidth(const ObservedObject& o) {
  return (o.outline == OutlineSource::POINTS ? 0.8 * o.outline_sigma : 2.0) /
         std::sqrt(o.camera.fx * o.camera.fy);
}

/** \brief A piece's outline without its joints to other pieces. */
std::vector<ContourPoint>
outlineBesideJoints(const ObservedObject& o, const Piece& piece, double size) {
  if (!o.hasCamera() || piece.ends.empty())
    return piece.contour;
  const double joint = JOINT * size / o.depth;
  std::vector<AngleAbove> angles;
  for (const TangentPlane& end : piece.ends)
    angles.emplace_back(o.camera, -end.normal);
  const auto beyondJoints = [&](const Eigen::Vector2d& pixel) {
    double nearest = 1e300;
    for (const AngleAbove& angle : angles)
      nearest = std::min(nearest, angle(pixel) - joint);
    return nearest;
  };
  std::vector<ContourPoint> contour;
  for (const ContourPoint& p : piece.contour)
    if (beyondJoints(p.pixel) > 0.0)
      contour.push_back(p);
  const double strip = stripWidth(o);
  for (const Eigen::Vector2d& p : piece.pixels) {
    const double side = beyondJoints(p);
    if (side > 0.0 && side < strip) {
      ContourPoint foreign;
      foreign.pixel = p;
      foreign.own = false;
      contour.push_back(foreign);
    }
  }
  return contour;
}

} // namespace

Eigen::Matrix3Xd gather(const PieceContext& context, const std::vector<int>& columns) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = context.observed.points.col(columns[i]);
  return points;
}

Piece wholePiece(const PieceContext& context) {
  Piece piece;
  for (Eigen::Index i = 0; i < context.observed.points.cols(); ++i)
    piece.points.push_back(static_cast<int>(i));
  piece.contour = context.observed.contour;
  const CellMask& mask = context.observed.pixels;
  const CellRect box = boundingRect(mask);
  const int step = std::max(
      1, static_cast<int>(std::sqrt(double(mask.count()) / double(PIXEL_SAMPLE))));
  const auto onGrid = [step](int from) { return (from + step - 1) / step * step; };
  for (int y = onGrid(box.y); y < box.y + box.height; y += step)
    for (int x = onGrid(box.x); x < box.x + box.width; x += step)
      if (mask.cells[mask.indexOf(x, y)])
        piece.pixels.emplace_back(x, y);
  if (context.observed.hasCamera() && piece.pixels.empty())
    for (const ContourPoint& p : context.observed.contour)
      piece.pixels.push_back(p.pixel);
  return piece;
}

double halfSize(const PieceContext& context, const Piece& piece) {
  return halfDiagonal(gather(context, piece.points));
}

Cut shiftedCut(const PieceContext& context, const Cut& cut, double distance) {
  const ObservedObject& o = context.observed;
  if (!o.hasCamera())
    return {cut.normal, cut.offset + distance};
  const Eigen::Vector3d towards = o.points.rowwise().mean() - o.camera.center;
  const Eigen::Vector3d normal =
      (cut.normal - distance / towards.squaredNorm() * towards).normalized();
  return {normal, normal.dot(o.camera.center)};
}

Piece cutPiece(const PieceContext& context, const Piece& piece, const Cut& cut) {
  Piece part;
  const ObservedObject& o = context.observed;
  for (const int i : piece.points)
    if (cut.side(o.points.col(i)) > 0.0)
      part.points.push_back(i);
  if (part.points.size() < MIN_POINTS)
    return {};
  if (o.hasCamera()) {
    const AngleAbove angle(o.camera, cut.normal);
    for (const ContourPoint& p : piece.contour)
      if (angle(p.pixel) > 0.0)
        part.contour.push_back(p);
    const double near = stripWidth(o);
    for (const Eigen::Vector2d& p : piece.pixels) {
      const double side = angle(p);
      if (side <= 0.0)
        continue;
      part.pixels.push_back(p);
      // where the object goes on beyond the cut, the piece has no outline
      if (side < near) {
        ContourPoint foreign;
        foreign.pixel = p;
        foreign.own = false;
        part.contour.push_back(foreign);
      }
    }
  }
  part.ends = piece.ends;
  part.stands = piece.stands;
  TangentPlane end;
  end.normal = -cut.normal;
  end.offset = -cut.offset;
  end.sigma = END_SIGMA * halfDiagonal(gather(context, part.points));
  part.ends.push_back(end);
  return part;
}

void fitPiece(const PieceContext& context,
              Piece& piece,
              Effort effort,
              const Superquadric* coaxial) {
  const ObservedObject& o = context.observed;
  const Eigen::Matrix3Xd points = gather(context, piece.points);
  const double share = double(points.cols()) / double(o.points.cols());
  ViewFitOptions options = context.options.fit;
  if (!o.pixels.cells.empty() && !piece.ends.empty())
    options.max_epsilon = std::min(options.max_epsilon, PART_EPSILON);
  options.noise = context.noise;
  options.effective_points = std::max(12.0, share * o.effective_points);
  options.max_semi_axis = 1.5 * halfDiagonal(points);
  options.precision.clear(); // fitObject() knows it of each point, see isValid()
  if (!context.precision.empty())
    for (const int i : piece.points)
      options.precision.push_back(context.precision[std::size_t(i)]);
  const bool general = effort == Effort::QUICK || effort == Effort::START;
  options.choose_shape = options.choose_shape && !general;
  options.vessel = options.vessel && piece.stands; // a handle is none
  options.taper = options.taper && piece.stands;   // nor is it a cone
  options.all_points = !o.hasCamera() && !general;
  if (coaxial)
    options.coaxial = *coaxial;
  if (effort == Effort::QUICK)
    options.starts = QUICK_STARTS;
  if ((effort == Effort::AGAIN || effort == Effort::FINAL) && piece.fit.fit.ok())
    options.start = piece.fit.straight().model;
  ViewEvidence evidence =
      o.evidence(outlineBesideJoints(o, piece, halfDiagonal(points)),
                 context.options.silhouette_lines,
                 piece.stands && reachesTable(context, points, piece.ends.empty()));
  evidence.tangents.insert(
      evidence.tangents.end(), piece.ends.begin(), piece.ends.end());
  evidence.limits.insert(
      evidence.limits.end(), context.limits.begin(), context.limits.end());
  const double price = std::log(1.0 + o.effective_points); // of a parameter
  const auto assess = [&](ViewFit fit, double hinges) {
    Piece assessed;
    assessed.fit = std::move(fit);
    if (!assessed.fit.fit.ok())
      return assessed;
    assessed.covered = coveredFreeSpace(context, assessed.fit.fit.model).cost;
    assessed.misfit = assessed.fit.chosen.cost - hinges + assessed.covered;
    assessed.score = assessed.misfit -
                     (assessed.fit.chosen.on_axis ? SHARED_AXIS : 0.0) +
                     (assessed.fit.chosen.shape == ShapeClass::TAPERED  ? TAPER
                      : assessed.fit.chosen.shape == ShapeClass::VESSEL ? VESSEL
                                                                        : 0.0) +
                     assessed.fit.chosen.parameters * price -
                     0.5 * double(evidence.silhouette.size());
    assessed.straight_misfit = assessed.misfit;
    assessed.straight_score = assessed.score;
    if (assessed.fit.chosen.shape == ShapeClass::TAPERED) {
      const ShapeCandidate &tapered = assessed.fit.chosen,
                           &straight = assessed.fit.straight();
      assessed.straight_misfit += straight.cost - tapered.cost;
      assessed.straight_score += straight.cost - tapered.cost - TAPER -
                                 (tapered.parameters - straight.parameters) * price;
    }
    return assessed;
  };
  Piece best = assess(searchView(points, evidence, options), 0.0);
  const int rounds = effort == Effort::FINAL ? FREE_ROUNDS : 0;
  for (int round = 0; round < rounds && best.fit.fit.ok(); ++round) {
    if (!coversFreeSpace(best))
      break;
    const Covered covered = coveredFreeSpace(context, best.fit.fit.model);
    ViewEvidence more = evidence;
    more.limits.insert(more.limits.end(), covered.limits.begin(), covered.limits.end());
    options.start = best.fit.straight().model;
    ViewFit next = searchView(points, more, options);
    const double hinges = hingeCost(covered.limits, next.fit.model);
    Piece assessed = assess(std::move(next), hinges);
    if (!(assessed.score < best.score))
      break;
    best = std::move(assessed);
  }
  piece.fit = std::move(best.fit);
  piece.covered = best.covered;
  piece.misfit = best.misfit;
  piece.score = best.score;
  piece.straight_misfit = best.straight_misfit;
  piece.straight_score = best.straight_score;
}

bool coversFreeSpace(const Piece& piece) {
  return piece.covered >= WORTH_A_ROUND;
}

Piece mergePieces(const Piece& a, const Piece& b) {
  Piece merged;
  merged.stands = a.stands || b.stands;
  merged.points = a.points;
  merged.points.insert(merged.points.end(), b.points.begin(), b.points.end());
  merged.pixels = a.pixels;
  merged.pixels.insert(merged.pixels.end(), b.pixels.begin(), b.pixels.end());
  const auto add = [&merged](const Piece& from, const Piece& other) {
    for (const ContourPoint& p : from.contour) {
      const bool inner =
          !p.own && std::any_of(other.pixels.begin(),
                                other.pixels.end(),
                                [&](const Eigen::Vector2d& q) {
                                  return (q - p.pixel).squaredNorm() < 10.0;
                                });
      if (!inner)
        merged.contour.push_back(p);
    }
  };
  add(a, b);
  add(b, a);
  // an end that one of the two goes beyond is none
  for (const Piece* from : {&a, &b})
    for (const TangentPlane& end : from->ends) {
      const Piece& other = from == &a ? b : a;
      if (end.residual(other.fit.fit.model) < 0.5 * end.sigma)
        merged.ends.push_back(end);
    }
  return merged;
}

} // namespace pcl_sq::detail
