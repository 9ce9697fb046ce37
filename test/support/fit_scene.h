// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_object.h"

#include "view_scene.h"

#include <gtest/gtest.h>

namespace pcl_sq::test {

/** \brief Fits the object of a scene seen through its mask. */
inline ObjectFit fitScene(const ViewScene& scene,
                          const ObjectFitOptions& options = {}) {
  ViewOptions view;
  view.mask = scene.mask;
  view.camera = scene.camera;
  ObservedObject observed;
  std::string why;
  EXPECT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed, &why))
      << why;
  return fitObject(observed, options);
}

/** \brief Share of the volume of two unions that both have. */
inline double overlap(const MultiSuperquadric& a, const MultiSuperquadric& b) {
  Eigen::AlignedBox3d box = a.boundingBox();
  box.extend(b.boundingBox());
  Random random(10);
  int both = 0, any = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d at(
        random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    const Eigen::Vector3d p = box.min() + box.sizes().cwiseProduct(at);
    both += a.contains(p) && b.contains(p);
    any += a.contains(p) || b.contains(p);
  }
  return double(both) / any;
}

} // namespace pcl_sq::test
