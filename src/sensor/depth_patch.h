// SPDX-License-Identifier: BSD-3-Clause
// Private. The depths around an object in an image.
#pragma once

#include "sensor/observation.h"

#include <cstdint>
#include <vector>

namespace pcl_sq::detail {

/** \brief Depths of the pixels in and around an object's box, each computed once: the
 * windows around its pixels and its outline overlap, and look at each many times.
 *
 * The patch reaches beyond the image where the object does nearly, so that a window of
 * MARGIN around a pixel of the object always lies within. */
class DepthPatch {
public:
  static constexpr int MARGIN = 7; ///< beyond the box: the largest reach [px]

  /** \param[in] box of the object's pixels, which are those of \a o.out */
  DepthPatch(const Observation& o, const CellRect& box);

  /** \brief Marks as others the pixels that are neither the object's nor the table's.
   * Call once the table is known. */
  void markOthers(const Observation& o);

  /** \brief Depths of the object's finite points around a pixel of its box.
   * \param[in] reach at most MARGIN \param[out] depths room for the whole window
   * \return their number */
  std::size_t ownAround(int x, int y, int reach, double* depths) const {
    return around(own_, x, y, reach, depths);
  }
  /** \brief The same for the finite points that markOthers() has marked. */
  std::size_t othersAround(int x, int y, int reach, double* depths) const {
    return around(other_, x, y, reach, depths);
  }
  /** \brief Calls use(dx, dy, depth) with the object's finite points around a pixel of
   * its box, every step-th of a window. \param[in] reach at most MARGIN */
  template <typename Use>
  void forEachOwn(int x, int y, int reach, int step, const Use& use) const {
    for (int dy = -reach; dy <= reach; dy += step)
      for (int dx = -reach; dx <= reach; dx += step)
        if (const std::size_t i = indexOf(x + dx, y + dy); own_[i])
          use(dx, dy, depth_[i]);
  }
  /** \brief Depth of a pixel whose point is finite [m]. */
  double depth(int x, int y) const { return depth_[indexOf(x, y)]; }

private:
  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y - rect_.y) *
               static_cast<std::size_t>(rect_.width) +
           static_cast<std::size_t>(x - rect_.x);
  }
  std::size_t around(const std::vector<std::uint8_t>& chosen,
                     int x,
                     int y,
                     int reach,
                     double* depths) const;

  CellRect rect_;
  std::vector<double> depth_; ///< 0 where there is no finite point
  std::vector<std::uint8_t> own_, other_;
};

/** \brief Whether the pixels' depths err each by itself, as seen on a plane beside the
 * object. */
[[nodiscard]] bool errorsAreIndependent(const Observation& o, const TableModel& plane);

/** \brief How many pixels without depth lie between the object and what is behind it,
 * the median over its outline. Cameras that measure each pixel by itself drop those
 * that see both: half of them are the object's. Matching over windows drops none, it
 * fattens the nearer one; shadows of occlusion lie on one side alone. */
[[nodiscard]] double missingEdge(const Observation& o);

/** \brief How far each point's surface moves along its normal when the measurement
 * belongs a pixel beside the point's own [m]. */
Eigen::VectorXf lateralNoise(const Observation& o, const DepthPatch& patch);

/** \brief How many points share one error: 1 where neighbours err independently. */
double sharingOfErrors(const Eigen::Matrix3Xd& points);

/** \brief Pixels of a mask's outline that err alike: hands, nets and graph cuts smooth
 * over about as many. */
constexpr double OUTLINE_CORRELATION = 7.0;

} // namespace pcl_sq::detail
