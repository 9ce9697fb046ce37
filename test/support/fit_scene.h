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

} // namespace pcl_sq::test
