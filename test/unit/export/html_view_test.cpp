// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/html_view.h"

#include "text.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::count;

namespace {

/** \brief A model of equal cups. */
ModelFile fileOf(std::size_t cups) {
  Superquadric cup;
  cup.semi_axes = {0.04, 0.04, 0.05};
  cup.epsilon1 = 0.1;
  cup.center = {0.2, -0.1, 0.7};
  cup.rim = 0.9;
  cup.wall = 0.004;
  ModelFile file;
  file.model.parts.assign(cups, cup);
  return file;
}

} // namespace

TEST(HtmlView, APageStaysSmallAndHoldsNoEndOfItsScript) {
  ModelFile file = fileOf(6);
  const Eigen::Matrix3Xf points =
      Eigen::Matrix3Xf::Random(3, 200000) * 0.1F +
      file.model.parts[0].center.cast<float>().replicate(1, 200000);
  const std::vector<std::uint32_t> colors(200000, 0x102030);
  HtmlViewOptions options;
  options.title = "</script><b>";
  const std::string html =
      htmlView(file, points, Eigen::Vector3d::Zero(), colors, options);
  EXPECT_LT(html.size(), 3u << 20U);
  EXPECT_EQ(count(html, "</script>"), 1u);
  EXPECT_EQ(count(html, "http"), 0u); // nothing from elsewhere
  EXPECT_EQ(count(html, "@DATA@") + count(html, "@TITLE@"), 0u);
}

TEST(HtmlView, WhatIsNoGraspOfOursIsLeftOut) {
  ModelFile file = fileOf(1);
  file.extra_json = R"({"gripper": 3, "grasps": {"a": []}, "report": []})";
  const Eigen::Matrix3Xf none(3, 0);
  EXPECT_NE(htmlView(file, none, Eigen::Vector3d::Zero(), {}).find("\"grasps\":[]"),
            std::string::npos);
}
