// SPDX-License-Identifier: BSD-3-Clause
#include "util/order_statistic.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace pcl_sq::detail;

TEST(OrderStatistic, IsTheValueOfTheSortedNumbers) {
  std::mt19937 engine(3);
  for (std::size_t count = 1; count < 200; count += 7)
    for (const unsigned int different : {1U, 3U, 1000000U}) { // with and without ties
      std::vector<double> values(count), spare(count);
      for (double& v : values)
        v = double(engine() % different);
      std::vector<double> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (const std::size_t index : {std::size_t(0), count / 2, count - 1}) {
        std::vector<double> overwritten = values;
        EXPECT_EQ(orderStatistic(overwritten.data(), spare.data(), count, index),
                  sorted[index]);
      }
    }
}
