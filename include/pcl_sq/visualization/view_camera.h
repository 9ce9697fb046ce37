// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <string>

namespace pcl_sq {

/** \brief Where a picture is taken from. All but CAMERA are parallel projections. */
enum class View {
  FRONT, ///< from where the camera of a camera-frame cloud stands, upright
  SIDE,  ///< from the object's right-hand side
  TOP,   ///< from above, the front at the bottom of the picture
  ISO,   ///< from the right, the front and above
  CAMERA ///< the sensor's own pinhole at the origin, looking along +z with y down
};

/** \brief The value's name as the command line has it, e.g. "iso". */
PCL_SQ_EXPORTS const char* toString(View view);
/** \brief Inverse of toString(). \return false if there is no such view */
[[nodiscard]] PCL_SQ_EXPORTS bool viewFromString(const std::string& name, View* view);

/** \brief Free space around the framed object, as shares of the picture's sides. */
struct FrameMargins {
  double left = 0.06, right = 0.06, top = 0.06, bottom = 0.06;
};

/** \brief The projection of a picture: which pixel a point of the cloud's frame gets.
 *
 * For parallel views the picture's axes are right() and up(); the picture is centred on
 * the object. CAMERA keeps the sensor's optical axis and cuts a window out of its image
 * (an off-centre frustum), so that the picture is a part of what the sensor saw.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS ViewCamera {
public:
  /** \brief Camera that frames the points.
   * \param[in] focus 3 x N finite points in the cloud's frame [m], N >= 1
   * \param[in] view where from \param[in] up the cloud frame's upward direction, of
   * any length but zero; ignored by CAMERA
   * \param[in] width picture's width [px] \param[in] height picture's height [px]
   * \throws pcl_sq::Exception if CAMERA is asked for and a point has z <= 0 */
  ViewCamera(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
             View view,
             const Eigen::Vector3d& up,
             int width,
             int height,
             const FrameMargins& margins = {});

  /** \brief One picture of a turntable: the camera of that view turned by \a azimuth
   * [rad] around the upward axis through the object's middle. The frame is large
   * enough for every azimuth; CAMERA turns like FRONT. */
  static ViewCamera turntable(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
                              View view,
                              const Eigen::Vector3d& up,
                              int width,
                              int height,
                              const FrameMargins& margins,
                              double azimuth);

  /** \brief Position in the picture [px], x to the right and y down from the top left
   * corner of the top left pixel; third component: depth along the viewing direction
   * [m]. */
  Eigen::Vector3d project(const Eigen::Vector3d& point) const;

  /** \brief Pixels per metre at the middle of the object. */
  double pixelsPerMeter() const { return pixels_per_meter_; }
  bool perspective() const { return perspective_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /** \brief Unit vectors of the picture in the cloud's frame. */
  Eigen::Vector3d right() const { return axes_.col(0); }
  Eigen::Vector3d up() const { return axes_.col(1); }
  /** \brief Viewing direction, from the camera to the object. */
  Eigen::Vector3d forward() const { return axes_.col(2); }
  /** \brief Eye: the pinhole, or a point well in front of the object. */
  Eigen::Vector3d position() const { return position_; }
  /** \brief Pixel through which the viewing direction passes; the middle of the
   * picture for parallel views. */
  Eigen::Vector2d principalPoint() const { return principal_; }
  /** \brief Focal length of the pinhole [px]; zero for parallel views. */
  double focalLength() const { return focal_length_; }
  /** \brief Direction from a point to the eye, not normalised. */
  Eigen::Vector3d toEye(const Eigen::Vector3d& point) const;

private:
  ViewCamera(int width, int height) : width_(width), height_(height) {}
  void setAxes(View view, const Eigen::Vector3d& up);
  void frameParallel(const Eigen::AlignedBox3d& box, const FrameMargins& margins);
  void framePinhole(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
                    const FrameMargins& margins);

  int width_ = 0, height_ = 0;
  bool perspective_ = false;
  double pixels_per_meter_ = 1.0;
  double focal_length_ = 0.0;                           ///< [px], of the pinhole
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  ///< columns: right, up, forward
  Eigen::Vector2d principal_ = Eigen::Vector2d::Zero(); ///< pixel of the optical axis
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

} // namespace pcl_sq
