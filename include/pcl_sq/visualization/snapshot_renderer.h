// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/roi.h"
#include "pcl_sq/visualization/snapshot_options.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl {
template <typename PointT>
class PointCloud;
} // namespace pcl

namespace pcl_sq {

struct SnapshotScene;

namespace detail {

/** \brief Whether points have a colour of their own. */
template <typename PointT, typename = void>
inline constexpr bool HAS_COLOR = false;
template <typename PointT>
inline constexpr bool HAS_COLOR<PointT,
                                std::void_t<decltype(std::declval<PointT>().r),
                                            decltype(std::declval<PointT>().g),
                                            decltype(std::declval<PointT>().b)>> = true;

} // namespace detail

/** \brief A picture in memory: rows from the top, three bytes per pixel. */
struct SnapshotImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  Color at(int x, int y) const {
    const std::size_t i =
        3 * static_cast<std::size_t>(static_cast<std::ptrdiff_t>(y) * width + x);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

/** \brief Pictures of clouds and superquadrics, also on machines without a display.
 *
 * The object is framed: superquadrics, what was added beside them, and the cloud's
 * points close by. Without any of these the cloud itself is the object.
 *
 * Where no local X display answers, a private Xvfb is started and ended again (Debian:
 * xvfb, libgl1-mesa-dri). Rendering is serialised over all threads of the process.
 * \code
 * SnapshotRenderer renderer;
 * renderer.addCloud(*cloud);
 * renderer.addModel(model);
 * renderer.save("model.png");
 * \endcode
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS SnapshotRenderer {
public:
  /** \brief Bytes of red, green and blue, one column per point. */
  using Colors = Eigen::Matrix<std::uint8_t, 3, Eigen::Dynamic>;

  explicit SnapshotRenderer(const SnapshotOptions& options = {});
  ~SnapshotRenderer();
  SnapshotRenderer(SnapshotRenderer&&) noexcept;
  SnapshotRenderer& operator=(SnapshotRenderer&&) noexcept;

  void setOptions(const SnapshotOptions& options);
  const SnapshotOptions& getOptions() const;

  /** \brief The measured points. \param[in] points 3 x N in the cloud's frame [m];
   * non-finite columns are left out \param[in] colors 3 x N, or empty for a neutral
   * grey-blue \throws pcl_sq::Exception if the two have different lengths */
  void addCloud(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                const Colors& colors = Colors());
  /** \brief The measured points of PCL's cloud, in their own colours where their type
   * has any. */
  template <typename PointT>
  void addCloud(const pcl::PointCloud<PointT>& cloud) {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(cloud.size()));
    Colors colors(3, detail::HAS_COLOR<PointT> ? points.cols() : 0);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const PointT& point = cloud[static_cast<std::size_t>(i)];
      points.col(i) << point.x, point.y, point.z;
      if constexpr (detail::HAS_COLOR<PointT>)
        colors.col(i) << point.r, point.g, point.b;
    }
    addCloud(points.cast<double>(), colors);
  }
  /** \brief Translucent superquadrics with outlines, coloured by partColor(); parts of
   * several models are counted on. \throws pcl_sq::Exception if a part is invalid */
  void addModel(const MultiSuperquadric& model);
  /** \brief Any surface: a gripper, a true mesh. \param[in] opacity [0, 1] */
  void addMesh(const TriangleMesh& mesh, Color color, double opacity = 1.0);
  /** \brief Line segments: normals, approach directions.
   * \param[in] ends 3 x 2N; columns 2i and 2i + 1 are the ends of segment i [m]
   * \param[in] width [px] */
  void addLines(const Eigen::Ref<const Eigen::Matrix3Xd>& ends,
                Color color,
                double width = 2.0);
  /** \brief Edges of axis-aligned boxes: prisms, voxels, regions. */
  void addBoxes(const std::vector<RoiBox>& boxes, Color color, double width = 1.5);
  /** \brief Round markers: grasp points. \param[in] size diameter [px] */
  void addPoints(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                 Color color,
                 double size = 8.0);
  /** \brief Takes everything out of the picture; the options stay. */
  void clear();

  /** \brief The camera that the next picture will have: where a point will be seen.
   * \throws pcl_sq::Exception as render() does for an empty scene */
  ViewCamera camera() const;

  /** \brief The picture. \throws pcl_sq::Exception if there is nothing to show, an
   * option is out of range or no display can be had */
  SnapshotImage render() const;
  /** \brief Writes the picture as PNG, by a temporary name.
   * \param[in] path ends in .png
   * \throws pcl_sq::Exception as render(), or if the file cannot be written */
  void save(const std::string& path) const;
  /** \brief Writes \a count pictures around the upward axis: out.png gives out_000.png,
   * out_001.png ... \param[in] count number of pictures, [1, 1000] \param[in] progress
   * called with the number of pictures done (optional) \return the names \throws
   * pcl_sq::Exception as save() */
  std::vector<std::string>
  saveTurntable(const std::string& path,
                int count,
                const std::function<void(std::size_t)>& progress = {}) const;

private:
  std::unique_ptr<SnapshotScene> scene_;
};

} // namespace pcl_sq
