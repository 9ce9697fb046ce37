// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_object.h"
#include "pcl_sq/fit_options.h"
#include "pcl_sq/prism.h"
#include "pcl_sq/progress.h"

namespace pcl_sq {

/** \brief How an object is split before fitting. */
enum class Decomposition {
  NONE,   ///< one superquadric for all points
  PRISMS, ///< one for each rectangular prism of voxels (III-C)
  PARTS   ///< as many as the data ask for, from points, outline and table
};

/** \brief How a part's superquadric is found. */
enum class FitMode {
  PAPER, ///< pose, a1 and a2 from region and extents; e1, e2 and a3 estimated (III-B)
  FULL   ///< all eleven parameters from the points
};

/** \brief Points whose principal axes turn a part's superquadric. */
enum class PcaScope {
  OBJECT, ///< one rotation for all parts, as the paper's Table I has it
  PART    ///< each part its own
};

/** \brief Where a part's superquadric is centred. */
enum class CenterRule {
  /** x, y of the prism; the points' front stays in place while a3, at most half of the
   * region's depth, is estimated: the fit establishes the real depth (III-C). */
  FRONT,
  /** x, y of the prism, z of the whole region's depth (III-B, E10). A part that lies
   * nearer or farther than the region's middle then collapses onto its points. */
  REGION,
  MEAN ///< the mean of the part's points
};

/** \brief Settings of ObjectSurfaceEstimation; as they stand here, the best mode. */
struct PCL_SQ_EXPORTS EstimationOptions {
  Decomposition decomposition = Decomposition::PARTS;
  VoxelOptions voxels;
  PrismOptions prisms;
  bool exclusive_points = false; ///< whether a point counts for its smallest prism only
  FitMode fit = FitMode::FULL;   ///< for Decomposition::PRISMS and NONE
  PcaScope pca = PcaScope::OBJECT;
  CenterRule center = CenterRule::FRONT;
  PaperFitOptions paper_fit;   ///< for FitMode::PAPER
  FitOptions full_fit;         ///< for FitMode::FULL
  ViewOptions view;            ///< for Decomposition::PARTS: what is known of the view
  ObjectFitOptions object_fit; ///< for Decomposition::PARTS
  double grasp_threshold = 0.05; ///< largest |G - 1| of a grasp point, (0, 1]
  ProgressCallback progress;     ///< is told the stages of the work (optional)

  /** \brief The paper's chain, as it stands (II-B, III): prisms, e1, e2 and a3. */
  static EstimationOptions paper();
  /** \brief The best this library can do with one view: points, outline and table,
   * shapes and number of parts chosen by the data. The same as EstimationOptions{}. */
  static EstimationOptions best();

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

} // namespace pcl_sq
