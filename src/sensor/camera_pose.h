// SPDX-License-Identifier: BSD-3-Clause
// Private. Images are looked at in their camera's frame, whatever frame the cloud is
// in.
#pragma once

#include "pcl_sq/object_view.h"

#include <functional>

namespace pcl_sq::detail {

/** \brief Takes a cloud into its camera's frame, and what was seen there back. */
class CameraPose {
public:
  explicit CameraPose(const PinholeCamera& camera) : camera_(camera) {}

  /** \brief Whether the cloud is in its camera's frame already. */
  bool isIdentity() const {
    return camera_.center.isZero(0.0) && camera_.rotation.isIdentity(0.0);
  }
  Eigen::Matrix3Xf toCamera(const CloudPoints& points) const;
  TableModel toCamera(TableModel table) const;
  ViewOptions toCamera(ViewOptions view) const;
  TableModel toCloud(TableModel table) const;
  /** \param[in] points of the cloud, in its own frame */
  void toCloud(ObservedObject& observed, const CloudPoints& points) const;

private:
  PinholeCamera camera_;
};

/** \brief Whether points look as if a camera at the origin, looking along z, has seen
 * them: far enough before it, and hardly any ray meets two layers of them. */
bool isCameraFrame(const Eigen::Matrix3Xd& points);

/** \brief A place from which points of one side may have been seen: in the middle of
 * the directions from which each ray meets them once, some way off.
 * \param[in] one_sided whether they are known to be of one side: the likeliest place
 * then, however many there are
 * \param[in] likely tells the direction towards it, if that is known; asked where they
 * may be of one
 * \return nothing where they may be of several sides */
std::optional<Eigen::Vector3d>
guessViewpoint(const Eigen::Matrix3Xd& points,
               bool one_sided,
               const std::function<std::optional<Eigen::Vector3d>()>& likely = {});

} // namespace pcl_sq::detail
