// SPDX-License-Identifier: BSD-3-Clause
// Model or point cloud in, ranked grasps out.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/graspit_folder.h"
#include "model/export_output.h"
#include "model/grasp_output.h"
#include "model/model_input.h"
#include "options/model_options.h"
#include "report/summary.h"

#include <algorithm>

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION =
    "Plans grasps on a union of superquadrics: a model file, or a cloud that is fitted "
    "first.";
const char* const EXAMPLES =
    "  pcl_sq_grasp cup.json --table 0,0,1,0 -o grasps.json --snapshot grasps.png\n"
    "  pcl_sq_grasp scene.pcd --remove-plane --gripper robotiq_2f_85 --count 20\n"
    "  pcl_sq_grasp cup.json --cloud scene.pcd --gripper my_hand.toml\n"
    "  pcl_sq_grasp cup.json --html grasps.html\n"
    "  pcl_sq_grasp cup.json --graspit ~/graspit\n"
    "  pcl_sq_grasp tabletop.json --object 1 -o grasps.json\n";

struct Input : app::ModelInput {
  std::optional<app::LoadedCloud> cloud; ///< the whole scene
};

/** \brief Whether the input is a model file; on standard input its first character
 * tells. */
bool isModel(const std::string& path) {
  if (path != "-" && path != "/dev/stdin")
    return app::extensionOf(path) == ".json";
  const std::string text = app::readFile(path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

Input loadInput(const std::string& path,
                const std::string& cloud_path,
                std::size_t object,
                const app::ModelOptions& model_options) {
  Input input;
  if (isModel(path)) {
    static_cast<app::ModelInput&>(input) = app::readModelInput(path, object);
    if (!cloud_path.empty())
      input.cloud = app::loadCloud(cloud_path, model_options.cloud);
    return input;
  }
  if (object > 0)
    throw app::UsageError("--object has no effect here: it goes with a scene of "
                          "pcl_sq_scene.");
  app::StageLine line;
  line.show(app::wordsFor("load"));
  input.cloud = app::loadCloud(path, model_options.cloud);
  app::ModelOptions options = model_options;
  options.estimation.progress = [&line](const std::string& stage, double share) {
    line.show(app::wordsFor(stage), share);
  };
  const app::ModelResult result = app::makeModel(*input.cloud, path, options, 0.0);
  app::printNotes(result);
  input.file = result.file;
  return input;
}

int plan(const std::string& input_path,
         const std::string& cloud_path,
         std::size_t object,
         const app::ModelOptions& model_options,
         app::GraspOptions& options) {
  options.frame = model_options.frame;
  app::claimInput(input_path);
  app::claimInput(cloud_path);
  app::checkGraspOptions(options);
  app::checkModelOptions(model_options);
  Input input = loadInput(input_path, cloud_path, object, model_options);
  const std::size_t objects = input.scene.objects.size();
  GraspScene scene;
  double milliseconds = 0.0;
  GraspPlan plan;
  app::StageLine line;
  line.show("planning grasps");
  // of a scene the thing that is asked for, else the one with the best grasp
  const std::size_t first = object > 0 ? object - 1 : 0;
  const std::size_t last = object > 0 ? object : std::max<std::size_t>(objects, 1);
  std::size_t best = first;
  for (std::size_t k = first; k < last; ++k) {
    const ModelFile file = objects > 0 ? app::thingOnTable(input.scene, k) : input.file;
    GraspScene around =
        app::makeScene(options, file, input.cloud ? &*input.cloud : nullptr);
    if (input.cloud)
      around.cloud = app::columnsOf(*input.cloud);
    around.obstacles = input.scene.all(k);
    double took = 0.0;
    GraspPlan found = app::planGrasps(file.model, around, options, took);
    milliseconds += took;
    const bool better = found.ok() && (!plan.ok() || found.grasps[0].scores.total >
                                                         plan.grasps[0].scores.total);
    if (k > first && !better)
      continue;
    plan = std::move(found);
    scene = std::move(around);
    input.file = file;
    best = k;
  }
  line.clear();
  if (!plan.ok())
    throw app::Failure(plan.failure);
  if (objects > 1 && object == 0)
    app::note("the grasps are those of object " + std::to_string(best + 1) +
              ", which has the best one; --object chooses another");
  const std::string json = app::graspsToJson(
      plan, scene, options, input.file.frame, input_path, milliseconds);
  if (options.graspit_name.empty())
    options.graspit_name = app::graspitName(input_path);
  app::writeGraspOutputs(input.file.model, plan, scene, options, json);
  ModelFile shown = input.file;
  app::addGrasps(plan, options, shown);
  app::ExportOptions page;
  page.html = options.html;
  app::writeExports(page, shown, input.cloud ? &*input.cloud : nullptr);
  if (!app::quiet())
    app::printGrasps(plan, options, milliseconds);
  return app::DONE;
}

} // namespace

int main(int argc, char** argv) {
  std::string input_path, cloud_path;
  std::size_t object = 0;
  app::GraspOptions options;
  app::ModelOptions model_options;
  return app::run(
      argc,
      argv,
      "pcl_sq_grasp",
      DESCRIPTION,
      EXAMPLES,
      [&](CLI::App& cli) {
        cli.set_config("--config", "", "TOML file with options; the command line wins")
            ->type_name("FILE")
            ->check(app::existingFile());
        cli.add_option("input",
                       input_path,
                       "Model or scene (JSON), or point cloud; -: standard input")
            ->required()
            ->type_name("FILE");
        cli.add_option("--object",
                       object,
                       "Number of the thing of a scene, from 1 on; the others are "
                       "obstacles; 0: the one with the best grasp")
            ->check(app::wholeNumber(0, 65535))
            ->capture_default_str();
        app::addGraspOutputOptions(cli, options);
        app::addGripperOptions(cli, options);
        cli.add_option("--cloud",
                       cloud_path,
                       "The scene of a model file: what was seen, what is in the way")
            ->type_name("FILE");
        app::addCloudOptions(cli, model_options.cloud);
        app::addViewOptions(cli, model_options);
        cli.add_option(
               "--roi", model_options.roi, "Object in the image of a cloud [px]")
            ->expected(4)
            ->delimiter(',')
            ->type_name("X,Y,W,H")
            ->check(app::wholeNumber(-app::MAX_PIXELS, app::MAX_PIXELS));
        cli.add_flag(
            "--remove-plane",
            model_options.remove_plane,
            "The object is the largest thing that stands on a plane of a cloud");
        cli.add_option("--threads", model_options.threads, "For the fit, 0: all cores")
            ->check(app::wholeNumber(0, 1024))
            ->capture_default_str();
      },
      [&] { return plan(input_path, cloud_path, object, model_options, options); });
}
