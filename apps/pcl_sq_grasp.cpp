// SPDX-License-Identifier: BSD-3-Clause
// Model or point cloud in, ranked grasps out.
#include "app.h"
#include "files.h"
#include "grasp_output.h"
#include "model_options.h"

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION =
    "Plans grasps on a union of superquadrics: a model file, or a cloud that is fitted "
    "first.";
const char* const EXAMPLES =
    "  pcl_sq_grasp cup.json --table 0,0,1,0 -o grasps.json --snapshot grasps.png\n"
    "  pcl_sq_grasp scene.pcd --remove-plane --gripper robotiq_2f_85 --count 20\n"
    "  pcl_sq_grasp cup.json --cloud scene.pcd --gripper my_hand.toml\n"
    "  pcl_sq_grasp cup.json --graspit ~/graspit\n";

struct Input {
  ModelFile file;
  Eigen::Matrix3Xd cloud; ///< the whole scene; 3 x 0 without one
};

/** \brief Whether the input is a model file; on standard input its first character
 * tells. */
bool isModel(const std::string& path) {
  if (path != "-" && path != "/dev/stdin")
    return app::extensionOf(path) == ".json";
  const std::string text = app::readInput(path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

Input loadInput(const std::string& path,
                const std::string& cloud_path,
                const app::ModelOptions& model_options) {
  Input input;
  if (isModel(path)) {
    std::string why;
    if (!loadModel(path, input.file, &why))
      throw app::Failure(why + ".");
    if (!cloud_path.empty())
      input.cloud = app::columnsOf(app::loadCloud(cloud_path));
    return input;
  }
  if (!cloud_path.empty())
    throw app::UsageError(
        "--cloud goes with a model file; the input is a cloud itself");
  const app::LoadedCloud cloud = app::loadCloud(path);
  input.file = app::makeModel(cloud, path, model_options, 0.0).file;
  input.cloud = app::columnsOf(cloud);
  return input;
}

int plan(const std::string& input_path,
         const std::string& cloud_path,
         const app::ModelOptions& model_options,
         app::GraspOptions& options) {
  options.table = model_options.table;
  options.viewpoint = model_options.viewpoint;
  app::claimInput(input_path);
  app::claimInput(cloud_path);
  app::checkGraspOptions(options);
  app::checkModelOptions(model_options);
  const Input input = loadInput(input_path, cloud_path, model_options);
  GraspScene scene = app::makeScene(options, input.file);
  scene.cloud = input.cloud;
  if (scene.cloud.cols() > 0)
    scene.has_viewpoint = true; // unless told otherwise a cloud's frame is its camera's
  double milliseconds = 0.0;
  const GraspPlan plan =
      app::planGrasps(input.file.model, scene, options, milliseconds);
  if (!plan.ok())
    throw app::Failure(plan.failure);
  const std::string json = app::graspsToJson(
      plan, scene, options, input.file.frame, input_path, milliseconds);
  app::writeGraspOutputs(input.file.model, plan, scene, options, json);
  if (!app::quiet())
    app::printGrasps(plan, options, milliseconds);
  return app::DONE;
}

} // namespace

int main(int argc, char** argv) {
  std::string input_path, cloud_path;
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
            ->check(CLI::ExistingFile);
        cli.add_option(
               "input", input_path, "Model (JSON) or point cloud; -: standard input")
            ->required()
            ->type_name("FILE");
        app::addGraspOutputOptions(cli, options);
        app::addGripperOptions(cli, options);
        cli.add_option("--cloud",
                       cloud_path,
                       "The scene of a model file: what was seen, what is in the way")
            ->type_name("FILE");
        app::addViewOptions(cli, model_options);
        cli.add_option(
               "--roi", model_options.roi, "Object in the image of a cloud [px]")
            ->expected(4)
            ->delimiter(',')
            ->type_name("X,Y,W,H");
        cli.add_flag("--remove-plane",
                     model_options.remove_plane,
                     "The object of a cloud stands on its largest plane");
        cli.add_option("--threads", model_options.threads, "For the fit, 0: all cores")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
      },
      [&] { return plan(input_path, cloud_path, model_options, options); });
}
