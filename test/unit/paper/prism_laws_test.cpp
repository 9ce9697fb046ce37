// SPDX-License-Identifier: BSD-3-Clause
// What holds for the prisms of any mask, tried on random ones.
#include "pcl_sq/prism.h"

#include "prism_runs.h"
#include "text_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

bool isFull(const CellMask& mask, const CellRect& rect) {
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      if (!mask(x, y))
        return false;
  return true;
}

bool isInside(const CellMask& mask, const CellRect& rect) {
  return rect.x >= 0 && rect.y >= 0 && rect.area() > 0 &&
         rect.x + rect.width <= mask.width && rect.y + rect.height <= mask.height;
}

} // namespace

TEST(PrismScan, CoversEveryValidVoxelOfARandomMask) {
  std::mt19937 engine(1);
  for (int trial = 0; trial < 300; ++trial) {
    const CellMask random =
        randomMask(engine, 1 + trial % 23, 1 + trial % 17, 0.1 + 0.003 * trial);
    for (const PrismRun run : {PrismRun::CROSS, PrismRun::MIN, PrismRun::MAX}) {
      const std::vector<CellRect> prisms = scanPrisms(random, allPasses(run));
      EXPECT_EQ(uncoveredCells(random, prisms), 0) << drawing(random);
      for (const CellRect& prism : prisms) {
        EXPECT_TRUE(isInside(random, prism));
        EXPECT_TRUE(random(prism.x, prism.y)) << "the seed is valid";
        if (run == PrismRun::MIN) {
          EXPECT_TRUE(isFull(random, prism)) << drawing(random);
        }
      }
    }
  }
}

TEST(PrismScan, FirstPassHasOnePrismPerTopLeftCorner) {
  std::mt19937 engine(2);
  for (int trial = 0; trial < 100; ++trial) {
    const CellMask random = randomMask(engine, 20, 20, 0.7);
    int corners = 0;
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x)
        corners += random(x, y) && !random(x - 1, y) && !random(x, y - 1);
    EXPECT_EQ(static_cast<int>(scanPrisms(random, PrismOptions::literal()).size()),
              corners);
  }
}

TEST(PrismScan, LeavesNoMoreThanTheShareThatMayStayUncovered) {
  std::mt19937 engine(3);
  for (int trial = 0; trial < 100; ++trial) {
    const CellMask random = randomMask(engine, 20, 20, 0.6);
    PrismOptions options = allPasses(PrismRun::CROSS);
    options.max_uncovered = 0.02;
    EXPECT_LE(uncoveredCells(random, scanPrisms(random, options)),
              0.02 * random.count());
  }
}

TEST(PrismScan, RectanglesAreBlindToRaggedBorders) {
  std::mt19937 engine(4);
  std::bernoulli_distribution hole(0.3);
  for (int trial = 0; trial < 50; ++trial) {
    CellMask ragged(20, 20);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x)
        ragged.set(x, y, (x > 0 && x < 19 && y > 0 && y < 19) || !hole(engine));
    EXPECT_EQ(scanPrisms(ragged).size(), 1u) << drawing(ragged);
  }
}

TEST(PrismScan, FindsTheRectangleOfLargestSurplusByBruteForce) {
  std::mt19937 engine(5);
  for (int trial = 0; trial < 40; ++trial) {
    const CellMask random = randomMask(engine, 9, 7, 0.55);
    int best = 0;
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x)
        for (int h = 1; y + h <= 7; ++h)
          for (int w = 1; x + w <= 9; ++w) {
            int sum = 0;
            for (int j = y; j < y + h; ++j)
              for (int i = x; i < x + w; ++i)
                sum += random(i, j) ? 1 : -2;
            best = std::max(best, sum);
          }
    PrismOptions options;
    options.min_rectangle = options.min_exclusive = 0.0;
    const CellRect first = scanPrisms(random, options).front();
    int sum = 0;
    for (int j = first.y; j < first.y + first.height; ++j)
      for (int i = first.x; i < first.x + first.width; ++i)
        sum += random(i, j) ? 1 : -2;
    // cells at the border may have been added to it since
    EXPECT_LE(sum, best);
    EXPECT_GE(first.area(), best);
  }
}

TEST(PrismScan, RectanglesStayInTheGridAndAreNeverEmpty) {
  std::mt19937 engine(6);
  for (int trial = 0; trial < 300; ++trial) {
    const CellMask random =
        randomMask(engine, 1 + trial % 23, 1 + trial % 17, 0.1 + 0.003 * trial);
    for (const CellRect& prism : scanPrisms(random))
      EXPECT_TRUE(isInside(random, prism)) << drawing(random);
  }
}

TEST(PrismScan, IsBoundedOnLargeNoisyMasks) {
  std::mt19937 engine(7);
  const CellMask noise = randomMask(engine, 200, 200, 0.5);
  EXPECT_LE(scanPrisms(noise, figure4()).size(), 256u);
  EXPECT_TRUE(scanPrisms(CellMask(MAX_PRISM_CELLS + 1, MAX_PRISM_CELLS + 1)).empty());
}
