// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/object_surface_estimation.h"

#include <cstdint>

namespace pcl_sq {

/** \brief Which thing each pixel of an organized cloud belongs to. */
struct LabelImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> values; ///< row by row; 0: no thing
  LabelImage() = default;
  LabelImage(int columns, int rows)
      : width(columns), height(rows),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}
  bool empty() const { return values.empty(); }
};

/** \brief Settings of SceneEstimation. */
struct PCL_SQ_EXPORTS SceneOptions {
  /** \brief How each thing is fitted, and what is known of the view; its masks must be
   * empty and its decomposition Decomposition::PARTS. */
  EstimationOptions estimation;
  /** \brief Things of fewer pixels are left out, [30, 1000000]. */
  int min_pixels = 150;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief One thing of a scene. */
struct SceneObject {
  MultiSuperquadric model; ///< in the cloud's frame [m]
  int label = 0;           ///< its pixels' value in Scene::labels
  CellRect roi;            ///< box of its pixels [px]
  int pixels = 0;          ///< seen of it
  /** \brief Share of the pixels that the model covers which nothing nearer hides, 0 to
   * 1: of the thing as it is believed to be. */
  double visible = 1.0;
  /** \brief How the model came about: confidence, view, notes, timings. */
  EstimationReport report;
};

/** \brief A table and the things on it. */
struct Scene {
  std::optional<TableModel> table;  ///< in the cloud's frame
  std::vector<SceneObject> objects; ///< from left to right in the image
  /** \brief Pixels of all things, also of those that gave no model. */
  LabelImage labels;
  std::string failure; ///< why there is no object, a sentence; empty on success
  std::vector<std::string> notes; ///< fall-backs and what was left out, sentences
  std::vector<std::pair<std::string, double>> timings_ms; ///< stage, [ms], in order
};

/** \brief Every thing on a table, from one look: the table is found, the things on it
 * are told apart, and each is fitted as ObjectSurfaceEstimation does, all in parallel.
 *
 * Things are told apart by evidence: jumps of the depth, concave edges and colours
 * propose pieces, and what the models of pieces and of their unions explain decides
 * which of them are one thing. What another thing hides of an outline counts for
 * nothing.
 * \code
 * pcl_sq::SceneEstimation<pcl::PointXYZRGB> estimation;
 * estimation.setInputCloud(organized_cloud);
 * pcl_sq::Scene scene;
 * if (estimation.estimate(scene))
 *   std::cout << scene.objects.size() << " things\n";
 * \endcode
 * \tparam PointT point type with x, y, z; colours are used where it has r, g, b
 * \ingroup pcl_sq
 */
template <typename PointT>
class SceneEstimation : public pcl::PCLBase<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<SceneEstimation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const SceneEstimation<PointT>>;

  /** \brief Sets all options; kept as they were, with a PCL_ERROR, if not valid. */
  void setOptions(const SceneOptions& options);
  const SceneOptions& getOptions() const { return options_; }

  /** \brief Things told apart elsewhere, such as by a neural network: used as they are.
   * \param[in] labels of the cloud's size; empty (default): found in the cloud */
  void setLabels(LabelImage labels) { labels_ = std::move(labels); }
  const LabelImage& getLabels() const { return labels_; }

  /** \brief Number of threads, 0 for all cores. The result does not depend on it. */
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /** \brief Finds and fits all things.
   * \param[out] scene its objects are empty on failure
   * \return false, with a PCL_WARN that says why, if there is no table, nothing on it,
   * or no thing gives a model */
  [[nodiscard]] bool estimate(Scene& scene);

protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::use_indices_;
  using pcl::PCLBase<PointT>::fake_indices_;
  using pcl::PCLBase<PointT>::initCompute;
  using pcl::PCLBase<PointT>::deinitCompute;

private:
  SceneOptions options_;
  LabelImage labels_;
  unsigned int threads_ = 0;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/scene_estimation.hpp"
