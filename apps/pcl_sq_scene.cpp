// SPDX-License-Identifier: BSD-3-Clause
// A cloud, a stereo pair or a depth image in, all things on the table out.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/image_file.h"
#include "model/cloud_picture.h"
#include "model/scene_model.h"
#include "report/summary.h"
#include "stereo/scene_picture.h"
#include "stereo/stereo_cloud.h"
#include "stereo/stereo_model.h"

#ifdef PCL_SQ_HAVE_VISUALIZATION
#include "pcl_sq/visualization/mesh_writer.h"
#endif

#include "pcl_sq/stage_timer.h"

using namespace pcl_sq;
using namespace pcl_sq::app;

namespace {

struct Arguments {
  std::string input; ///< cloud, left image, or colour image of a depth image
  FrontOptions front;
  ModelOptions model;
  SceneChoices choices;
  std::string labels, write_labels, panel;
  ExportOptions exported;

  bool hasImages() const { return !front.right.empty() || !front.depth.empty(); }
};

void configure(CLI::App& cli, Arguments& a) {
  cli.set_config("--config", "", "TOML file with options; the command line wins")
      ->type_name("FILE")
      ->check(existingFile());
  cli.add_option("input",
                 a.input,
                 "Organized point cloud; or left image; or, with --depth, colour image")
      ->type_name("CLOUD|LEFT");
  cli.add_option("right", a.front.right, "Right image")->type_name("RIGHT");
  addPairOptions(cli, a.front);
  cli.add_option("--labels",
                 a.labels,
                 "Things told apart elsewhere, an image of the same size: 0 nothing, "
                 "another number for each thing; used as it is")
      ->type_name("FILE")
      ->check(existingFile());
  addSceneOptions(cli, a.model, a.choices);
  cli.add_option("-o,--output", a.model.output, "Scene as JSON; -: standard output")
      ->type_name("FILE");
#ifdef PCL_SQ_HAVE_VISUALIZATION
  cli.add_option("--mesh",
                 a.model.mesh,
                 "Surfaces as .ply, .obj, .stl or .vtp; -: PLY on standard output")
      ->type_name("FILE");
#endif
  cli.add_option("--panel",
                 a.panel,
                 "Picture: all models over the image and in space, numbered")
      ->type_name("FILE");
  cli.add_option("--write-labels",
                 a.write_labels,
                 "Number of each pixel's thing as PNG, 0 where there is none")
      ->type_name("FILE");
  addSceneExportOptions(cli, a.exported);
}

/** \brief What can be wrong with the command line as a whole. */
void check(Arguments& a) {
  a.front.left = a.input;
  a.front.intrinsics = a.model.intrinsics;
  if (a.input.empty() && a.front.depth.empty())
    throw UsageError("there is nothing to look at; give an organized point cloud, a "
                     "pair of images, or a depth image (--depth).");
  if (a.hasImages()) {
    checkPairOptions(a.front);
    a.model.cloud.unit_option = unitOptionOf(a.front);
  }
  for (const std::string& file : {a.input, a.front.right, a.front.depth, a.labels})
    claimInput(file);
  for (const std::string& calibration : a.front.calib)
    claimInput(calibration);
  checkModelOptions(a.model);
  checkSceneExportOptions(a.exported);
  claimImage("--panel", a.panel);
  claimOutput("--write-labels", a.write_labels, {".png"});
}

/** \brief The cloud, read or made of images. \param[out] notes what was assumed */
LoadedCloud readInput(Arguments& a, std::vector<std::string>& notes) {
  if (!a.hasImages())
    return loadCloud(a.input, a.model.cloud);
  const StereoView front = readSceneViews(a.front, a.model);
  notes = front.notes;
  return toLoadedCloud(*front.stereo.cloud, nullptr);
}

#ifdef PCL_SQ_HAVE_VISUALIZATION
void writeMeshes(const std::string& path, const SceneFile& file) {
  ModelFile all;
  all.model = file.all();
  writeMesh(path, meshesOf(all));
  noteWritten(path);
}
#endif

int work(Arguments& a) {
  check(a);
  StageLine line;
  a.model.estimation.progress = [&line](const std::string& stage, double share) {
    line.show(wordsFor(stage), share);
  };
  a.front.progress = a.model.estimation.progress;
  std::vector<std::pair<std::string, double>> timings;
  std::vector<std::string> notes;
  const LoadedCloud input = StageTimer(timings, a.front.progress).run("load", [&] {
    return readInput(a, notes);
  });
  if (!a.labels.empty())
    a.choices.labels = readLabels(a.labels);
  SceneResult result = makeSceneFile(input,
                                     a.input.empty() ? a.front.depth : a.input,
                                     a.model,
                                     a.choices,
                                     timings.back().second);
  line.clear();
  result.file.notes.insert(result.file.notes.begin(), notes.begin(), notes.end());
  for (const std::string& sentence : result.file.notes)
    note(sentence);
  if (!a.model.output.empty())
    writeOutput(a.model.output, toJson(result.file) + "\n");
#ifdef PCL_SQ_HAVE_VISUALIZATION
  if (!a.model.mesh.empty())
    writeMeshes(a.model.mesh, result.file);
#endif
  if (!a.panel.empty())
    writeImage(a.panel, drawScene(input, result));
  if (!a.write_labels.empty())
    writeImage(a.write_labels, labelImage(result));
  writeExports(a.exported, result.file, &input);
  if (!quiet())
    printScene(result);
  return DONE;
}

} // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  return run(
      argc,
      argv,
      "pcl_sq_scene",
      "Fits unions of superquadrics to all things on a table in one view: an "
      "organized point cloud, a stereo pair or a depth image.",
      "  pcl_sq_scene scene.pcd -o scene.json --panel scene.png\n"
      "  pcl_sq_scene scene.pcd --html scene.html --export things.scene\n"
      "  pcl_sq_scene scene.pcd --labels labels.png -o scene.json\n"
      "  pcl_sq_scene im0.png im1.png --calib calib.txt -o scene.json\n"
      "  pcl_sq_scene color.png --depth depth.png --intrinsics "
      "616,616,310,237 --write-labels things.png\n",
      [&](CLI::App& cli) { configure(cli, arguments); },
      [&] { return work(arguments); });
}
