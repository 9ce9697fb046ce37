// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/object_view.h"

#include <gtest/gtest.h>

#include <string>

namespace pcl_sq::test {

/** \brief An object of points without an image, of which one tells what they cover. */
inline ObservedObject observe(const Eigen::Matrix3Xd& points, Coverage coverage) {
  ViewOptions view;
  view.coverage = coverage;
  ObservedObject observed;
  std::string why;
  EXPECT_TRUE(observeObject(
      points.cast<float>(), int(points.cols()), 1, {}, view, observed, &why))
      << why;
  return observed;
}

} // namespace pcl_sq::test
