// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/mass_properties.h"

#include <algorithm>

namespace pcl_sq {

namespace {

/** \brief Integrals of 1, p and p p^T over a body. */
struct Moments {
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Moments& o, double sign) {
    volume += sign * o.volume;
    first += sign * o.first;
    second += sign * o.second;
  }
};

Eigen::Matrix3d inertiaOf(const Eigen::Matrix3d& second) {
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

Moments ofPart(const Superquadric& part) {
  Moments m;
  m.volume = part.materialVolume();
  m.first = m.volume * part.centerOfGravity();
  const Eigen::Matrix3d inertia = part.inertia(); // about the centre
  const Eigen::Matrix3d across = // of a tapered body, which does not lie around it
      m.volume * (part.centerOfGravity() - part.center) * part.center.transpose();
  m.second = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia +
             m.volume * part.center * part.center.transpose() + across +
             across.transpose();
  return m;
}

/** \brief What part k shares with the parts before it, each point once. */
Moments shared(const MultiSuperquadric& model, std::size_t k, int resolution) {
  Moments m;
  const Superquadric& part = model.parts[k];
  const Eigen::AlignedBox3d own = part.boundingBox();
  Eigen::AlignedBox3d region;
  std::vector<std::size_t> others;
  for (std::size_t j = 0; j < k; ++j) {
    const Eigen::AlignedBox3d common = own.intersection(model.parts[j].boundingBox());
    if (common.isEmpty())
      continue;
    region.extend(common);
    others.push_back(j);
  }
  if (others.empty())
    return m;
  const Eigen::Vector3d cell = region.sizes() / resolution;
  const auto covered = [&](const Eigen::Vector3d& p) {
    return part.inMaterial(p) &&
           std::any_of(others.begin(), others.end(), [&](std::size_t j) {
             return model.parts[j].inMaterial(p);
           });
  };
  for (int z = 0; z < resolution; ++z)
    for (int y = 0; y < resolution; ++y)
      for (int x = 0; x < resolution; ++x) {
        const Eigen::Vector3d p =
            region.min() +
            cell.cwiseProduct(Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        if (!covered(p))
          continue;
        m.volume += 1.0;
        m.first += p;
        m.second += p * p.transpose();
      }
  const double volume = cell.prod();
  m.volume *= volume;
  m.first *= volume;
  m.second *= volume;
  return m;
}

} // namespace

MassProperties massProperties(const MultiSuperquadric& model, int resolution) {
  Moments total;
  for (std::size_t k = 0; k < model.size(); ++k) {
    total.add(ofPart(model.parts[k]), 1.0);
    total.add(shared(model, k, std::clamp(resolution, 8, 512)), -1.0);
  }
  MassProperties result;
  if (!(total.volume > 0.0))
    return result;
  result.volume = total.volume;
  result.center = total.first / total.volume;
  result.inertia = inertiaOf(total.second -
                             total.volume * result.center * result.center.transpose());
  return result;
}

} // namespace pcl_sq
