// SPDX-License-Identifier: BSD-3-Clause
#include "grasp/measured_surface.h"

#include "grasp/closing_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int WITNESSES = 6; ///< fewer do not tell a plane from their noise

} // namespace

MeasuredSurface::MeasuredSurface(const MultiSuperquadric& object,
                                 const GraspScene& scene,
                                 const GraspPlannerOptions& options)
    : object_(object), scene_(scene), options_(options), about_(object.boundingBox()) {
  about_.min().array() -= options.cloud_tolerance;
  about_.max().array() += options.cloud_tolerance;
  if (scene.cloud.cols() == 0)
    return;
  sortCloud();
  if (scene.has_viewpoint)
    takePicture();
}

void MeasuredSurface::sortCloud() {
  std::vector<Eigen::Vector3d> about;
  for (Eigen::Index i = 0; i < scene_.cloud.cols(); ++i)
    if (isAbout(scene_.cloud.col(i)))
      about.push_back(scene_.cloud.col(i));
  // neighbours go together: distances to a body are costly, and their mean has less
  // noise than a point
  const PointGrid cells(std::move(about), 0.5 * options_.observed_distance);
  std::vector<Eigen::Vector3d> own, places;
  std::vector<Witness> said;
  cells.eachCell([&](std::size_t first, std::size_t last) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t i = first; i < last; ++i)
      mean += cells.points()[i] / double(last - first);
    Witness witness;
    const bool is_objects = belongs(mean, witness);
    for (std::size_t i = first; i < last; ++i)
      (is_objects ? own : others_).push_back(cells.points()[i]);
    if (is_objects && bearsWitness(mean, witness)) {
      places.push_back(mean);
      said.push_back(witness);
    }
  });
  callWitnesses(std::move(places), said);
  own_ = PointGrid(
      PointGrid(std::move(own), OBSTACLE_CELL).means(options_.min_obstacle_points),
      SEARCH_CELL);
}

bool MeasuredSurface::belongs(const Eigen::Vector3d& point, Witness& witness) const {
  witness.distance = std::numeric_limits<double>::infinity();
  bool near = false;
  for (std::size_t k = 0; k < object_.size(); ++k) {
    const double distance = object_.parts[k].footPointDistance(point);
    near = near || distance <= options_.cloud_tolerance;
    if (std::abs(distance) < std::abs(witness.distance)) {
      witness.part = k;
      witness.distance = distance;
    }
  }
  return near;
}

bool MeasuredSurface::bearsWitness(const Eigen::Vector3d& point,
                                   const Witness& witness) const {
  const double nearest = std::abs(witness.distance);
  if (scene_.has_table &&
      std::abs(scene_.table_normal.dot(point) + scene_.table_offset) < nearest)
    return false;
  for (const Superquadric& other : scene_.obstacles.parts)
    if ((point - other.center).norm() < other.halfSizes().norm() + nearest &&
        std::abs(other.footPointDistance(point)) < nearest)
      return false;
  return true;
}

void MeasuredSurface::callWitnesses(std::vector<Eigen::Vector3d> places,
                                    const std::vector<Witness>& said) {
  if (places.empty())
    return;
  std::vector<double> away;
  for (const Witness& witness : said)
    away.push_back(std::abs(witness.distance));
  const auto middle = away.begin() + std::ptrdiff_t(away.size() / 2);
  std::nth_element(away.begin(), middle, away.end());
  scatter_ = 1.4826 * *middle; // of normally distributed distances
  witnesses_ = PointGrid(std::move(places), options_.observed_distance);
  for (std::size_t k = 0; k < witnesses_.points().size(); ++k)
    said_.push_back(said[witnesses_.given(k)]);
}

bool MeasuredSurface::faces(std::size_t k, const Eigen::Vector3d& normal) {
  Witness& w = said_[k];
  const Eigen::Vector3d& point = witnesses_.points()[k];
  if (w.normal.isZero(0.0)) // costly, and few are asked
    w.normal = object_.parts[w.part].normal(point);
  // no camera sees a side that is turned away: such a point lies on another sheet
  return w.normal.dot(normal) > 0.0 &&
         (!scene_.has_viewpoint || w.normal.dot(scene_.viewpoint - point) > 0.0);
}

double MeasuredSurface::slope(const GraspContact& contact,
                              const Eigen::Vector3d& outward) {
  // a plane through the points' distances from the model: what it leans, the normal
  // leans less
  const double radius = std::max(options_.patch_radius, options_.observed_distance);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
  const Eigen::Vector3d u = across(contact.normal, Eigen::Matrix3d::Identity());
  const Eigen::Vector3d v = contact.normal.cross(u);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  double square = 0.0;
  int count = 0;
  witnesses_.any(
      {contact.position - reach, contact.position + reach}, [&](std::size_t k) {
        const Eigen::Vector3d away = witnesses_.points()[k] - contact.position;
        const Witness& w = said_[k];
        if (w.part != contact.part || away.squaredNorm() > radius * radius ||
            !faces(k, contact.normal))
          return false;
        const Eigen::Vector3d row(1.0, u.dot(away), v.dot(away));
        squares += row * row.transpose();
        sums += w.distance * row;
        square += w.distance * w.distance;
        ++count;
        return false;
      });
  if (count < WITNESSES)
    return 0.0;
  // where the points stand in one line, nothing is said across it
  const Eigen::Vector3d plane = squares.completeOrthogonalDecomposition().solve(sums);
  const double noise2 = std::max(square - plane.dot(sums), 0.0) / (count - 3);
  const double lean2 = plane.tail<2>().squaredNorm();
  // no more than what the noise of points, which may err together, does not explain
  const double share = lean2 / (lean2 + noise2 / (radius * radius) + 1e-12);
  const Eigen::Vector3d normal =
      contact.normal - share * (plane.y() * u + plane.z() * v);
  const double cosine = normal.normalized().dot(outward);
  return cosine > MIN_COSINE ? std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine
                             : 1.0 / MIN_COSINE;
}

double MeasuredSurface::observed(const GraspContact& contact, bool at_rim) const {
  double facing = 1.0;
  if (scene_.has_viewpoint && !at_rim) {
    // the outline is known as well as the front; 30 degrees behind it nothing is:
    // points close to such a contact lie on another surface, such as a cup's inside
    const Eigen::Vector3d to_viewer =
        (scene_.viewpoint - contact.position).normalized();
    facing = std::clamp(1.0 + 2.0 * contact.normal.dot(to_viewer), 0.0, 1.0);
  }
  // the points of another part beside it do not tell of this one
  const double radius = options_.observed_distance;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
  if (witnesses_.empty() ||
      witnesses_.any(
          {contact.position - reach, contact.position + reach}, [&](std::size_t k) {
            return said_[k].part == contact.part &&
                   (witnesses_.points()[k] - contact.position).squaredNorm() <=
                       radius * radius;
          }))
    return facing;
  return scene_.has_viewpoint ? 0.5 * facing : 0.0; // on the model alone
}

Eigen::Vector3d MeasuredSurface::asSeen(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d away = sight_.transpose() * (point - scene_.viewpoint);
  return {away.x() / away.z() * distance_, away.y() / away.z() * distance_, away.z()};
}

void MeasuredSurface::takePicture() {
  const Eigen::AlignedBox3d box = object_.boundingBox();
  const Eigen::Vector3d ahead = box.center() - scene_.viewpoint;
  distance_ = ahead.norm();
  sight_.col(2) = ahead.normalized();
  sight_.col(0) = across(sight_.col(2), Eigen::Matrix3d::Identity());
  sight_.col(1) = sight_.col(2).cross(sight_.col(0));
  Eigen::AlignedBox3d frame;
  for (int i = 0; i < 8; ++i)
    frame.extend(asSeen(box.corner(Eigen::AlignedBox3d::CornerType(i))));
  frame.max().z() = std::numeric_limits<double>::infinity();
  if (!(frame.min().z() > 0.0)) // the viewer stands in it
    return;
  std::vector<Eigen::Vector3d> places;
  std::vector<double> depths;
  for (Eigen::Index i = 0; i < scene_.cloud.cols(); ++i) {
    const Eigen::Vector3d p = scene_.cloud.col(i);
    if (!p.allFinite())
      continue;
    const Eigen::Vector3d q = asSeen(p);
    if (!frame.contains(q))
      continue;
    places.emplace_back(q.x(), q.y(), 0.0);
    depths.push_back(q.z());
  }
  picture_ = PointGrid(std::move(places), options_.observed_distance);
  for (std::size_t k = 0; k < picture_.points().size(); ++k)
    depths_.push_back(depths[picture_.given(k)]);
}

bool MeasuredSurface::seenThrough(const GraspContact& contact) const {
  if (picture_.empty())
    return false;
  const Eigen::Vector3d q = asSeen(contact.position);
  const double radius = 0.5 * options_.observed_distance;
  const Eigen::Vector3d place(q.x(), q.y(), 0.0);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
  int behind = 0;
  const bool covered = picture_.any({place - reach, place + reach}, [&](std::size_t k) {
    if ((picture_.points()[k] - place).squaredNorm() > radius * radius)
      return false;
    ++behind;
    return depths_[k] <= q.z() + options_.cloud_tolerance;
  });
  return !covered && behind >= options_.min_obstacle_points;
}

} // namespace pcl_sq::detail
