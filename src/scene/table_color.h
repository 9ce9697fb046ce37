// SPDX-License-Identifier: BSD-3-Clause
// Private. What colour tells where depth does not: the rims that matching fattens, and
// the lowest parts of things, which depth cannot tell from the table.
#pragma once

#include "patches/patches.h"

namespace pcl_sq::detail {

/** \brief The table's colour by place. */
class TableColor {
public:
  /** \param[in] above pixels that are not the table's */
  TableColor(const SceneView& view, const CellMask& above);

  /** \brief Patches that are but rims of the table's colour beside others that have
   * another one: depth that matching windows have given to the table beside a thing. A
   * thing of the table's own colour has no such rim. */
  [[nodiscard]] std::vector<bool> rimsOf(const Patches& patches) const;

  /** \brief Takes away what borders on other pixels and has the table's colour: depth
   * that the sensor has given to the table beside a thing. What has the table's colour
   * throughout stays whole. */
  void removeHalo(CellMask& pixels) const;

  /** \brief Adds to things the pixels at the height of the table that have their colour
   * and not the table's. */
  void growFeet(LabelImage& labels) const;

  /** \brief Of each label whether its pixels end where the colour does: their outline
   * is then as sharp as a mask's. */
  [[nodiscard]] std::vector<bool> outlined(const LabelImage& labels) const;

private:
  /** \brief Mean colour of a pixel and its neighbours. */
  Eigen::Vector4f shadeAt(int x, int y) const;
  Eigen::Vector4f near(int x, int y) const;
  /** \brief Whether a pixel with depth is at the height of the table. */
  bool isLow(int pixel) const;
  bool isFootOfOther(const LabelImage& labels, int x, int y) const;

  const SceneView& view_;
  int columns_ = 0, rows_ = 0;
  std::vector<Eigen::Vector4f> cells_; ///< mean shade, of a coarse grid
  float like_ = 0.0F; ///< how far a mean over several of the table's pixels is from it
};

} // namespace pcl_sq::detail
