// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/scene_estimation.h"

#include <type_traits>

namespace pcl_sq {

namespace detail {

/** \brief Bytes of red, green and blue, a column per point. */
using ColorMatrix = Eigen::Matrix<std::uint8_t, 3, Eigen::Dynamic>;

/** \brief Whether points have a colour of their own. */
template <typename PointT, typename = void>
inline constexpr bool HAS_RGB = false;
template <typename PointT>
inline constexpr bool HAS_RGB<PointT,
                              std::void_t<decltype(std::declval<PointT>().r),
                                          decltype(std::declval<PointT>().g),
                                          decltype(std::declval<PointT>().b)>> = true;

/** \brief The colours of a cloud; empty where its points have none. */
template <typename PointT>
ColorMatrix colorsOf(const pcl::PointCloud<PointT>& cloud) {
  ColorMatrix colors;
  if constexpr (HAS_RGB<PointT>) {
    colors.resize(3, static_cast<Eigen::Index>(cloud.size()));
    for (std::size_t i = 0; i < cloud.size(); ++i)
      colors.col(static_cast<Eigen::Index>(i)) << cloud[i].r, cloud[i].g, cloud[i].b;
  }
  return colors;
}

/** \brief What SceneEstimation takes from a cloud, whatever its points are. */
struct SceneInput {
  CoordinateMap points;
  int width, height;
  ColorMatrix colors;            ///< empty: none
  Eigen::Vector3d sensor_origin; ///< [m]
  const pcl::PCLHeader& header;
  const pcl::Indices& indices;
  bool chosen;              ///< whether the user named the indices
  const LabelImage& labels; ///< empty: things are told apart
};

/** \brief The algorithm of SceneEstimation. \param[in] input null if there is none */
[[nodiscard]] PCL_SQ_EXPORTS bool estimateScene(const SceneInput* input,
                                                const SceneOptions& options,
                                                unsigned int threads,
                                                Scene& scene);

/** \brief How many things an object that was seen looks like: of those among its pixels
 * the ones that are a good share of it. 1 where that cannot be told.
 * \param[in] points, colors of the cloud it was seen in; no colours: empty */
[[nodiscard]] PCL_SQ_EXPORTS int countThings(const ObservedObject& object,
                                             const CloudPoints& points,
                                             const ColorMatrix& colors);

/** \brief Takes options over if they are valid. */
PCL_SQ_EXPORTS void setOptions(const SceneOptions& options, SceneOptions& target);

} // namespace detail

template <typename PointT>
void SceneEstimation<PointT>::setOptions(const SceneOptions& options) {
  detail::setOptions(options, options_);
}

template <typename PointT>
bool SceneEstimation<PointT>::estimate(Scene& scene) {
  if (!initCompute())
    return detail::estimateScene(nullptr, options_, threads_, scene);
  const auto& origin = input_->sensor_origin_;
  const detail::SceneInput input{detail::coordinatesOf(*input_),
                                 detail::columnsOf(*input_),
                                 static_cast<int>(input_->height),
                                 detail::colorsOf(*input_),
                                 {origin[0], origin[1], origin[2]},
                                 input_->header,
                                 *indices_,
                                 use_indices_ && !fake_indices_,
                                 labels_};
  const bool found = detail::estimateScene(&input, options_, threads_, scene);
  deinitCompute();
  return found;
}

} // namespace pcl_sq
