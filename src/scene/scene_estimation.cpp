// SPDX-License-Identifier: BSD-3-Clause
// All things on a table: told apart, and each fitted by the estimation of one.
#include "observe/observe_parts.h"
#include "pcl_sq/stage_timer.h"
#include "scene/scene_table.h"
#include "scene/segment_scene.h"
#include "scene/visible_share.h"
#include "sensor/camera_pose.h"
#include "util/option_check.h"
#include "util/parallel_for.h"

#include <pcl/console/print.h>

#include <algorithm>

namespace pcl_sq {

bool SceneOptions::isValid(std::string* why) const {
  detail::OptionCheck check(why);
  check.inRange("min_pixels", min_pixels, 30, 1000000);
  check.require(
      estimation.decomposition == Decomposition::PARTS,
      "a scene's things are fitted by parts; leave the decomposition at PARTS");
  check.require(estimation.view.mask.cells.empty() &&
                    estimation.view.others.cells.empty(),
                "a scene's things have labels, not a mask; use setLabels()");
  return check.passed() && estimation.isValid(why);
}

namespace detail {

namespace {

/** \brief Noise and dilation of an outline that colours told [px]. */
constexpr double FOUND_OUTLINE = 1.0, FOUND_DILATION = 0.7;

bool fail(const std::string& sentence, Scene& scene) {
  scene.failure = sentence;
  scene.objects.clear();
  PCL_WARN("[pcl_sq::SceneEstimation::estimate] %s.\n", sentence.c_str());
  return false;
}

/** \brief One estimation: the input, the settings and what is found. */
class SceneEstimator {
public:
  SceneEstimator(const SceneInput& input,
                 const SceneOptions& options,
                 unsigned int threads,
                 Scene& scene)
      : input_(input), options_(options), threads_(threads), scene_(scene),
        timer_(scene.timings_ms, options.estimation.progress),
        view_(options.estimation.view), points_(input.points) {}

  bool estimate() {
    return timer_.run("look", [&] { return look(); }) &&
           timer_.run("table", [&] { return findTable(); }) &&
           timer_.run("segment", [&] { return tellApart(); }) &&
           timer_.run("fit", [&] { return fitAll(); });
  }

private:
  bool fail(const std::string& sentence) { return detail::fail(sentence, scene_); }

  bool look();
  bool findTable();
  bool tellApart();
  bool fitAll();
  void fit(const pcl::Indices& pixels, SceneObject& object) const;

  const SceneInput& input_;
  const SceneOptions& options_;
  const unsigned int threads_;
  Scene& scene_;
  StageTimer timer_;
  ViewOptions view_; ///< what is known, in the cloud's frame
  CloudPoints points_;
  Eigen::Matrix3Xf chosen_, moved_;
  PinholeCamera camera_;
  std::vector<pcl::Indices> things_; ///< pixels of each
  std::vector<bool> outlined_;       ///< of each label found, by colours
};

/** \brief The cloud as an image. */
bool SceneEstimator::look() {
  if (input_.width < 2 || input_.height < 2)
    return fail(
        "a scene is seen in an organized cloud, an image of points; this one is "
        "a list: fit its things one by one");
  const LabelImage& labels = input_.labels;
  if (!labels.empty() &&
      (labels.width != input_.width || labels.height != input_.height))
    return fail("the labels have " + std::to_string(labels.width) + " x " +
                std::to_string(labels.height) + " pixels, the cloud " +
                std::to_string(input_.width) + " x " + std::to_string(input_.height) +
                "; give labels of the same image");
  if (!labels.empty() && labels.values.size() != std::size_t(input_.points.cols()))
    return fail(
        "the labels' values are not as many as their pixels; give one for each");
  if (input_.chosen) {
    chosen_ = Eigen::Matrix3Xf::Constant(
        3, input_.points.cols(), std::numeric_limits<float>::quiet_NaN());
    for (const auto index : input_.indices)
      chosen_.col(index) = input_.points.col(index);
    new (&points_) CloudPoints(chosen_);
  }
  if (!view_.viewpoint && input_.sensor_origin.norm() > 0.0)
    view_.viewpoint = input_.sensor_origin;
  if (!findImage(points_, input_.width, input_.height, view_, camera_))
    return fail("the cloud is no image of a camera, although it has rows; give the "
                "camera's intrinsics if it is one");
  noteOtherViewpoint(points_, camera_, view_, scene_.notes);
  view_.camera = camera_;
  return true;
}

bool SceneEstimator::findTable() {
  const CameraPose pose(camera_);
  if (!pose.isIdentity())
    moved_ = pose.toCamera(points_);
  const CloudPoints seen = moved_.size() == 0 ? points_ : CloudPoints(moved_);
  const ViewOptions view = pose.isIdentity() ? view_ : pose.toCamera(view_);
  if (!view_.table) {
    PinholeCamera camera = camera_;
    camera.center.setZero();
    camera.rotation.setIdentity();
    const SceneTable found =
        findSceneTable(seen, input_.width, input_.height, camera, view.up);
    if (found.table)
      scene_.table = pose.toCloud(*found.table);
    else if (input_.labels.empty())
      return fail(found.planes == 0
                      ? "there is no table, that is no plane that holds a tenth of the "
                        "points; give the table or labels"
                      : "nothing stands on a plane of the cloud; give the table or "
                        "labels");
    else
      scene_.notes.push_back("no table was found under the things; give the table if "
                             "there is one");
  } else
    scene_.table = view_.table;
  view_.table = scene_.table;
  return true;
}

bool SceneEstimator::tellApart() {
  if (!input_.labels.empty())
    scene_.labels = input_.labels;
  else {
    const CloudPoints seen = moved_.size() == 0 ? points_ : CloudPoints(moved_);
    PinholeCamera camera = camera_;
    camera.center.setZero();
    camera.rotation.setIdentity();
    ColorMatrix plain; // of a cloud without colours all has one
    if (input_.colors.size() == 0)
      plain.setZero(3, input_.points.cols());
    const SceneView view{seen,
                         input_.width,
                         input_.height,
                         input_.colors.size() > 0 ? input_.colors : plain,
                         camera,
                         CameraPose(camera_).toCamera(*scene_.table),
                         threads_};
    SceneSegments segments = segmentScene(view, options_.min_pixels);
    scene_.labels = std::move(segments.labels);
    outlined_ = std::move(segments.outlined);
  }
  std::vector<pcl::Indices> of_label;
  for (std::size_t i = 0; i < scene_.labels.values.size(); ++i) {
    const std::uint16_t label = scene_.labels.values[i];
    if (label == 0)
      continue;
    if (label >= of_label.size())
      of_label.resize(label + std::size_t(1));
    of_label[label].push_back(static_cast<pcl::index_t>(i));
  }
  std::size_t small = 0;
  for (pcl::Indices& pixels : of_label) {
    if (pixels.size() >= std::size_t(options_.min_pixels))
      things_.push_back(std::move(pixels));
    else
      small += pixels.empty() ? 0 : 1;
  }
  if (small > 0)
    scene_.notes.push_back(std::to_string(small) + " things of fewer than " +
                           std::to_string(options_.min_pixels) +
                           " pixels are left out");
  if (things_.empty())
    return fail(input_.labels.empty()
                    ? "nothing stands on the table; come nearer, or give labels"
                    : "the labels mark no thing of " +
                          std::to_string(options_.min_pixels) + " pixels or more");
  return true;
}

void SceneEstimator::fit(const pcl::Indices& pixels, SceneObject& object) const {
  object.label = scene_.labels.values[std::size_t(pixels.front())];
  object.pixels = int(pixels.size());
  CellMask own(input_.width, input_.height), others(input_.width, input_.height);
  for (std::size_t i = 0; i < own.cells.size(); ++i) {
    own.cells[i] = scene_.labels.values[i] == object.label;
    others.cells[i] = scene_.labels.values[i] != 0 && !own.cells[i];
  }
  object.roi = boundingRect(own);
  EstimationOptions options = options_.estimation;
  options.progress = {};
  options.view = view_;
  options.view.others = std::move(others);
  if (!input_.labels.empty())
    options.view.mask = std::move(own);
  else if (outlined_[std::size_t(object.label)]) {
    options.view.mask = std::move(own);
    options.view.mask_sigma = FOUND_OUTLINE;
    options.view.mask_dilation = FOUND_DILATION;
  }
  const std::optional<RoiBox> anywhere;
  const CoordinateMap map =
      input_.chosen
          ? CoordinateMap(chosen_.data(), 3, chosen_.cols(), Eigen::OuterStride<>(3))
          : input_.points;
  const EstimationInput one{map,
                            input_.width,
                            input_.height,
                            input_.sensor_origin,
                            input_.header,
                            pixels,
                            true,
                            anywhere};
  if (estimateSurface(&one, options, threads_, object.model, object.report))
    object.visible = visibleShare(object, camera_, points_, scene_.labels);
}

bool SceneEstimator::fitAll() {
  // the largest first: who begins it last keeps all others waiting
  std::stable_sort(things_.begin(), things_.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size();
  });
  scene_.objects.resize(things_.size());
  parallelFor(things_.size(), threads_, [&](std::size_t k) {
    fit(things_[k], scene_.objects[k]);
  });
  std::string why;
  for (const SceneObject& object : scene_.objects)
    if (object.model.empty()) {
      why = object.report.failure;
      scene_.notes.push_back(
          "the thing at " + std::to_string(object.roi.x) + "," +
          std::to_string(object.roi.y) + "," + std::to_string(object.roi.width) + "," +
          std::to_string(object.roi.height) + " of the image gives no model: " + why);
    }
  scene_.objects.erase(
      std::remove_if(scene_.objects.begin(),
                     scene_.objects.end(),
                     [](const SceneObject& o) { return o.model.empty(); }),
      scene_.objects.end());
  if (scene_.objects.empty())
    return fail("none of the " + std::to_string(things_.size()) +
                " things gives a model: " + why);
  std::stable_sort(scene_.objects.begin(),
                   scene_.objects.end(),
                   [](const SceneObject& a, const SceneObject& b) {
                     return 2 * a.roi.x + a.roi.width < 2 * b.roi.x + b.roi.width;
                   });
  return true;
}

} // namespace

bool estimateScene(const SceneInput* input,
                   const SceneOptions& options,
                   unsigned int threads,
                   Scene& scene) {
  scene = {};
  if (!input)
    return fail("there is no input cloud; call setInputCloud first", scene);
  if (const char* why =
          contradictionOf(static_cast<std::size_t>(input->points.cols()),
                          static_cast<std::size_t>(std::max(0, input->width)),
                          static_cast<std::size_t>(std::max(0, input->height)),
                          input->indices))
    return fail(why, scene);
  return SceneEstimator(*input, options, threads, scene).estimate();
}

void setOptions(const SceneOptions& options, SceneOptions& target) {
  std::string why;
  if (options.isValid(&why))
    target = options;
  else
    PCL_ERROR("[pcl_sq::SceneEstimation::setOptions] %s; the options stay as they "
              "were.\n",
              why.c_str());
}

} // namespace detail

} // namespace pcl_sq
