// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/grasp_quality.h"

#include "quality/convex_hull.h"

#include "quality/wrench_minimum.h"

#include <algorithm>
#include <limits>

namespace pcl_sq {

namespace {

using detail::Cone;
using detail::Wrench;

constexpr std::size_t STARTS = 32;   ///< facets from which epsilon is sought
constexpr double MAX_COSINE = 0.995; ///< between starts

std::vector<Cone> cones(const std::vector<GraspContact>& contacts,
                        const WrenchOptions& options) {
  std::vector<Cone> all;
  for (const GraspContact& contact : contacts)
    all.push_back({-contact.normal,
                   (contact.position - options.origin) / options.torque_length,
                   options.friction,
                   options.torsional_friction / options.torque_length});
  return all;
}

/** \brief Wrenches on the edges of the cones and between them and pure torsion. */
std::vector<Wrench> edges(const std::vector<Cone>& all, int count) {
  std::vector<Wrench> wrenches;
  for (const Cone& cone : all) {
    const Eigen::Vector3d u = cone.n.unitOrthogonal(), v = cone.n.cross(u);
    const auto add = [&](double angle, double share, double torque) {
      wrenches.push_back(cone.wrench(share * cone.friction *
                                         (std::cos(angle) * u + std::sin(angle) * v),
                                     torque * cone.torsion));
    };
    for (int k = 0; k < count; ++k)
      add(2.0 * M_PI * k / count, 1.0, 0.0);
    if (cone.torsion <= 0.0)
      continue;
    for (const double sign : {-1.0, 1.0}) {
      add(0.0, 0.0, sign);
      for (int k = 0; k < count / 2; ++k)
        add(4.0 * M_PI * k / count, M_SQRT1_2, sign * M_SQRT1_2);
    }
  }
  return wrenches;
}

Eigen::MatrixXd columns(const std::vector<Wrench>& wrenches) {
  Eigen::MatrixXd all(6, Eigen::Index(wrenches.size()));
  for (std::size_t i = 0; i < wrenches.size(); ++i)
    all.col(Eigen::Index(i)) = wrenches[i];
  return all;
}

} // namespace

bool WrenchOptions::isValid(std::string* why) const {
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  if (!(friction >= 0.0 && friction <= 5.0))
    return fail("friction is outside [0, 5]");
  if (!(torsional_friction >= 0.0 && torsional_friction <= 1.0))
    return fail("torsional_friction is outside [0, 1] m");
  if (!origin.allFinite())
    return fail("the origin is not finite");
  if (!(torque_length > 0.0) || !std::isfinite(torque_length))
    return fail("torque_length is not positive");
  if (cone_edges < 4 || cone_edges > 64)
    return fail("cone_edges is outside [4, 64]");
  return true;
}

double wrenchSupport(const std::vector<GraspContact>& contacts,
                     const Eigen::Matrix<double, 6, 1>& direction,
                     const WrenchOptions& options) {
  return detail::support(cones(contacts, options), direction);
}

WrenchQuality wrenchQuality(const std::vector<GraspContact>& contacts,
                            const WrenchOptions& options) {
  if (contacts.size() < 2 || !options.isValid())
    return {};
  const std::vector<Cone> all = cones(contacts, options);
  std::vector<detail::HullFacet> facets;
  WrenchQuality quality;
  if (!detail::convexHull(
          columns(edges(all, options.cone_edges)), facets, &quality.volume))
    return {}; // the wrenches lie in a subspace
  std::sort(facets.begin(),
            facets.end(),
            [](const detail::HullFacet& a, const detail::HullFacet& b) {
              return a.offset > b.offset; // -offset is the distance
            });
  quality.epsilon_lower = std::max(-facets.front().offset, 0.0);
  std::vector<Wrench> starts;
  for (const detail::HullFacet& facet : facets) {
    const Wrench normal = facet.normal;
    if (std::none_of(starts.begin(), starts.end(), [&](const Wrench& start) {
          return start.dot(normal) > MAX_COSINE;
        }))
      starts.push_back(normal);
    if (starts.size() == STARTS)
      break;
  }
  quality.epsilon = std::numeric_limits<double>::infinity();
  for (const Wrench& start : starts)
    quality.epsilon = std::min(quality.epsilon, detail::minimumFrom(all, start));
  quality.force_closure = quality.epsilon > 1e-9;
  return quality.force_closure ? quality : WrenchQuality();
}

} // namespace pcl_sq
