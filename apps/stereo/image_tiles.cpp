// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/image_tiles.h"

#include "stereo/view_canvas.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::app {
namespace {

const cv::Scalar TILE_PAPER(248, 246, 244), OWN(70, 175, 40), FOREIGN(50, 50, 225),
    TANGENT(225, 140, 40), MASK(40, 40, 230), BOX(40, 200, 240);

/** \brief A window of the image, enlarged to a tile. */
struct Window {
  cv::Rect source;    ///< in the image [px]
  double scale = 1.0; ///< pixels of the tile per pixel of the image
  cv::Point offset;   ///< of the window in the tile [px]

  /** \brief The window around the query with the tile's proportions. */
  Window(const CellRect& rect, const cv::Size& image, const cv::Size& tile) {
    const double height =
        std::max(1.35 * rect.height, 1.35 * rect.width * tile.height / tile.width);
    source.width =
        std::min(image.width, static_cast<int>(height * tile.width / tile.height));
    source.height = std::min(image.height, static_cast<int>(height));
    source.width = std::max(1, source.width);
    source.height = std::max(1, source.height);
    source.x = std::clamp(
        rect.x + (rect.width - source.width) / 2, 0, image.width - source.width);
    source.y = std::clamp(
        rect.y + (rect.height - source.height) / 2, 0, image.height - source.height);
    scale = std::min(static_cast<double>(tile.width) / source.width,
                     static_cast<double>(tile.height) / source.height);
    offset = {(tile.width - static_cast<int>(scale * source.width)) / 2,
              (tile.height - static_cast<int>(scale * source.height)) / 2};
  }
  cv::Mat cut(const cv::Mat& image, const cv::Size& tile) const {
    cv::Mat scaled, result(tile, CV_8UC3, TILE_PAPER);
    const cv::Size size(static_cast<int>(scale * source.width),
                        static_cast<int>(scale * source.height));
    cv::resize(image(source),
               scaled,
               size,
               0,
               0,
               scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
    scaled.copyTo(result(cv::Rect(offset, size)));
    return result;
  }
  /** \brief A pixel of the image in the tile; centres are at whole numbers in both. */
  cv::Point2d toTile(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - source.x + 0.5) * scale - 0.5 + offset.x,
            (pixel.y() - source.y + 0.5) * scale - 0.5 + offset.y};
  }
  PinholeCamera toTile(PinholeCamera camera) const {
    const cv::Point2d center = toTile(Eigen::Vector2d(camera.cx, camera.cy));
    camera.fx *= scale;
    camera.fy *= scale;
    camera.cx = center.x;
    camera.cy = center.y;
    return camera;
  }
};

cv::Mat dimmed(const cv::Mat& image) {
  cv::Mat result;
  image.convertTo(result, -1, 0.35, 90);
  return result;
}

constexpr int LINES = 48;    // as many as the fit has for each part
constexpr double STUB = 9.0; // what sticks out of a tangent's piece [px of the tile]

/** \brief The tangents' polygon: each line as far as the next ones, and a little more.
 */
void drawTangents(const std::vector<SilhouetteLine>& lines,
                  const Window& window,
                  cv::Mat& tile) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const SilhouetteLine& line = lines[i];
    const Eigen::Vector2d along(-line.direction.y(), line.direction.x());
    double from = 0.0, to = 0.0; // from the contact [px]
    for (const std::size_t step : {std::size_t{1}, lines.size() - 1}) {
      const SilhouetteLine& other = lines[(i + step) % lines.size()];
      const double slope = other.direction.dot(along);
      // where a direction was left out, the next line is no neighbour
      if (other.direction.dot(line.direction) < 0.9 || std::abs(slope) < 1e-6)
        continue;
      const double t = (other.offset - other.direction.dot(line.contact)) / slope;
      from = std::min(from, t);
      to = std::max(to, t);
    }
    const double stub = STUB / window.scale;
    cv::line(tile,
             window.toTile(line.contact + (from - stub) * along),
             window.toTile(line.contact + (to + stub) * along),
             TANGENT,
             1,
             cv::LINE_AA);
  }
}

} // namespace

cv::Mat segmentTile(const PanelInput& in, const cv::Size& size) {
  cv::Mat shown = in.image.clone();
  if (!in.mask.empty()) {
    dimmed(in.image).copyTo(shown, in.mask == 0);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(in.mask, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    cv::drawContours(shown, contours, -1, MASK, 1, cv::LINE_AA);
  }
  cv::rectangle(
      shown, cv::Rect(in.rect.x, in.rect.y, in.rect.width, in.rect.height), BOX, 1);
  return Window(in.rect, shown.size(), size).cut(shown, size);
}

cv::Mat outlineTile(const PanelInput& in, const cv::Size& size) {
  const Window window(in.rect, in.image.size(), size);
  cv::Mat tile = window.cut(dimmed(in.image), size);
  const ObservedObject& view = in.report.view;
  drawTangents(silhouetteLines(view.contour, LINES), window, tile);
  const int radius = std::clamp(static_cast<int>(0.3 * window.scale), 1, 3);
  for (const ContourPoint& point : view.contour)
    cv::circle(tile,
               window.toTile(point.pixel),
               radius,
               point.own ? OWN : FOREIGN,
               cv::FILLED,
               cv::LINE_AA);
  return tile;
}

cv::Mat predictionTile(const PanelInput& in, const cv::Size& size) {
  const Window window(in.rect, in.image.size(), size);
  ViewCanvas canvas(window.cut(in.image, size), window.toTile(in.camera));
  canvas.addModel(in.model, in.camera.center, 0.35);
  canvas.addOutlines(in.model);
  return canvas.picture().clone();
}

} // namespace pcl_sq::app
