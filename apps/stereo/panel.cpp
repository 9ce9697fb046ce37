// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/panel.h"

#include "pcl_sq/stereo/histogram_plot.h"
#include "stereo/image_tiles.h"
#include "stereo/view_canvas.h"

#include <opencv2/imgproc.hpp>

#include <string>

namespace pcl_sq::app {
namespace {

const cv::Size TILE(480, 520);
constexpr int CAPTION = 34;
constexpr double TURN = 0.55, TILT = 0.30; // of the views from the side [rad]
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

/** \brief The cloud in its box, the histogram that gave the box's depth above it. */
cv::Mat queryTile(const PanelInput& in) {
  const cv::Size plot(TILE.width, 140);
  const RoiBox around = grown(in.region, 0.25);
  ViewCanvas canvas(
      cv::Size(TILE.width, TILE.height - plot.height), around, TURN, TILT);
  const Dots scene = dotsOf(*in.cloud, around, 0.55);
  const Dots object = dotsOf(*in.object, around, 0.0);
  canvas.addPoints(scene.points, scene.colors, 3);
  canvas.addPoints(object.points, object.colors, 3);
  canvas.addWireBox(in.region, {40, 40, 220}, 2);
  cv::Mat tile;
  cv::vconcat(plotDepthHistogram(in.histogram, in.disparity_scale, plot),
              canvas.picture(),
              tile);
  return tile;
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
    canvas.addSolidBox(in.report.prisms[i].box, partTint(i), 0.45);
    canvas.addWireBox(in.report.prisms[i].box, partTint(i), 2);
  }
  return canvas.picture().clone();
}

/** \brief The points in the colours of their parts. */
cv::Mat partTile(const PanelInput& in) {
  ViewCanvas canvas(TILE, grown(in.region, 0.05), TURN, TILT);
  Dots dots;
  for (const auto& p : *in.object) {
    const Eigen::Vector3d v = p.getVector3fMap().cast<double>();
    if (!v.allFinite())
      continue;
    dots.points.push_back(v);
    const cv::Vec3b part = partTint(in.model.nearestPart(v));
    // half the colour of the part, half that of the image
    dots.colors.emplace_back(
        (part[0] * 2 + p.b) / 3, (part[1] * 2 + p.g) / 3, (part[2] * 2 + p.r) / 3);
  }
  canvas.addPoints(dots.points, dots.colors, 3);
  return canvas.picture().clone();
}

/** \brief The model from the side; what the camera could not see is lighter. */
cv::Mat modelTile(const PanelInput& in) {
  const Eigen::AlignedBox3d box = in.model.boundingBox();
  RoiBox focus;
  focus.min = box.min();
  focus.max = box.max();
  ViewCanvas canvas(TILE, grown(focus, 0.05), TURN, TILT);
  const Dots object = dotsOf(*in.object, grown(focus, 0.3), 0.0);
  canvas.addPoints(object.points, object.colors, 2);
  canvas.addModel(in.model, Eigen::Vector3d::Zero(), 0.6);
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
  place(panel, 0, 0, segmentTile(in, TILE), "(a) segmented object");
  place(panel, 1, 0, queryTile(in), "(b) aperture and query region");
  // the best mode has outline and parts where the paper has voxels and prisms
  const bool paper = !in.report.voxels.empty();
  place(panel,
        2,
        0,
        paper ? voxelTile(in) : outlineTile(in, TILE),
        paper ? "(c) voxels" : "(c) outline and its tangents");
  place(panel,
        0,
        1,
        paper ? prismTile(in) : partTile(in),
        paper ? "(d) prisms" : "(d) parts of the cloud");
  place(panel, 1, 1, predictionTile(in, TILE), "(e) the model's outline in the image");
  place(panel, 2, 1, modelTile(in), "(f) superquadrics; lighter: the unseen side");
  return panel;
}

} // namespace pcl_sq::app
