// SPDX-License-Identifier: BSD-3-Clause
#include "panel.h"

#include "pcl_sq/stereo/histogram_plot.h"
#include "view_canvas.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_sq::app {
namespace {

const cv::Size TILE(480, 520);
constexpr int CAPTION = 34;
constexpr double TURN = 0.55, TILT = 0.30; // of the views from the side [rad]
const cv::Vec3b PALETTE[] = {{60, 110, 235},
                             {200, 140, 50},
                             {90, 170, 60},
                             {170, 80, 170},
                             {60, 190, 220},
                             {180, 170, 60}};

cv::Vec3b colorOf(std::size_t part) {
  return PALETTE[part % (sizeof(PALETTE) / sizeof(PALETTE[0]))];
}

struct Dots {
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Vec3b> colors;
};

/** \brief Finite points, bleached towards white by \a pale. */
Dots dotsOf(const pcl::PointCloud<pcl::PointXYZRGBA>& cloud,
            const RoiBox& bounds,
            double pale) {
  Dots dots;
  for (const auto& p : cloud) {
    const Eigen::Vector3d v = p.getVector3fMap().cast<double>();
    if (!v.allFinite() || !bounds.contains(v))
      continue;
    dots.points.push_back(v);
    const auto mix = [pale](std::uint8_t c) {
      return cv::saturate_cast<std::uint8_t>(c + pale * (250.0 - c));
    };
    dots.colors.emplace_back(mix(p.b), mix(p.g), mix(p.r));
  }
  return dots;
}

RoiBox grown(RoiBox box, double share) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(share * box.sizes().norm());
  box.min -= margin;
  box.max += margin;
  return box;
}

/** \brief Window of the image around the query with the tile's proportions. */
cv::Rect windowAround(const PixelRect& rect, const cv::Mat& image) {
  const double height =
      std::max(1.35 * rect.height, 1.35 * rect.width * TILE.height / TILE.width);
  cv::Rect r(0,
             0,
             std::min(image.cols, static_cast<int>(height * TILE.width / TILE.height)),
             std::min(image.rows, static_cast<int>(height)));
  r.x = std::clamp(rect.x + rect.width / 2 - r.width / 2, 0, image.cols - r.width);
  r.y = std::clamp(rect.y + rect.height / 2 - r.height / 2, 0, image.rows - r.height);
  return r;
}

cv::Mat imageTile(const PanelInput& in) {
  cv::Mat shown = in.image.clone();
  const cv::Rect box(in.rect.x, in.rect.y, in.rect.width, in.rect.height);
  if (!in.mask.empty()) {
    cv::Mat dimmed;
    in.image.convertTo(dimmed, -1, 0.35, 90);
    dimmed.copyTo(shown, in.mask == 0);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(in.mask, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    cv::drawContours(shown, contours, -1, {40, 40, 230}, 1, cv::LINE_AA);
  }
  cv::rectangle(shown, box, {40, 200, 240}, 1);
  const cv::Mat part = shown(windowAround(in.rect, shown));
  const double s = std::min(static_cast<double>(TILE.width) / part.cols,
                            static_cast<double>(TILE.height) / part.rows);
  cv::Mat scaled, tile(TILE, CV_8UC3, cv::Scalar(248, 246, 244));
  cv::resize(part, scaled, {}, s, s, s < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  scaled.copyTo(tile(cv::Rect((TILE.width - scaled.cols) / 2,
                              (TILE.height - scaled.rows) / 2,
                              scaled.cols,
                              scaled.rows)));
  return tile;
}

cv::Mat queryTile(const PanelInput& in) {
  const RoiBox around = grown(in.region, 0.25);
  ViewCanvas canvas(TILE, around, TURN, TILT);
  const Dots scene = dotsOf(*in.cloud, around, 0.55);
  const Dots object = dotsOf(*in.object, around, 0.0);
  canvas.addPoints(scene.points, scene.colors, 3);
  canvas.addPoints(object.points, object.colors, 3);
  canvas.addWireBox(in.region, {40, 40, 220}, 2);
  return canvas.picture().clone();
}

/** \brief Voxels from back to front, so that the nearer ones are on top. */
cv::Mat voxelTile(const PanelInput& in) {
  ViewCanvas canvas(TILE, grown(in.region, 0.05), TURN, TILT);
  const VoxelLayout& layout = in.report.voxels;
  const Eigen::Vector3d cell = layout.empty() ? in.region.sizes() : layout.cellSizes();
  const Eigen::Vector3i n = layout.divisions;
  for (int k = n.z() - 1; k >= 0; --k)
    for (int j = n.y() - 1; j >= 0; --j)
      for (int i = n.x() - 1; i >= 0; --i) {
        const std::int32_t index = i + n.x() * (j + n.y() * k);
        if (!layout.isValid(index))
          continue;
        RoiBox box;
        box.min = layout.region.min + cell.cwiseProduct(Eigen::Vector3d(i, j, k));
        box.max = box.min + cell;
        canvas.addSolidBox(box, {205, 160, 90}, 0.75);
      }
  canvas.addWireBox(in.region, {40, 40, 220}, 1);
  return canvas.picture().clone();
}

cv::Mat prismTile(const PanelInput& in) {
  ViewCanvas canvas(TILE, grown(in.region, 0.05), TURN, TILT);
  const Dots object = dotsOf(*in.object, in.region, 0.15);
  canvas.addPoints(object.points, object.colors, 3);
  for (std::size_t i = 0; i < in.report.prisms.size(); ++i) {
    canvas.addMesh(meshBox(in.report.prisms[i].box), colorOf(i), 0.45);
    canvas.addWireBox(in.report.prisms[i].box, colorOf(i), 2);
  }
  return canvas.picture().clone();
}

/** \brief The points in the colours of their parts. */
cv::Mat partTile(const PanelInput& in, double turn) {
  ViewCanvas canvas(TILE, grown(in.region, 0.05), turn, turn > 0.0 ? TILT : 0.0);
  Dots dots;
  for (const auto& p : *in.object) {
    const Eigen::Vector3d v = p.getVector3fMap().cast<double>();
    if (!v.allFinite())
      continue;
    dots.points.push_back(v);
    const cv::Vec3b part = colorOf(in.model.nearestPart(v));
    // half the colour of the part, half that of the image
    dots.colors.emplace_back(
        (part[0] * 2 + p.b) / 3, (part[1] * 2 + p.g) / 3, (part[2] * 2 + p.r) / 3);
  }
  canvas.addPoints(dots.points, dots.colors, 3);
  return canvas.picture().clone();
}

cv::Mat modelTile(const PanelInput& in, double turn, double tilt) {
  const Eigen::AlignedBox3d box = in.model.boundingBox();
  RoiBox focus;
  focus.min = box.min();
  focus.max = box.max();
  ViewCanvas canvas(TILE, grown(focus, 0.05), turn, tilt);
  const Dots object = dotsOf(*in.object, grown(focus, 0.3), 0.0);
  canvas.addPoints(object.points, object.colors, 2);
  for (std::size_t i = 0; i < in.model.size(); ++i)
    canvas.addMesh(meshSuperquadric(in.model.parts[i]), colorOf(i), 0.6);
  return canvas.picture().clone();
}

void place(cv::Mat& panel, int column, int row, const cv::Mat& tile, const char* text) {
  const cv::Point at(column * (TILE.width + 8) + 8,
                     row * (TILE.height + CAPTION + 8) + 8);
  tile.copyTo(panel(cv::Rect(at.x, at.y + CAPTION, TILE.width, TILE.height)));
  cv::putText(panel,
              text,
              {at.x + 4, at.y + CAPTION - 11},
              cv::FONT_HERSHEY_SIMPLEX,
              0.62,
              {50, 50, 50},
              1,
              cv::LINE_AA);
}

} // namespace

cv::Mat drawPanel(const PanelInput& in) {
  cv::Mat panel(2 * (TILE.height + CAPTION + 8) + 8,
                3 * (TILE.width + 8) + 8,
                CV_8UC3,
                cv::Scalar::all(255));
  place(panel, 0, 0, imageTile(in), "(a) segmented object");
  cv::Mat query = queryTile(in);
  const cv::Size inset(230, 140);
  const cv::Mat plot = plotDepthHistogram(in.histogram, in.disparity_scale, inset);
  plot.copyTo(query(cv::Rect(TILE.width - inset.width, 0, inset.width, inset.height)));
  place(panel, 1, 0, query, "(b) query region and aperture");
  // the best mode divides by its own rule: its parts' points stand for voxels, prisms
  const bool paper = !in.report.voxels.empty();
  place(panel,
        2,
        0,
        paper ? voxelTile(in) : partTile(in, 0.0),
        paper ? "(c) voxels" : "(c) parts of the cloud");
  place(panel,
        0,
        1,
        paper ? prismTile(in) : partTile(in, TURN),
        paper ? "(d) prisms" : "(d) parts, from the side");
  place(panel, 1, 1, modelTile(in, 0.0, 0.0), "(e) superquadrics, from the camera");
  place(panel, 2, 1, modelTile(in, TURN, TILT), "(e) superquadrics, from the side");
  return panel;
}

} // namespace pcl_sq::app
