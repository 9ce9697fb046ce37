// SPDX-License-Identifier: BSD-3-Clause
// Table and thing in a list of points: no pixels tell what hangs together, so that the
// points' spacing does.
#include "sensor/local_quadric.h"
#include "table/table_search.h"
#include "util/voxel_clusters.h"

#include <pcl/search/kdtree.h>

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <random>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t SEARCHED = 20000; ///< points in which planes are looked for
constexpr std::size_t LOOKED_AT = 300;  ///< of them, for noise and spacing
constexpr int NEIGHBOURS = 24;          ///< through which a plane goes
/** \brief Gap between two things, over the points' spacing: surfaces seen at a slant of
 * 75 degrees are four times as sparse. */
constexpr double GAP = 5.0;
constexpr double CLEAR = 4.0;   ///< of the noise: farther points are no table's
constexpr double GROWTH = 1.5;  ///< of the distance, while a plane goes on beyond it
constexpr double GOES_ON = 1.2; ///< points within twice the distance over those in it
constexpr int MAX_GROWTHS = 6;
constexpr double MOSTLY = 0.5; ///< of a thing's points are over its table

/** \brief What a scene's points are like, whatever they show. */
struct Texture {
  double noise = 0.0;   ///< about the planes of neighbours [m]
  double spacing = 0.0; ///< of all points [m]
};

Texture textureOf(const pcl::PointCloud<pcl::PointXYZ>::Ptr& sample, double points) {
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(sample);
  std::vector<double> noises, spacings;
  pcl::Indices near;
  std::vector<float> squares;
  const std::size_t step = std::max<std::size_t>(1, sample->size() / LOOKED_AT);
  for (std::size_t i = 0; i < sample->size(); i += step) { // already in random order
    const int found = tree.nearestKSearch(int(i), NEIGHBOURS + 1, near, squares);
    if (found < NEIGHBOURS + 1)
      continue;
    Eigen::Matrix3Xd patch(3, found);
    for (int k = 0; k < found; ++k)
      patch.col(k) =
          (*sample)[std::size_t(near[std::size_t(k)])].getVector3fMap().cast<double>();
    const Eigen::Matrix3Xd off = patch.colwise() - patch.rowwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
        Eigen::Matrix3d(off * off.transpose() / double(found - 3)),
        Eigen::EigenvaluesOnly);
    noises.push_back(std::sqrt(std::max(eigen.eigenvalues()[0], 0.0)));
    // n points spread over a disc of radius r are r sqrt(pi / n) apart
    spacings.push_back(std::sqrt(double(squares.back()) * M_PI / NEIGHBOURS));
  }
  Texture texture;
  if (noises.empty())
    return texture;
  texture.noise = median(std::move(noises));
  texture.spacing =
      median(std::move(spacings)) * std::sqrt(double(sample->size()) / points);
  return texture;
}

/** \brief The area that a table's points cover, by its reach in many directions. */
class Outline {
public:
  explicit Outline(const TableModel& table)
      : u_(table.normal.unitOrthogonal()), v_(table.normal.cross(u_)) {
    reach_.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Eigen::Vector3d& p) {
    for (std::size_t k = 0; k < reach_.size(); ++k)
      reach_[k] = std::max(reach_[k], along(k, p));
  }
  /** \brief Whether a point lies over it, off its rim: walls stand on rims. */
  bool contains(const Eigen::Vector3d& p, double rim) const {
    for (std::size_t k = 0; k < reach_.size(); ++k)
      if (along(k, p) > reach_[k] - rim)
        return false;
    return true;
  }

private:
  double along(std::size_t k, const Eigen::Vector3d& p) const {
    const double a = 2.0 * M_PI * double(k) / double(reach_.size());
    return std::cos(a) * u_.dot(p) + std::sin(a) * v_.dot(p);
  }
  Eigen::Vector3d u_, v_;
  std::array<double, 32> reach_;
};

/** \brief Where up is in a list: -y before a camera, z in the frames of robots and
 * maps. */
Eigen::Vector3d upwardOf(const std::vector<Eigen::Vector3d>& voters, bool moved) {
  std::size_t before = 0;
  for (const Eigen::Vector3d& p : voters) // within 60 degrees of a camera's axis
    before += p.z() > 0.5 * p.norm();
  return !moved && 50 * before >= 49 * voters.size()
             ? Eigen::Vector3d(-Eigen::Vector3d::UnitY())
             : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

/** \brief The table's own points: those on its plane that hang together. */
Outline outlineOf(const CloudPoints& points,
                  const std::vector<int>& columns,
                  const TableModel& table,
                  double distance,
                  double gap) {
  std::vector<int> on;
  for (const int c : columns)
    if (std::abs(table.height(points.col(c).cast<double>())) <= distance)
      on.push_back(c);
  Outline outline(table);
  const std::vector<std::vector<int>> patches = clustersOf(points, on, gap);
  if (!patches.empty())
    for (const int c : patches[0])
      outline.add(points.col(c).cast<double>());
  return outline;
}

} // namespace

Standing findInList(const CloudPoints& points,
                    const std::vector<bool>& candidates,
                    const ViewOptions& view,
                    double clearance,
                    double gap) {
  std::vector<int> finite;
  for (int c = 0; c < points.cols(); ++c)
    if (points.col(c).allFinite())
      finite.push_back(c);
  if (finite.size() < MIN_TABLE_SCENE)
    return {};
  // by chance, not each how many-th: scanners interleave their lines
  std::mt19937 engine(5489U);
  std::vector<int> drawn = finite;
  const std::size_t size = std::min(SEARCHED, finite.size());
  for (std::size_t i = 0; i < size; ++i)
    std::swap(drawn[i], drawn[i + engine() % (drawn.size() - i)]);
  drawn.resize(size);
  auto sample = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  TableSearch search;
  double largest = 0.0;
  for (const int c : drawn) {
    sample->push_back({points(0, c), points(1, c), points(2, c)});
    search.voters.push_back(points.col(c).cast<double>());
    largest = std::max(largest, search.voters.back().cwiseAbs().maxCoeff());
  }
  const Texture texture = textureOf(sample, double(finite.size()));
  if (!(texture.spacing > 0.0))
    return {};
  const double reach = gap > 0.0 ? gap : GAP * texture.spacing;
  const double rounding = 4.0 * 6e-8 * largest; // of a float that holds the coordinate
  search.points_a_voter = double(finite.size()) / double(size);
  search.distance =
      clearance > 0.0 ? clearance : std::max(CLEAR * texture.noise, rounding);
  search.viewpoint = view.viewpoint;
  search.up = view.up;
  search.upward = upwardOf(search.voters, bool(view.viewpoint));
  search.table = view.table;
  search.at = [&points](int c) {
    return Eigen::Vector3d(points.col(c).cast<double>());
  };
  search.refine = [&](TableModel& plane) {
    // errors that neighbours share are larger than their scatter: a plane whose points
    // go on beyond the distance is thicker than that
    double distance = search.distance;
    for (int k = 0; clearance <= 0.0 && k < MAX_GROWTHS; ++k, distance *= GROWTH) {
      std::size_t in = 0, near = 0;
      for (const Eigen::Vector3d& p : search.voters) {
        in += std::abs(plane.height(p)) <= distance;
        near += std::abs(plane.height(p)) <= 2.0 * distance;
      }
      if (double(near) <= GOES_ON * double(in))
        break;
      if (!refitPlane(search.voters, GROWTH * distance, plane))
        break;
    }
  };
  search.choose = [&](const TableModel& table, const std::vector<int>* within) {
    Standing found;
    found.table = table;
    const auto standing = [&](const Eigen::Vector3d& p) {
      return clearance > 0.0
                 ? clearance
                 : standingHeight(table,
                                  view.viewpoint ? (p - *view.viewpoint).norm() : 0.0);
    };
    const Outline outline = outlineOf(points,
                                      within ? *within : finite,
                                      table,
                                      std::max(search.distance, 3.0 * table.noise),
                                      2.0 * reach);
    std::vector<int> above;
    for (const int c : within ? *within : finite) {
      const Eigen::Vector3d p = search.at(c);
      if ((candidates.empty() || candidates[std::size_t(c)]) &&
          table.height(p) > standing(p))
        above.push_back(c);
    }
    for (std::vector<int>& thing : clustersOf(points, above, reach)) {
      if (thing.size() < MIN_TABLE_SCENE)
        break;
      std::size_t over = 0;
      for (const int c : thing)
        over += outline.contains(search.at(c), reach);
      if (double(over) >= MOSTLY * double(thing.size())) {
        found.thing = std::move(thing);
        break;
      }
    }
    return found;
  };
  return search.run();
}

} // namespace pcl_sq::detail
