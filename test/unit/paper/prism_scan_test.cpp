// SPDX-License-Identifier: BSD-3-Clause
// Prisms of drawn masks: bottles, cups, steps and what is merged or dropped.
#include "pcl_sq/prism.h"

#include "prism_runs.h"
#include "text_mask.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const CellMask SHARP_BOTTLE = mask({"......######......",
                                    "......######......",
                                    "......######......",
                                    "......######......",
                                    "......######......",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################",
                                    "##################"});

const CellMask SHOULDER_BOTTLE =
    mask({".......######.......", ".......######.......", ".......######.......",
          ".......######.......", ".......######.......", ".......######.......",
          ".....##########.....", "...##############...", "..################..",
          ".##################.", "####################", "####################",
          "####################", "####################", "####################",
          "####################", "####################", "####################",
          "####################", "####################"});

const CellMask CUP = mask({"##############......",
                           "##############......",
                           "##############......",
                           "##################..",
                           "###################.",
                           "##############..####",
                           "##############...###",
                           "##############...###",
                           "##############...###",
                           "##############...###",
                           "##############..####",
                           "###################.",
                           "##################..",
                           "##############......",
                           "##############......",
                           "##############......"});

} // namespace

TEST(PrismScan, TwoBlocksThatTouchAtACornerAreTwoPrisms) {
  const CellMask blocks = mask({"##..", "##..", "..##"});
  EXPECT_EQ(scanPrisms(blocks, figure4()).size(), 2u);
  EXPECT_EQ(scanPrisms(blocks).size(), 2u);
}

TEST(PrismScan, AFullRectangleIsOnePrismByEveryMethod) {
  CellMask block(30, 12);
  for (int y = 2; y < 11; ++y)
    for (int x = 5; x < 29; ++x)
      block.set(x, y);
  const std::vector<CellRect> expected{{5, 2, 24, 9}};
  EXPECT_EQ(scanPrisms(block), expected);
  for (const PrismRun run : {PrismRun::CROSS, PrismRun::MIN, PrismRun::MAX})
    EXPECT_EQ(scanPrisms(block, figure4(run)), expected);
  EXPECT_EQ(scanPrisms(block, PrismOptions::literal()), expected);
}

TEST(PrismScan, AnEmptyMaskHasNoPrisms) {
  EXPECT_TRUE(scanPrisms(CellMask()).empty());
  EXPECT_TRUE(scanPrisms(CellMask(), figure4()).empty());
  EXPECT_TRUE(scanPrisms(CellMask(20, 20)).empty());
  EXPECT_TRUE(scanPrisms(CellMask(20, 20), figure4()).empty());
}

TEST(PrismScan, ASharpBottleIsNeckAndBody) {
  EXPECT_EQ(scanPrisms(SHARP_BOTTLE),
            (std::vector<CellRect>{{0, 5, 18, 10}, {6, 0, 6, 5}}));
  // in the pseudo-code the neck runs through the body
  const std::vector<CellRect> through{{6, 0, 6, 15}, {0, 5, 18, 10}};
  EXPECT_EQ(scanPrisms(SHARP_BOTTLE, figure4()), through);
  EXPECT_EQ(scanPrisms(SHARP_BOTTLE, PrismOptions::literal()), through);
}

TEST(PrismScan, ABottleWithShouldersCollapsesToNeckAndBody) {
  EXPECT_EQ(scanPrisms(SHOULDER_BOTTLE).size(), 2u);
  EXPECT_EQ(scanPrisms(SHOULDER_BOTTLE, figure4()).size(), 2u);
  EXPECT_GE(scanPrisms(SHOULDER_BOTTLE, PrismOptions::literal()).size(), 4u)
      << "one prism per corner of the staircase";
}

TEST(PrismScan, TheLiteralPseudoCodeLosesTheHandleOfACup) {
  const std::vector<CellRect> prisms = scanPrisms(CUP, PrismOptions::literal());
  EXPECT_EQ(prisms.front(), (CellRect{0, 0, 14, 16}));
  EXPECT_GT(uncoveredCells(CUP, prisms), CUP.count() / 10);
}

TEST(PrismScan, TheHandleOfACupGetsPrismsOfItsOwn) {
  EXPECT_EQ(scanPrisms(CUP), (std::vector<CellRect>{{0, 0, 14, 16}, {14, 3, 6, 10}}));
  const std::vector<CellRect> prisms = scanPrisms(CUP, figure4());
  ASSERT_GE(prisms.size(), 2u);
  EXPECT_EQ(prisms[0], (CellRect{0, 0, 14, 16}));
  for (std::size_t p = 1; p < prisms.size(); ++p)
    EXPECT_GE(prisms[p].x, 14);
}

TEST(PrismScan, RunsAreReadInThreeWays) {
  const CellMask steps = mask({"###", "##.", "#.."});
  const auto first = [&steps](PrismRun run) {
    return scanPrisms(steps, allPasses(run)).front();
  };
  EXPECT_EQ(first(PrismRun::CROSS), (CellRect{0, 0, 3, 3}));
  EXPECT_EQ(first(PrismRun::MIN), (CellRect{0, 0, 3, 1}));
  EXPECT_EQ(scanPrisms(mask({"###", "..#"}), allPasses(PrismRun::MAX)).front(),
            (CellRect{0, 0, 3, 2}));
}

TEST(PrismScan, MergesPrismsThatAreNearlyTheSame) {
  const CellMask nearly = mask({".#########",
                                "##########",
                                "##########",
                                "##########",
                                "##########",
                                "##########"});
  PrismOptions options = figure4();
  options.min_exclusive = 0.0;
  EXPECT_EQ(scanPrisms(nearly, options), (std::vector<CellRect>{{0, 0, 10, 6}}));
  options.merge = false;
  EXPECT_EQ(scanPrisms(nearly, options).size(), 2u);
}

TEST(PrismScan, DropsPrismsWithFewCellsOfTheirOwn) {
  CellMask block(10, 10);
  for (int y = 1; y < 10; ++y)
    for (int x = 0; x < 10; ++x)
      block.set(x, y);
  block.set(3, 0); // a column of its own from top to bottom, one cell exclusive
  EXPECT_EQ(scanPrisms(block, figure4()), (std::vector<CellRect>{{0, 1, 10, 9}}));
  PrismOptions options = figure4();
  options.min_exclusive = 0.01;
  EXPECT_EQ(scanPrisms(block, options).size(), 2u);
}

TEST(PrismScan, DropsPrismsWithFewPoints) {
  const CellMask blocks = mask({"##...", "##...", ".....", "...##", "...##"});
  std::vector<std::uint32_t> points(25, 0);
  points[0] = points[1] = points[5] = points[6] = 8;     // 32 in all
  points[18] = points[19] = points[23] = points[24] = 7; // 28
  for (const PrismOptions& options : {PrismOptions(), figure4()}) {
    EXPECT_EQ(scanPrisms(blocks, options, points),
              (std::vector<CellRect>{{0, 0, 2, 2}}));
    EXPECT_EQ(scanPrisms(blocks, options).size(), 2u);
  }
}

TEST(PrismScan, RectanglesOfADiscAreOne) {
  for (const int cells : {10, 20, 31}) {
    CellMask disc(cells, cells);
    const double r = 0.5 * cells;
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        disc.set(x, y, std::hypot(x + 0.5 - r, y + 0.5 - r) <= r);
    EXPECT_EQ(scanPrisms(disc), (std::vector<CellRect>{{0, 0, cells, cells}}))
        << drawing(disc);
  }
}

TEST(PrismScan, InheritsTheDepthOfTheRegion) {
  VoxelOptions options;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions = {18, 15, 4};
  const RoiBox region{{-0.09, 0.10, 1.0}, {0.09, 0.25, 1.2}};
  VoxelLayout layout;
  ASSERT_TRUE(makeVoxelLayout(region, options, layout));
  for (std::size_t c = 0; c < SHARP_BOTTLE.cells.size(); ++c)
    layout.counts[c + 270] = SHARP_BOTTLE.cells[c] ? 10 : 0; // second layer
  const std::vector<Prism> prisms = scanPrisms(layout);
  ASSERT_EQ(prisms.size(), 2u);
  EXPECT_LT((prisms[1].box.min - Eigen::Vector3d(-0.03, 0.10, 1.0)).norm(), 1e-12);
  EXPECT_LT((prisms[1].box.max - Eigen::Vector3d(0.03, 0.15, 1.2)).norm(), 1e-12);
}

TEST(PrismOptions, RangesAreCheckedAtBothEnds) {
  EXPECT_TRUE(PrismOptions().isValid());
  EXPECT_TRUE(PrismOptions::literal().isValid());
  const auto isValidWith = [](auto change) {
    PrismOptions changed;
    change(changed);
    std::string why;
    const bool valid = changed.isValid(&why);
    EXPECT_NE(valid, !why.empty());
    if (!valid) {
      EXPECT_TRUE(scanPrisms(SHARP_BOTTLE, changed).empty());
    }
    return valid;
  };
  EXPECT_TRUE(isValidWith([](PrismOptions& o) { o.min_exclusive = 0.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.min_exclusive = -0.1; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.min_exclusive = 1.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.min_rectangle = -0.1; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.min_rectangle = 1.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.min_points = -1; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.max_passes = -1; }));
  EXPECT_TRUE(isValidWith([](PrismOptions& o) { o.max_uncovered = 1.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.max_uncovered = 1.1; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.max_uncovered = NAN; }));
  EXPECT_TRUE(isValidWith([](PrismOptions& o) { o.merge_overlap = 1.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.merge_overlap = 0.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.merge_width_ratio = 0.0; }));
  EXPECT_FALSE(isValidWith([](PrismOptions& o) { o.merge_width_ratio = 1.1; }));
}
