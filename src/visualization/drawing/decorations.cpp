// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/ink.h"
#include "visualization/drawing/overlay.h"
#include "visualization/drawing/scale_bar.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq {
namespace {

constexpr Color INK = {40, 44, 52}, PALE_INK = {104, 110, 120};
constexpr std::size_t LEGEND_LINES = 12; ///< more parts are counted in one last line

void drawTitle(Overlay& overlay, double text, const SnapshotOptions& options) {
  double y = 1.4 * text;
  if (!options.title.empty()) {
    overlay.text(options.title,
                 text,
                 y,
                 1.35 * text,
                 inkOn(options.background, INK),
                 Align::LEFT,
                 true);
    y += 1.7 * text;
  }
  if (!options.caption.empty())
    overlay.text(options.caption, text, y, text, inkOn(options.background, PALE_INK));
}

void drawScaleBar(Overlay& overlay,
                  double text,
                  const SnapshotOptions& options,
                  const ViewCamera& camera) {
  const ScaleBar bar = roundScaleBar(0.25 * overlay.width() / camera.pixelsPerMeter());
  const double length = bar.length * camera.pixelsPerMeter();
  const double x = overlay.width() - 1.2 * text - length;
  const double y = overlay.height() - 1.2 * text;
  const Color ink = inkOn(options.background, INK);
  overlay.rectangle(x - 0.5 * text,
                    y - 1.9 * text,
                    length + text,
                    2.6 * text,
                    options.background,
                    0.75);
  const double thickness = std::max(1.0, 0.14 * text);
  overlay.rectangle(x, y - 0.5 * thickness, length, thickness, ink);
  for (const double end : {x, x + length - thickness})
    overlay.rectangle(end, y - 0.3 * text, thickness, 0.6 * text, ink);
  overlay.text(bar.label, x + 0.5 * length, y - 1.0 * text, text, ink, Align::CENTER);
}

/** \brief The cloud's axes as the picture shows them; nearer ones drawn last. */
void drawTriad(Overlay& overlay,
               double text,
               const SnapshotOptions& options,
               const ViewCamera& camera) {
  static constexpr std::array<Color, 3> colors = {
      {{196, 48, 43}, {38, 140, 62}, {38, 84, 196}}};
  static constexpr std::array<const char*, 3> names = {"x", "y", "z"};
  const auto color = [&options](int axis) {
    return isLight(options.background) ? colors[axis]
                                       : mix(colors[axis], {255, 255, 255}, 0.4);
  };
  const double length = 2.6 * text;
  const Eigen::Vector2d origin(4.2 * text, overlay.height() - 4.2 * text);
  Eigen::Matrix2Xd disc(2, 48);
  for (int i = 0; i < 48; ++i)
    disc.col(i) =
        origin +
        4.0 * text * Eigen::Vector2d(std::cos(i * M_PI / 24), std::sin(i * M_PI / 24));
  overlay.polygon(disc, options.background, 0.75);
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return camera.forward()[a] > camera.forward()[b];
  });
  const double width = std::max(1.5, 0.16 * text);
  for (const int axis : order) {
    const Eigen::Vector2d tip(camera.right()[axis], -camera.up()[axis]);
    const Eigen::Vector2d end = origin + length * tip;
    const double shown = tip.norm();
    if (shown < 0.05) {
      // along the line of sight: a dot where an arrow would have no direction
      Eigen::Matrix2Xd dot(2, 16);
      for (int i = 0; i < 16; ++i)
        dot.col(i) = origin + 0.28 * text *
                                  Eigen::Vector2d(std::cos(i * M_PI / 8),
                                                  std::sin(i * M_PI / 8));
      overlay.polygon(dot, color(axis));
      overlay.text(names[axis],
                   origin.x() - 0.9 * text,
                   origin.y() + 0.8 * text,
                   0.9 * text,
                   color(axis),
                   Align::CENTER,
                   true);
      continue;
    }
    const Eigen::Vector2d along = tip / shown;
    const Eigen::Vector2d side(-along.y(), along.x());
    const double head = std::min(0.75 * text, 0.6 * length * shown);
    overlay.stroke(origin, end - 0.8 * head * along, width, color(axis));
    Eigen::Matrix2Xd arrow(2, 3);
    arrow << end, end - head * along + 0.4 * head * side,
        end - head * along - 0.4 * head * side;
    overlay.polygon(arrow, color(axis));
    const Eigen::Vector2d label = end + 0.65 * text * along;
    overlay.text(names[axis],
                 label.x(),
                 label.y(),
                 0.9 * text,
                 color(axis),
                 Align::CENTER,
                 true);
  }
}

void drawLegend(Overlay& overlay, double text, const SnapshotScene& scene) {
  const std::size_t parts = scene.model.parts.size();
  const std::size_t lines = std::min(parts, LEGEND_LINES);
  const double step = 1.5 * text;
  const double x = overlay.width() - 5.6 * text;
  double y = 1.4 * text;
  const Color ink = inkOn(scene.options.background, INK);
  overlay.rectangle(x - 0.5 * text,
                    y - text,
                    5.6 * text,
                    step * static_cast<double>(lines + (parts > lines ? 1 : 0)) +
                        0.5 * text,
                    scene.options.background,
                    0.75);
  for (std::size_t i = 0; i < lines; ++i, y += step) {
    const Color color = partColor(i);
    const double side = 0.9 * text, rim = std::max(1.0, 0.1 * text);
    overlay.rectangle(
        x, y - 0.5 * side, side, side, strongerOn(scene.options.background, color));
    overlay.rectangle(
        x + rim, y - 0.5 * side + rim, side - 2 * rim, side - 2 * rim, color);
    overlay.text("part " + std::to_string(i + 1), x + 1.4 * text, y, text, ink);
  }
  if (parts > lines)
    overlay.text("+ " + std::to_string(parts - lines) + " more", x, y, text, ink);
}

} // namespace

void drawDecorations(Overlay& overlay,
                     const OverlayLayout& layout,
                     const SnapshotScene& scene,
                     const ViewCamera& camera) {
  if (layout.text == 0.0)
    return;
  drawTitle(overlay, layout.text, scene.options);
  if (scene.options.axes)
    drawTriad(overlay, layout.text, scene.options, camera);
  if (scene.options.scale_bar)
    drawScaleBar(overlay, layout.text, scene.options, camera);
  if (scene.showsLegend())
    drawLegend(overlay, layout.text, scene);
}

} // namespace pcl_sq
