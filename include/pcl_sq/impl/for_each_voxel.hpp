// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/voxel_layout.h"

#include <algorithm>

namespace pcl_sq {
namespace detail {

/** \brief Calls \a visit(index, voxel) for each indexed point that lies in the grid, in
 * the order of the indices.
 *
 * Works in blocks: finding voxels is arithmetic, visiting them waits for memory; apart,
 * neither holds up the other. */
template <typename Visit>
void forEachVoxel(const CoordinateMap& points,
                  const pcl::Indices& indices,
                  const VoxelLayout& layout,
                  Visit&& visit) {
  constexpr std::size_t BLOCK = 256;
  std::int32_t voxels[BLOCK];
  const VoxelLocator locate = layout.locator();
  const float* const data = points.data();
  const auto stride = points.outerStride();
  for (std::size_t first = 0; first < indices.size(); first += BLOCK) {
    const std::size_t size = std::min(BLOCK, indices.size() - first);
    const pcl::index_t* block = indices.data() + first;
    for (std::size_t i = 0; i < size; ++i) {
      const float* const p = data + stride * static_cast<Eigen::Index>(block[i]);
      voxels[i] = locate(p[0], p[1], p[2]);
    }
    for (std::size_t i = 0; i < size; ++i)
      if (voxels[i] >= 0)
        visit(block[i], voxels[i]);
  }
}

} // namespace detail
} // namespace pcl_sq
