// SPDX-License-Identifier: BSD-3-Clause
// Private. Patches, which of them touch, and how they stand to each other.
#pragma once

#include "patches/patches.h"

namespace pcl_sq::detail {

constexpr std::size_t SCRAP = 150; ///< pixels too few for a body of their own
constexpr double SAME_COLOR = 1.5; ///< of colorDistance()
constexpr double CREASE = 0.35;    ///< mean angle of a fold that may part things [rad]

/** \brief Patches that are joined to things; one that was joined to another is empty.
 */
class PatchGraph {
public:
  PatchGraph(const SceneView& view, Patches patches)
      : view_(view), list_(std::move(patches.list)),
        borders_(std::move(patches.borders)) {}

protected:
  [[nodiscard]] bool alive(int k) const {
    return !list_[std::size_t(k)].pixels.empty();
  }
  /** \brief Whether a patch reaches down to the table. */
  [[nodiscard]] bool stands(const Patch& p) const;
  /** \brief Whether two patches meet without an edge in depth. */
  [[nodiscard]] static bool touches(const Border& border);
  void join(int from, int into);
  [[nodiscard]] bool sameColor(int a, int b, double limit = SAME_COLOR) const;
  /** \brief Distance of two footprints over the larger one's radius. */
  [[nodiscard]] double offset(int a, int b) const;
  /** \brief Whether two patches meet along a good share of the smaller one's width. */
  [[nodiscard]] bool isWide(std::pair<int, int> pair, int pixels) const;
  /** \brief Whether two patches meet at an edge in depth along a good share of the
   * smaller one's width: one of them is before the other. */
  [[nodiscard]] bool isStep(std::pair<int, int> pair) const;
  /** \brief Evidence for one thing where the surface goes on from one patch to the
   * other: of two things that meet, each place where neighbours' errors differ would
   * have to be flush by chance. */
  [[nodiscard]] double flush(std::pair<int, int> pair) const;
  /** \brief Whether a patch stands on a ledge of another thing: a level face at its
   * foot that shows beside it. A lid or a cap leaves none. */
  [[nodiscard]] bool isCarried(int a) const;
  /** \brief Whether a patch ends at another thing before it, lower down, which may hide
   * its foot. */
  [[nodiscard]] bool isHiddenBelow(int a) const;
  /** \brief Of a patch, across the view and level: the standard deviation of its points
   * [m]. */
  [[nodiscard]] double width(int a) const;
  /** \brief Whether a patch goes on in a lower one: about one axis, of one width, and
   * without a fold or a step between them. Of two things that is so by chance hardly
   * ever. */
  [[nodiscard]] bool goesOnIn(int upper, int lower) const;
  /** \brief Whether two patches may be the inside and the outside of a vessel: they
   * meet at an edge in depth and end at one height, the rim's, and one of them stands.
   */
  [[nodiscard]] bool mayShareRim(int a, int b) const;
  /** \brief How far a floating patch is from another, in sizes; infinite out of reach.
   */
  [[nodiscard]] double apart(int a, int b) const;

  const SceneView& view_;
  std::vector<Patch> list_;
  std::map<std::pair<int, int>, Border> borders_;
};

} // namespace pcl_sq::detail
