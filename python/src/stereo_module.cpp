// SPDX-License-Identifier: BSD-3-Clause
// Stereo pairs and depth images; loads OpenCV.
#include "arrays.h"
#include "errors.h"
#include "model/scene_model.h"
#include "point_clouds.h"
#include "stereo/followed_frames.h"
#include "stereo/stereo_cloud.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <mutex>

namespace pcl_sq::python {

namespace {

using Words = std::vector<std::string>;

enum class Kind { PICTURE, DEPTH, MASK };

/** \brief Height x width of an array, x 3 if it may and does have colours. A last side
 * of one, as OpenCV's grey images have it, is none. */
cv::Mat sharedImage(const py::array& array, int depth, bool color) {
  return {int(array.shape(0)),
          int(array.shape(1)),
          CV_MAKETYPE(depth, color ? 3 : 1),
          const_cast<void*>(array.data())};
}

/** \brief An image as OpenCV has it, BGR: pictures of bytes or 16 bits, depths of these
 * or of floats, masks of anything that is zero or not. */
cv::Mat imageOf(const py::array& array, const char* name, Kind kind) {
  const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  const bool color = kind == Kind::PICTURE && channels == 3;
  if ((array.ndim() != 2 && array.ndim() != 3) || (channels != 1 && !color))
    throw std::invalid_argument(std::string(name) +
                                " wants an array of height x width" +
                                (kind == Kind::PICTURE ? ", or x 3 for RGB" : "") +
                                ", not " + shapeText(array));
  if (array.size() == 0)
    throw std::invalid_argument(std::string(name) + " holds no pixels");
  const char type = array.dtype().kind();
  constexpr int COPY = py::array::c_style | py::array::forcecast;
  cv::Mat image;
  if (kind == Kind::MASK) {
    const auto set = py::array_t<bool, COPY>(array);
    image = sharedImage(set, CV_8U, false) > 0;
  } else if (type == 'u' && array.itemsize() == 1)
    image = sharedImage(py::array_t<std::uint8_t, COPY>(array), CV_8U, color).clone();
  else if (type == 'u' && array.itemsize() == 2)
    image = sharedImage(py::array_t<std::uint16_t, COPY>(array), CV_16U, color).clone();
  else if (type == 'f' && kind == Kind::DEPTH)
    image = sharedImage(py::array_t<float, COPY>(array), CV_32F, false).clone();
  else
    throw py::type_error(std::string(name) + " wants uint8" +
                         (kind == Kind::DEPTH ? ", uint16 or floats" : " or uint16"));
  if (color)
    cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
  return image;
}

py::array cloudArray(const pcl::PointCloud<pcl::PointXYZRGB>& cloud, bool colors) {
  const std::vector<py::ssize_t> shape = {
      py::ssize_t(cloud.height), py::ssize_t(cloud.width), 3};
  if (colors) {
    py::array_t<std::uint8_t> result(shape);
    std::uint8_t* out = result.mutable_data();
    for (const auto& p : cloud)
      for (const std::uint8_t c : {p.r, p.g, p.b})
        *out++ = c;
    return result;
  }
  py::array_t<float> result(shape);
  float* out = result.mutable_data();
  for (const auto& p : cloud)
    for (const float c : {p.x, p.y, p.z})
      *out++ = c;
  return result;
}

using Image = std::optional<py::array>;

/** \brief The images that are given, and the names that they have in messages. */
struct GivenImages {
  app::FrontOptions front;
  std::string left_name, right_name, depth_name;

  GivenImages(const Image& left, const Image& right, const Image& depth) {
    take(left, depth ? "color" : "left", Kind::PICTURE, front.left_image, left_name);
    take(right, "right", Kind::PICTURE, front.right_image, right_name);
    take(depth, "depth", Kind::DEPTH, front.depth_image, depth_name);
  }

  static void take(const Image& array,
                   const char* name,
                   Kind kind,
                   cv::Mat& image,
                   std::string& path) {
    if (!array)
      return;
    image = imageOf(*array, name, kind);
    path = name;
  }

  /** \brief What no word of a command line says. */
  void
  finish(const app::ModelOptions& model, double depth_scale, const Words& calibration) {
    front.left = left_name;
    front.right = right_name;
    front.depth = depth_name;
    front.depth_scale = depth_scale;
    front.calib = calibration;
    front.intrinsics = model.intrinsics;
  }
};

py::object colorsLike(const StereoView& seen) {
  return seen.stereo.left.empty() ? py::object(py::none())
                                  : py::object(cloudArray(*seen.stereo.cloud, true));
}

/** \brief What makes models of pairs and depth images, frame by frame or each for
 * itself. */
class Frames {
public:
  explicit Frames(bool following) : following_(following) {}

  py::tuple estimate(const Image& left,
                     const Image& right,
                     const Image& depth,
                     const Image& mask,
                     double depth_scale,
                     const Words& calibration,
                     const Words& words) {
    GivenImages images(left, right, depth);
    app::FrontOptions& front = images.front;
    app::ModelOptions model;
    std::string mask_name;
    GivenImages::take(mask, "mask", Kind::MASK, front.mask_image, mask_name);
    StereoView seen;
    const app::StereoModel made = guarded([&] {
      app::parseWords(
          "pcl_sq_stereo",
          [&](CLI::App& cli) {
            app::addFrontOptions(cli, front);
            app::addModelOptions(cli, model);
          },
          words);
      images.finish(model, depth_scale, calibration);
      front.mask = model.mask = mask_name;
      front.sequence = following_;
      app::chooseMatcher(model, front);
      app::checkFrontOptions(front, model.roi);
      app::checkModelOptions(model);
      const std::lock_guard<std::mutex> lock(one_); // Python's threads may share it
      return frames_.next(front, model, seen);
    });
    return py::make_tuple(
        toJson(made.result.file),
        cloudArray(*seen.stereo.cloud, false),
        colorsLike(seen),
        std::vector<std::int64_t>(made.result.report.object_indices.begin(),
                                  made.result.report.object_indices.end()));
  }

private:
  bool following_;
  std::mutex one_;
  app::FollowedFrames frames_;
};

/** \brief All things in a pair or a depth image, as pcl_sq_scene finds them. */
py::tuple estimateScene(const Image& left,
                        const Image& right,
                        const Image& depth,
                        const Image& labels,
                        double depth_scale,
                        const Words& calibration,
                        const Words& words) {
  GivenImages images(left, right, depth);
  app::FrontOptions& front = images.front;
  app::ModelOptions model;
  app::SceneChoices choices;
  if (labels)
    choices.labels = labelsOf(*labels);
  StereoView seen;
  app::SceneResult result = guarded([&] {
    app::parseWords(
        "pcl_sq_scene",
        [&](CLI::App& cli) {
          app::addPairOptions(cli, front);
          app::addSceneOptions(cli, model, choices);
        },
        words);
    images.finish(model, depth_scale, calibration);
    app::checkPairOptions(front);
    app::checkModelOptions(model);
    seen = app::readSceneViews(front, model);
    return app::makeSceneFile(
        app::toLoadedCloud(*seen.stereo.cloud, nullptr), "", model, choices, 0.0);
  });
  result.file.notes.insert(
      result.file.notes.begin(), seen.notes.begin(), seen.notes.end());
  LabelImage numbers = app::numberedPixels(result);
  return py::make_tuple(
      toJson(result.file),
      cloudArray(*seen.stereo.cloud, false),
      colorsLike(seen),
      ownedArray(std::move(numbers.values), {numbers.height, numbers.width}));
}

} // namespace

} // namespace pcl_sq::python

PYBIND11_MODULE(_stereo, module) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl_sq::python::raiseOptionErrors();
  pybind11::class_<pcl_sq::python::Frames>(module, "Frames")
      .def(pybind11::init<bool>())
      .def("estimate", &pcl_sq::python::Frames::estimate);
  module.def("estimate_scene", &pcl_sq::python::estimateScene);
}
