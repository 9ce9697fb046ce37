// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/silhouette.h"
#include "pcl_sq/table_plane.h"
#include "pcl_sq/view_fit.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief A table: normal . p + offset = 0, the normal on the camera's side. */
struct TableModel : TablePlane {
  double sigma = 1e-3; ///< standard deviation of its place below the object [m]
  double noise = 1e-3; ///< root mean square distance of its points [m]
  /** \brief Height of a point above the table [m]. */
  double height(const Eigen::Vector3d& p) const { return signedDistance(p); }
};

/** \brief From how many sides bare points show their object. */
enum class Coverage {
  AUTOMATIC, ///< told by the points
  COMPLETE,  ///< from all round: there is no camera that some sides are hidden from
  ONE_SIDED  ///< from one place, which is guessed where it is not given
};

/** \brief What is known of the view besides the cloud. Everything is optional. */
struct PCL_SQ_EXPORTS ViewOptions {
  /** \brief Intrinsics of the camera the organized cloud comes from; without it they
   * are found from the cloud itself. */
  std::optional<PinholeCamera> camera;
  /** \brief Pixels of the object and nothing else; empty: found in the depth. */
  CellMask mask;
  /** \brief Pixels of other things in an organized cloud: where they are not clearly
   * behind the object, its outline beside them is theirs, and what they hide is not
   * free. Empty: what hides the object is told by the depth alone. */
  CellMask others;
  /** \brief The camera's place in the cloud's frame [m]. */
  std::optional<Eigen::Vector3d> viewpoint;
  /** \brief Whether the points are those of one view; COMPLETE makes no use of a
   * camera, a mask or a viewpoint. */
  Coverage coverage = Coverage::AUTOMATIC;
  /** \brief Direction away from the ground in the cloud's frame, of any length: a table
   * lies across it. Without it an image's top is taken to be up. */
  std::optional<Eigen::Vector3d> up;
  std::optional<TableModel> table; ///< without it a table is looked for
  bool find_table = true;          ///< whether one is looked for
  /** \brief Whether the points given as the object are all those of a box around it,
   * the table's and other things' among them: the thing whose box it is is then looked
   * for. */
  bool object_is_region = false;
  double mask_sigma = 0.7;     ///< noise of the mask's outline [px], (0, 20]
  double mask_dilation = 0.35; ///< sigma of its unknown dilation [px], [0, 20]
  /** \brief Side of the squares of its pixels that are wrong together [px], [1, 100];
   * those of a mask that was found in depth reach as far as its errors. */
  double mask_correlation = 1.0;
  /** \brief Standard deviation of each point of the cloud along its ray [m], as a
   * stereo rig's measured one; empty: what the points show by themselves. */
  Eigen::VectorXf noise;
  /** \brief Side of the square of pixels that share their error [px], [1, 100]. */
  double correlation = 7.0;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Where the outline came from. */
enum class OutlineSource {
  NONE,  ///< points only
  MASK,  ///< the user's mask
  DEPTH, ///< jumps of the organized cloud's depth
  POINTS ///< the bare points seen from the viewpoint
};

/** \brief The value's name, as it stands in the JSON. */
PCL_SQ_EXPORTS const char* toString(OutlineSource source);

/** \brief An object as one camera saw it: points, outline and table. */
struct PCL_SQ_EXPORTS ObservedObject {
  Eigen::Matrix3Xd points;  ///< to be fitted, free of rim and gross outliers [m]
  std::vector<int> columns; ///< the points' columns in the input
  /** \brief Of each point how far its surface lies off where its measurement belongs
   * one pixel beside it: the pixel's size times the sine of the slant [m]. Matching
   * windows and depth cameras err so by about a pixel. Empty for bare points. */
  Eigen::VectorXf sideways;
  /** \brief Of each point ViewOptions::noise; empty where it is not known. */
  Eigen::VectorXf noise;
  PinholeCamera camera; ///< real, or virtual for bare points
  std::vector<ContourPoint> contour;
  OutlineSource outline = OutlineSource::NONE;
  double outline_sigma = 0.6;       ///< [px]
  double outline_correlation = 1.0; ///< side of squares of pixels wrong together [px]
  double outline_dilation = 0.35;   ///< sigma [px]
  double outline_offset = 0.0;      ///< expected dilation [px]
  std::optional<TableModel> table;
  double effective_points = 0.0; ///< independent ones among the points
  /** \brief What bare points tell of the surface they lie on. */
  struct Surface {
    double noise = 0.0;     ///< of independent points [m]
    bool two_sided = false; ///< whether both sides of thin walls show
  };
  std::optional<Surface> surface; ///< where their sides were looked at
  double depth = 1.0;             ///< of the object [m]
  /** \brief Points nearer to the table than this may be missing: they cannot be told
   * from the table's own [m]. */
  double foot = 0.0;
  /** \brief Whether all that lies between the object's lowest points and the table is
   * hidden, so that the object may as well reach down to it. */
  bool hidden_below = false;
  /** \brief Whether the camera's place is known, told or seen in the cloud; where it
   * was guessed, nobody knows which sides are unseen. */
  bool viewpoint_known = false;
  double extent = 0.0; ///< half diagonal of the points' box [m]
  CellMask pixels;     ///< the object's, of the real or virtual image
  /** \brief Pixels around the object through which the background is seen: no part of
   * the object crosses their rays. A coarse grid of them. */
  std::vector<Eigen::Vector2d> free_space;
  double free_weight = 0.0; ///< independent observations per free pixel
  /** \brief Pixels of the largest gap in the object, such as that of a handle, through
   * which the background is seen. */
  std::vector<Eigen::Vector2d> gap;
  std::vector<std::string> notes; ///< fall-backs, one sentence each

  bool hasCamera() const { return outline != OutlineSource::NONE; }
  /** \brief The evidence for an outline: tangent planes and the table. */
  ViewEvidence evidence(const std::vector<ContourPoint>& outline_points,
                        int lines,
                        bool on_table) const;
};

/** \brief Collects what one view of an object tells.
 * \param[in] points 3 x (width height), row by row for an organized cloud
 * \param[in] width, height of the organized cloud; height 1: bare points
 * \param[in] object columns of the object; empty: all, or those under the mask
 * \param[out] observed the object; emptied on failure
 * \param[out] why the reason of a failure as a sentence (optional)
 * \return false if the view contradicts the cloud (mask of another size, mask beside
 * the object, too few points) */
[[nodiscard]] PCL_SQ_EXPORTS bool observeObject(const CloudPoints& points,
                                                int width,
                                                int height,
                                                const std::vector<int>& object,
                                                const ViewOptions& view,
                                                ObservedObject& observed,
                                                std::string* why = nullptr);

/** \brief Intrinsics of an organized cloud in its camera's frame, by regression.
 * \return false if the cloud is no pinhole image */
[[nodiscard]] PCL_SQ_EXPORTS bool
findIntrinsics(const CloudPoints& points, int width, int height, PinholeCamera& camera);

/** \brief The camera of an organized cloud in any frame: findIntrinsics() where the
 * cloud is in its camera's, else intrinsics and pose from the rays of its pixels.
 * \param[in] viewpoint the camera's place, where it is known [m]
 * \return false if the cloud is no pinhole image, or too flat to tell */
[[nodiscard]] PCL_SQ_EXPORTS bool
findCamera(const CloudPoints& points,
           int width,
           int height,
           const std::optional<Eigen::Vector3d>& viewpoint,
           PinholeCamera& camera);

/** \brief Finds the object that stands on a table in an organized cloud: pixels above
 * the table that hang together without a jump in depth, the largest such region that
 * the image border does not cut.
 * \param[in,out] table used if set, found otherwise
 * \return false if there is no table or nothing stands on it */
[[nodiscard]] PCL_SQ_EXPORTS bool findStandingObject(const CloudPoints& points,
                                                     int width,
                                                     int height,
                                                     std::optional<TableModel>& table,
                                                     CellMask& object);

/** \brief The largest plane among the points, repeatable.
 * \param[in] inlier_distance [m]; 0: from the noise, about Z^2
 * \return false if no plane holds a third of them */
[[nodiscard]] PCL_SQ_EXPORTS bool findPlane(const std::vector<Eigen::Vector3d>& points,
                                            const Eigen::Vector3d& viewpoint,
                                            double inlier_distance,
                                            TableModel& plane);

} // namespace pcl_sq
