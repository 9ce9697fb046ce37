// SPDX-License-Identifier: BSD-3-Clause
// Private. Small compact pieces of the surfaces that are seen, and which of them touch.
#pragma once

#include "patches/scene_view.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Sums over the pixels of a piece, which add up when pieces are joined. */
struct PieceSums {
  double count = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Vector3d color = Eigen::Vector3d::Zero(); ///< linear in the bytes

  void add(const PieceSums& other);
  Eigen::Vector3d mean() const { return point / count; }
  /** \brief Normal of the plane through the points, towards the camera. */
  Eigen::Vector3d normal() const;
};

/** \brief How far two colours are apart, in steps that things of one colour hardly
 * take: hue and saturation finely, brightness, which light changes, coarsely. */
[[nodiscard]] double colorDistance(const PieceSums& a, const PieceSums& b);

/** \brief A colour in steps that tell colours apart: shares of red, green and blue, and
 * brightness, which light and shade change, last. */
[[nodiscard]] Eigen::Vector4f shadeOf(const Eigen::Vector3d& color);

constexpr double JUMPS = 0.5; ///< of a border, at which it is an edge in depth

/** \brief What is seen where two pieces meet. */
struct Border {
  int pairs = 0; ///< of neighbouring pixels
  int jumps = 0; ///< of them, with a jump in depth beyond noise and slope
  /** \brief Sum over the others of the angle between the pieces' normals [rad],
   * positive where the fold opens to the camera. */
  double fold = 0.0;

  void add(const Border& other);
  /** \brief Mean of the angle [rad]. */
  double meanFold() const { return pairs > jumps ? fold / (pairs - jumps) : 0.0; }
};

/** \brief Pieces of about the same size whose pixels are alike in place, depth and
 * colour. */
struct Superpixels {
  std::vector<int> of_pixel; ///< index of the piece, -1: none
  std::vector<PieceSums> pieces;
  /** \brief Pieces that meet, each pair once with the smaller index first. */
  std::vector<std::pair<std::pair<int, int>, Border>> borders;
};

/** \brief Standard deviation of a depth, over its square [1/m]: what the table's points
 * show. */
[[nodiscard]] double depthNoise(const SceneView& view);

/** \brief Divides pixels into superpixels. \param[in] pixels that are set */
[[nodiscard]] Superpixels divide(const SceneView& view, const CellMask& pixels);

} // namespace pcl_sq::detail
