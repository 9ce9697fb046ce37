// SPDX-License-Identifier: BSD-3-Clause
#include "model/scene_model.h"

#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "model/model_json.h"
#include "options/offset.h"
#include "report/size_doubt.h"
#include "report/summary.h"
#include "report/text.h"

#include <cstdio>

namespace pcl_sq::app {

namespace {

/** \brief An object of the estimation as one of the file. */
SceneFileObject toFileObject(const SceneObject& object, const ModelResult& thing) {
  SceneFileObject entry;
  entry.file = thing.file;
  entry.roi = object.roi;
  entry.pixels = object.pixels;
  entry.visible = object.visible;
  entry.confidence = object.report.confidence;
  entry.notes = object.report.notes;
  return entry;
}

ModelResult thingOf(const LoadedCloud& input,
                    const std::string& input_path,
                    const ModelOptions& options,
                    const SceneObject& object) {
  ModelResult thing;
  thing.report = object.report;
  tellFrame(input, options, {}, thing);
  tellModel(input, input_path, object.model, thing);
  thing.file.timings_ms = object.report.timings_ms;
  const RoiBox& box = thing.report.region;
  const std::string doubt =
      sizeDoubt("the thing", (box.max - box.min).maxCoeff(), options.cloud);
  if (!doubt.empty())
    thing.report.notes.push_back(doubt);
  thing = moved(std::move(thing), input.offset);
  thing.file.extra_json = reportToJson(thing);
  return thing;
}

} // namespace

void addSceneOptions(CLI::App& cli, ModelOptions& options, SceneChoices& choices) {
  addUnitOption(cli, options.cloud);
  cli.add_option(
         "--min-pixels", choices.min_pixels, "Things of fewer pixels are left out")
      ->check(wholeNumber(30, 1000000))
      ->capture_default_str();
  cli.add_option("--intrinsics",
                 options.intrinsics,
                 "Camera [px]; of an organized cloud else found from the cloud")
      ->expected(4)
      ->delimiter(',')
      ->type_name("FX,FY,CX,CY")
      ->check(number(-FARTHEST, FARTHEST));
  addFrameOptions(cli, options.frame);
  cli.add_option("--max-parts",
                 options.estimation.object_fit.max_parts,
                 "Largest number of superquadrics of a thing")
      ->check(wholeNumber(1, 16))
      ->capture_default_str();
  cli.add_flag_function(
      "--taper,!--no-taper",
      [&options](std::int64_t count) { options.taper = count > 0; },
      "Let sections grow along the axis where the data demand it (default)");
  cli.add_option("--threads", options.threads, "Number of threads, 0: all cores")
      ->check(wholeNumber(0, 1024))
      ->capture_default_str();
}

SceneResult makeSceneFile(const LoadedCloud& input,
                          const std::string& input_path,
                          const ModelOptions& user_options,
                          const SceneChoices& choices,
                          double load_ms) {
  const ModelOptions options = moved(user_options, -input.offset);
  SceneEstimation<pcl::PointXYZRGBA> estimation;
  estimation.setInputCloud(input.cloud);
  SceneOptions settings;
  settings.estimation = options.estimation;
  settings.estimation.view = makeView(options);
  settings.estimation.object_fit.fit.taper = options.taper.value_or(true);
  settings.min_pixels = choices.min_pixels;
  std::string why;
  if (!settings.isValid(&why))
    throw Failure(why + ".");
  estimation.setOptions(settings);
  estimation.setLabels(choices.labels);
  estimation.setNumberOfThreads(options.threads);
  Scene scene;
  if (!estimation.estimate(scene)) {
    const std::string doubt = sizeDoubt("the cloud", sizeOf(input), options.cloud);
    throw Failure(scene.failure + (doubt.empty() ? "" : "; " + doubt) + ".");
  }
  SceneResult result;
  result.labels = std::move(scene.labels);
  for (const SceneObject& object : scene.objects) {
    result.things.push_back(thingOf(input, input_path, options, object));
    result.file.objects.push_back(toFileObject(object, result.things.back()));
    result.numbers.push_back(object.label);
  }
  SceneFile& file = result.file;
  if (scene.table) {
    const Eigen::Vector3d& n = scene.table->normal;
    file.table = {n.x(), n.y(), n.z(), scene.table->offset - n.dot(input.offset)};
  }
  file.frame = input.cloud->header.frame_id;
  file.input_path = input_path;
  file.input_points = input.cloud->size();
  file.finite_points = input.finite_points;
  file.options_json = optionsToJson(user_options);
  file.notes = input.notes;
  file.notes.insert(file.notes.end(), scene.notes.begin(), scene.notes.end());
  file.timings_ms.emplace_back("load", load_ms);
  file.timings_ms.insert(
      file.timings_ms.end(), scene.timings_ms.begin(), scene.timings_ms.end());
  double total = 0.0;
  for (const auto& [stage, ms] : file.timings_ms)
    total += ms;
  file.timings_ms.emplace_back("total", total);
  return result;
}

LabelImage numberedPixels(const SceneResult& result) {
  std::vector<std::uint16_t> number_of(65536, 0);
  for (std::size_t k = 0; k < result.numbers.size(); ++k)
    number_of[std::size_t(result.numbers[k])] = static_cast<std::uint16_t>(k + 1);
  LabelImage image = result.labels;
  for (std::uint16_t& value : image.values)
    value = number_of[value];
  return image;
}

void printScene(const SceneResult& result) {
  const SceneFile& file = result.file;
  std::printf("%s: %zu points, %zu thing%s%s\n",
              printable(file.input_path).c_str(),
              file.input_points,
              file.objects.size(),
              file.objects.size() == 1 ? "" : "s",
              file.table ? " on the table" : "");
  std::printf("  thing  pixels  visible  confidence  parts   size [mm]%s\n",
              file.table ? " (width x depth x height above the table)" : "");
  for (std::size_t k = 0; k < file.objects.size(); ++k) {
    const SceneFileObject& object = file.objects[k];
    const Eigen::Vector3d sides = 1e3 * sizeOf(result.things[k]).sides;
    std::printf("  %5zu  %6d    %3.0f %%       %3.0f %%  %5zu   %.1f x %.1f x %.1f\n",
                k + 1,
                object.pixels,
                100.0 * object.visible,
                100.0 * object.confidence,
                object.file.model.size(),
                sides.x(),
                sides.y(),
                sides.z());
  }
  std::printf("  time:");
  for (const auto& [stage, ms] : file.timings_ms)
    std::printf(" %s %.1f ms", stage.c_str(), ms);
  std::printf("\n");
}

} // namespace pcl_sq::app
