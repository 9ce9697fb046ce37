// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/voxel_layout.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace pcl_sq;

namespace {

constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

/** The paper's book, 220 x 300 x 15 mm, somewhere in front of the camera. */
RoiBox book(double extra_height = 0.0) {
  const Eigen::Vector3d corner(0.0371, -0.1419, 1.1342);
  return {corner, corner + Eigen::Vector3d(0.220, 0.300 + extra_height, 0.015)};
}

VoxelLayout layoutOf(const RoiBox& region, const VoxelOptions& options = {}) {
  VoxelLayout layout;
  std::string why;
  EXPECT_TRUE(makeVoxelLayout(region, options, layout, &why)) << why;
  return layout;
}

bool isRefused(const RoiBox& region, const VoxelOptions& options = {}) {
  VoxelLayout layout = layoutOf(book());
  std::string why;
  const bool made = makeVoxelLayout(region, options, layout, &why);
  return !made && layout.empty() && !why.empty();
}

} // namespace

TEST(VoxelLayout, PercentagesGiveTheirInverseAsDivisions) {
  EXPECT_EQ(layoutOf(book()).divisions, Eigen::Vector3i(20, 20, 10));
  VoxelOptions options;
  options.percent = {4.5, 3.2, 10.0}; // the paper's figures for the book
  EXPECT_EQ(layoutOf(book(), options).divisions, Eigen::Vector3i(22, 31, 10));
  options.percent.setConstant(100.0);
  EXPECT_EQ(layoutOf(book(), options).divisions, Eigen::Vector3i(1, 1, 1));
}

TEST(VoxelLayout, TargetSizeGivesThePapersDivisionsOfTheBook) {
  VoxelOptions options;
  options.rule = VoxelRule::TARGET_SIZE_CLAMPED;
  EXPECT_EQ(layoutOf(book(), options).divisions, Eigen::Vector3i(22, 30, 10));
  EXPECT_EQ(layoutOf(book(0.005), options).divisions, Eigen::Vector3i(22, 31, 10));
  EXPECT_EQ(layoutOf(book(0.5), options).divisions, Eigen::Vector3i(22, 31, 10));
}

TEST(VoxelLayout, CellsFillTheRegionExactly) {
  const VoxelLayout layout = layoutOf(book());
  EXPECT_LT((layout.cellSizes().cwiseProduct(layout.divisions.cast<double>()) -
             book().sizes())
                .norm(),
            1e-12);
  const RoiBox all = layout.boxOf({0, 0, 20, 20});
  EXPECT_LT((all.min - book().min).norm() + (all.max - book().max).norm(), 1e-12);
}

TEST(VoxelLayout, IndexIsThatOfTheBoxThatHoldsThePoint) {
  const VoxelLayout layout = layoutOf(book());
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::Vector3d p =
        book().min + Eigen::Vector3d(unit(engine), unit(engine), unit(engine))
                         .cwiseProduct(book().sizes());
    const int index = layout.indexOf(p.x(), p.y(), p.z());
    ASSERT_GE(index, 0);
    const int column = layout.columnOf(index);
    const RoiBox box = layout.boxOf({column % 20, column / 20, 1, 1});
    EXPECT_TRUE(box.contains(p));
    const double depth = layout.cellSizes().z();
    EXPECT_NEAR(p.z(), book().min.z() + (index / 400 + 0.5) * depth, 0.501 * depth);
  }
}

TEST(VoxelLayout, AllSidesOfTheRegionBelongToIt) {
  const VoxelLayout layout = layoutOf(book());
  const Eigen::Vector3d low = book().min, high = book().max;
  EXPECT_EQ(layout.indexOf(low.x(), low.y(), low.z()), 0);
  EXPECT_EQ(layout.indexOf(high.x(), high.y(), high.z()), 20 * 20 * 10 - 1);
  EXPECT_EQ(layout.indexOf(high.x() + 1e-9, high.y(), high.z()), -1);
  EXPECT_EQ(layout.indexOf(low.x(), low.y() - 1e-9, low.z()), -1);
}

TEST(VoxelLayout, WhatIsNotFiniteOrFarAwayIsOutside) {
  const VoxelLayout layout = layoutOf(book());
  const Eigen::Vector3d p = book().center();
  for (const double bad : {NOT_A_NUMBER, INF, -INF, 1e30, -1e30, 1e308}) {
    EXPECT_EQ(layout.indexOf(bad, p.y(), p.z()), -1);
    EXPECT_EQ(layout.indexOf(p.x(), bad, p.z()), -1);
    EXPECT_EQ(layout.indexOf(p.x(), p.y(), bad), -1);
  }
}

TEST(VoxelLayout, AFlatSideGetsOneDivision) {
  RoiBox flat = book();
  flat.max.z() = flat.min.z();
  const VoxelLayout layout = layoutOf(flat);
  EXPECT_EQ(layout.divisions, Eigen::Vector3i(20, 20, 1));
  EXPECT_EQ(layout.indexOf(flat.max.x(), flat.max.y(), flat.min.z()), 399);
  const VoxelLayout point = layoutOf({book().min, book().min});
  EXPECT_EQ(point.divisions, Eigen::Vector3i(1, 1, 1));
  EXPECT_EQ(point.indexOf(book().min.x(), book().min.y(), book().min.z()), 0);
}

TEST(VoxelLayout, RefusesAGridOfTooManyCellsBeforeItAllocates) {
  VoxelOptions options;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions.setConstant(10000); // 1e12 cells
  EXPECT_TRUE(isRefused(book(), options));
  options.divisions.setConstant(std::numeric_limits<int>::max());
  EXPECT_TRUE(isRefused(book(), options));
  options.rule = VoxelRule::PERCENT;
  options.percent.setConstant(1e-300);
  EXPECT_TRUE(isRefused(book(), options));
}

TEST(VoxelLayout, TheLimitOfCellsIsInclusive) {
  VoxelOptions options;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions = {4, 5, 6};
  options.max_cells = 120;
  EXPECT_EQ(layoutOf(book(), options).counts.size(), 120u);
  options.max_cells = 119;
  EXPECT_TRUE(isRefused(book(), options));
}

TEST(VoxelLayout, RefusesRegionsThatAreNone) {
  RoiBox region = book();
  std::swap(region.min, region.max);
  EXPECT_TRUE(isRefused(region));
  for (const double bad : {NOT_A_NUMBER, INF, -INF, 1e30}) {
    region = book();
    region.max.y() = bad;
    EXPECT_TRUE(isRefused(region)) << bad;
  }
}

TEST(VoxelOptions, RangesAreCheckedAtBothEnds) {
  VoxelOptions options;
  EXPECT_TRUE(options.isValid());
  const auto isValidWith = [](auto change) {
    VoxelOptions changed;
    change(changed);
    std::string why;
    const bool valid = changed.isValid(&why);
    EXPECT_NE(valid, !why.empty());
    return valid;
  };
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.percent.y() = 0.0; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.percent.y() = NOT_A_NUMBER; }));
  EXPECT_TRUE(isValidWith([](VoxelOptions& o) { o.percent.y() = 100.0; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.percent.y() = 100.1; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.target_size = 0.0; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.target_size = INF; }));
  EXPECT_TRUE(isValidWith([](VoxelOptions& o) { o.min_divisions = 1; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.min_divisions = 0; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.max_divisions = 9; }));
  EXPECT_TRUE(isValidWith([](VoxelOptions& o) { o.max_divisions = 10; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.divisions.z() = 0; }));
  EXPECT_FALSE(isValidWith([](VoxelOptions& o) { o.max_cells = 0; }));
}

TEST(ValidityThreshold, IsThreeOrFivePercentOfTheMedianOfTheOccupied) {
  EXPECT_EQ(validityThreshold({0, 0, 20, 20, 20}), 3u);
  EXPECT_EQ(validityThreshold({0, 0, 0, 0, 0, 0, 1, 200, 300}), 10u);
}

TEST(ValidityThreshold, SparseCloudsKeepHalfTheirMedian) {
  EXPECT_EQ(validityThreshold({0, 1, 1, 2, 1}), 1u);
  EXPECT_EQ(validityThreshold({0, 4, 4, 4, 5, 1}), 2u);
}

TEST(ValidityThreshold, OneOrTwoPointsAreNoise) {
  EXPECT_GT(validityThreshold({0, 1, 0, 0}), 1u);
  EXPECT_GT(validityThreshold({0, 2, 0, 0}), 2u);
  EXPECT_GT(validityThreshold({0, 0}), 0u);
}

TEST(VoxelLayout, ColumnsAreValidWhereAnyVoxelBehindThemIs) {
  VoxelOptions options;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions = {3, 2, 2};
  VoxelLayout layout = layoutOf(book(), options);
  layout.min_points = 3;
  //                x: 0  1  2  0  1  2
  layout.counts = {4,
                   2,
                   0,
                   0,
                   0,
                   9, // front
                   5,
                   2,
                   3,
                   0,
                   0,
                   0}; // back
  const CellMask columns = layout.validColumns();
  EXPECT_EQ(columns.width, 3);
  EXPECT_EQ(columns.height, 2);
  EXPECT_EQ(columns.cells, (std::vector<std::uint8_t>{1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(layout.columnCounts(), (std::vector<std::uint32_t>{9, 0, 3, 0, 0, 9}));
  EXPECT_EQ(layout.validCount(), 4u);
}
