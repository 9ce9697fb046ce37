// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/object_view.h"
#include "pcl_sq/view_fit.h"

namespace pcl_sq {

/** \brief Settings of fitObject(). */
struct PCL_SQ_EXPORTS ObjectFitOptions {
  /** \brief Largest number of parts that is looked for, [0, 64]; 0: 6 where a camera
   * saw the object, 16 where it is seen from all round. A number that is given for the
   * latter asks for detail: parts that explain no more than .5 % of its size. */
  int max_parts = 0;
  int parts = 0;             ///< number of parts; 0: found, [0, 64]
  int silhouette_lines = 48; ///< per part, [8, 360]
  ViewFitOptions fit;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief An object as a union of superquadrics. */
struct ObjectFit {
  MultiSuperquadric model;
  std::vector<ViewFit> parts; ///< one per part of the model
  std::vector<int> labels;    ///< part of each observed point, -1: none
  double bic = 0.0;           ///< of the whole object
  double misfit = 0.0;        ///< cost of one superquadric per independent point
};

/** \brief Fits one superquadric, or as many as the data ask for.
 * \return without parts if the points give none */
PCL_SQ_EXPORTS ObjectFit fitObject(const ObservedObject& observed,
                                   const ObjectFitOptions& options = {});

} // namespace pcl_sq
