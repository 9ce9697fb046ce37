// SPDX-License-Identifier: BSD-3-Clause
// Private. Whether a model is what was seen, judged before it is handed out.
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/object_view.h"

namespace pcl_sq::detail {

/** \brief What a model explains of what was seen, shares of 0 to 1. */
struct Verdict {
  double points = 1.0; ///< of the points, to within their noise and the model's error
  double pixels = 1.0; ///< of the object's pixels, that the model covers
  double background = 1.0; ///< of the pixels it covers, where none is seen through it

  /** \brief Median distance of the points to the model, beyond their noise, over twice
   * their root mean square distance to their middle: about their size. */
  double off = 0.0;

  /** \brief The three shares together. */
  double confidence() const { return points * pixels * background; }
  /** \brief Why the model is not to be believed and what helps, a sentence; empty where
   * it is. */
  std::string objection() const;
};

/** \brief Points farther from a model are not its surface [m]. \param[in] noise of the
 * points where the view does not tell [m] */
[[nodiscard]] double farthestOnSurface(const ObservedObject& observed, double noise);

/** \param[in] noise as in farthestOnSurface() */
[[nodiscard]] Verdict
judge(const MultiSuperquadric& model, const ObservedObject& observed, double noise);

} // namespace pcl_sq::detail
