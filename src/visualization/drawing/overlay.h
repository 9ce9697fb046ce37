// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/drawing/scene.h"

#include <string>

class vtkRenderer;

namespace pcl_sq {

/** \brief Where a text is anchored. */
enum class Align { LEFT, CENTER, RIGHT };

/** \brief Flat drawing on top of a picture, in pixels from the top left corner. */
class Overlay {
public:
  /** \param[in] zoom pixels of the rendering per pixel of the picture */
  Overlay(vtkRenderer* renderer, int width, int height, double zoom)
      : renderer_(renderer), width_(width), height_(height), zoom_(zoom) {}

  int width() const { return width_; }
  int height() const { return height_; }
  /** \brief Filled convex polygon, corners as columns. */
  void polygon(const Eigen::Matrix2Xd& corners, Color color, double opacity = 1.0);
  void rectangle(double x, double y, double w, double h, Color color, double o = 1.0);
  /** \brief Straight stroke of that thickness. */
  void
  stroke(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width, Color color);
  /** \brief UTF-8 text, vertically centred on \a y. \return its width */
  double text(const std::string& utf8,
              double x,
              double y,
              double size,
              Color color,
              Align align = Align::LEFT,
              bool bold = false);

private:
  vtkRenderer* renderer_;
  int width_, height_;
  double zoom_;
};

/** \brief Sizes that follow from the picture's: everything is in proportion. */
struct OverlayLayout {
  /** \brief Height of the ordinary text [px]; zero: too small for any decoration. */
  double text = 0.0;
  FrameMargins margins; ///< room that the decorations need around the object

  explicit OverlayLayout(const SnapshotScene& scene);
};

/** \brief Title, caption, triad, scale bar and legend as the options ask for. */
void drawDecorations(Overlay& overlay,
                     const OverlayLayout& layout,
                     const SnapshotScene& scene,
                     const ViewCamera& camera);

} // namespace pcl_sq
