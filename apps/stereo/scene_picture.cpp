// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/scene_picture.h"

#include "command_line/app.h"
#include "files/image_file.h"
#include "stereo/view_canvas.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace pcl_sq::app {

namespace {

constexpr double OPACITY = 0.45;
constexpr int DIVISIONS = 32;                        ///< of a part's mesh
constexpr double VIEW_TURN = 0.55, VIEW_TILT = 0.35; ///< of the view in space [rad]

/** \brief The cloud's colours as its image; where it has none, what is near is dark. */
cv::Mat imageOf(const LoadedCloud& input) {
  const auto& cloud = *input.cloud;
  cv::Mat image(int(cloud.height), int(cloud.width), CV_8UC3, cv::Scalar::all(235));
  double near = 1e300, far = 0.0;
  for (const auto& p : cloud)
    if (std::isfinite(p.z)) {
      near = std::min(near, double(p.z));
      far = std::max(far, double(p.z));
    }
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& p = cloud.at(x, y);
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      if (input.has_color)
        pixel = {p.b, p.g, p.r};
      else if (std::isfinite(p.z))
        pixel = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(
            90.0 + 130.0 * (p.z - near) / std::max(far - near, 1e-9)));
    }
  return image;
}

/** \brief A number on a white disc. */
void drawNumber(cv::Mat& picture, const Eigen::Vector3d& at, std::size_t number) {
  if (!(at.z() > 0.0) || std::abs(at.x()) > 1e5 || std::abs(at.y()) > 1e5)
    return;
  const std::string text = std::to_string(number);
  const double scale = 0.5;
  int below = 0;
  const cv::Size size =
      cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &below);
  const cv::Point middle(int(at.x()), int(at.y()));
  cv::circle(picture,
             middle,
             4 + std::max(size.width, size.height) / 2,
             cv::Scalar::all(255),
             cv::FILLED,
             cv::LINE_AA);
  cv::putText(picture,
              text,
              middle + cv::Point(-size.width / 2, size.height / 2),
              cv::FONT_HERSHEY_SIMPLEX,
              scale,
              cv::Scalar::all(20),
              1,
              cv::LINE_AA);
}

/** \brief All models and their numbers. */
cv::Mat drawThings(ViewCanvas& canvas,
                   const std::vector<MultiSuperquadric>& models,
                   double opacity) {
  for (std::size_t k = 0; k < models.size(); ++k)
    canvas.addMesh(models[k].meshParts(DIVISIONS), partTint(k), opacity);
  cv::Mat picture = canvas.picture().clone();
  for (std::size_t k = 0; k < models.size(); ++k)
    drawNumber(picture, canvas.project(models[k].boundingBox().center()), k + 1);
  return picture;
}

/** \brief The things and the points about them from the side. */
cv::Mat inSpace(const LoadedCloud& input,
                const std::vector<MultiSuperquadric>& models,
                const PinholeCamera& camera,
                const cv::Size& size) {
  // seen from beside the camera, in its frame, which the canvas wants
  const auto toCamera = [&camera](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return camera.rotation.transpose() * (p - camera.center);
  };
  Eigen::AlignedBox3d box;
  std::vector<MultiSuperquadric> seen = models;
  for (MultiSuperquadric& model : seen) {
    for (Superquadric& part : model.parts) {
      part.center = toCamera(part.center);
      part.rotation = camera.rotation.transpose() * part.rotation;
    }
    box.extend(model.boundingBox());
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.05 * box.sizes().norm());
  RoiBox focus;
  focus.min = box.min() - margin;
  focus.max = box.max() + margin;
  ViewCanvas canvas(size, focus, VIEW_TURN, VIEW_TILT);
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Vec3b> colors;
  const cv::Mat image = imageOf(input);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& p = input.cloud->at(x, y);
      const Eigen::Vector3d v = toCamera(p.getVector3fMap().cast<double>());
      if (!v.allFinite() || !focus.contains(v))
        continue;
      points.push_back(v);
      colors.push_back(image.at<cv::Vec3b>(y, x));
    }
  canvas.addPoints(points, colors, 2);
  return drawThings(canvas, seen, 0.6);
}

} // namespace

cv::Mat drawScene(const LoadedCloud& input, const SceneResult& result) {
  std::vector<MultiSuperquadric> models;
  for (const ModelResult& thing : result.things) {
    models.push_back(thing.file.model);
    for (Superquadric& part : models.back().parts)
      part.center -= input.offset;
  }
  PinholeCamera camera = result.things.front().report.view.camera;
  camera.center -= input.offset;
  const cv::Mat image = imageOf(input);
  ViewCanvas canvas(image, camera);
  cv::Mat panel;
  cv::hconcat(drawThings(canvas, models, OPACITY),
              inSpace(input, models, camera, image.size()),
              panel);
  return panel;
}

cv::Mat labelImage(const SceneResult& result) {
  LabelImage labels = numberedPixels(result);
  cv::Mat image =
      cv::Mat(labels.height, labels.width, CV_16U, labels.values.data()).clone();
  if (result.numbers.size() < 256)
    image.convertTo(image, CV_8U);
  return image;
}

LabelImage readLabels(const std::string& path) {
  const cv::Mat image = readNumbers(path);
  const bool wide = image.depth() == CV_16U;
  if (image.channels() != 1 || (!wide && image.depth() != CV_8U))
    throw Failure("'" + path +
                  "' is a picture, not labels; give one channel of 8 or 16 bits, 0 "
                  "where there is no thing and another number for each thing.");
  LabelImage labels(image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      labels.values[std::size_t(y) * std::size_t(image.cols) + std::size_t(x)] =
          wide ? image.at<std::uint16_t>(y, x) : image.at<std::uint8_t>(y, x);
  return labels;
}

} // namespace pcl_sq::app
