// SPDX-License-Identifier: BSD-3-Clause
// Private. The k-th smallest of a few numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pcl_sq::detail {

/** \brief The value that would stand at \a index if the values were sorted.
 *
 * Quickselect that copies every value both ways and moves on by what the comparison
 * says: no branch depends on a value. Of numbers in no order every second such branch
 * is mispredicted, and most of the time of std::nth_element is lost there.
 * \param[in,out] values are overwritten, as \a spare is, which has room for as many
 * \param[in] index less than \a count */
inline double
orderStatistic(double* values, double* spare, std::size_t count, std::size_t index) {
  for (;;) {
    // none of the ends: along the rows of an image they are alike, and extreme
    const double a = values[count / 4], b = values[count / 2],
                 c = values[3 * count / 4];
    const double pivot = std::max(std::min(a, b), std::min(std::max(a, b), c));
    std::size_t less = 0, greater = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = values[i];
      values[less] = value;
      spare[greater] = value;
      less += value < pivot;
      greater += value > pivot;
    }
    if (index < less)
      count = less;
    else if (index >= count - greater) {
      index -= count - greater;
      count = greater;
      std::swap(values, spare);
    } else
      return pivot;
  }
}

} // namespace pcl_sq::detail
