// SPDX-License-Identifier: BSD-3-Clause
// Point clouds in, unions of superquadrics out.
#include "app.h"
#include "files.h"
#include "grasp_output.h"
#include "model_options.h"
#include "summary.h"
#include "value_checks.h"

#include "pcl_sq/stage_timer.h"

#include <atomic>
#include <iostream>
#include <thread>

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION = "Fits a union of superquadrics to the object in a "
                                "point cloud (PCD, PLY, OBJ, XYZ).";
const char* const EXAMPLES =
    "  pcl_sq_fit cup.pcd -o cup.json --snapshot cup.png\n"
    "  pcl_sq_fit scene.pcd --remove-plane --mesh object.ply\n"
    "  pcl_sq_fit kinect.pcd --roi 250,200,140,180 --grasp-points grasp.pcd\n"
    "  pcl_sq_fit can.ply --decomposition none\n"
    "  pcl_sq_fit cup.ply --decomposition none --taper --mesh cup.stl\n"
    "  pcl_sq_fit scene.pcd --mask mask.png --grasps 20 --gripper wsg_50 -o cup.json\n"
    "  pcl_sq_fit objects/*.pcd --jsonl > models.jsonl\n";

struct Arguments {
  std::vector<std::string> clouds;
  bool jsonl = false;
  int grasps = 0;
  app::ModelOptions options;
  app::GraspOptions grasp_options;
};

app::ModelResult fit(const std::string& path,
                     const app::ModelOptions& options,
                     app::LoadedCloud& input) {
  std::vector<std::pair<std::string, double>> timings;
  StageTimer timer(timings, options.estimation.progress);
  input = timer.run("load", [&] { return app::loadCloud(path, options.cloud); });
  return app::makeModel(input, path, options, timings.back().second);
}

GraspPlan planOn(const app::LoadedCloud& input,
                 const Arguments& arguments,
                 const ModelFile& file,
                 double& milliseconds) {
  app::GraspOptions options = arguments.grasp_options;
  options.planner.count = std::size_t(arguments.grasps);
  options.frame = arguments.options.frame;
  GraspScene scene = app::makeScene(options, file, &input);
  scene.cloud = app::columnsOf(input);
  return app::planGrasps(file.model, scene, options, milliseconds);
}

int fitOne(const Arguments& arguments) {
  app::LoadedCloud input;
  app::StageLine line;
  app::ModelOptions options = arguments.options;
  options.estimation.progress = [&line](const std::string& stage, double share) {
    line.show(app::wordsFor(stage), share);
  };
  app::ModelResult result = fit(arguments.clouds[0], options, input);
  line.clear();
  app::printNotes(result);
  GraspPlan plan;
  double plan_ms = 0.0;
  if (arguments.grasps > 0) {
    line.show("planning grasps");
    plan = planOn(input, arguments, result.file, plan_ms);
    app::addGrasps(plan, arguments.grasp_options, result.file);
  }
  line.clear();
  app::writeOutputs(input, result, arguments.options);
  if (!app::quiet())
    app::printSummary(result);
  if (arguments.grasps > 0 && !plan.ok())
    throw app::Failure(plan.failure); // the model is written all the same
  if (arguments.grasps > 0 && !app::quiet())
    app::printGrasps(plan, arguments.grasp_options, plan_ms);
  return app::DONE;
}

/** \brief One JSON line per cloud in the order of the arguments; clouds in parallel. */
int fitMany(const Arguments& arguments) {
  app::ModelOptions options = arguments.options;
  const std::size_t count = arguments.clouds.size();
  const unsigned cores =
      options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  const std::size_t workers = std::clamp<std::size_t>(cores, 1, count);
  options.threads = workers > 1 ? 1 : options.threads;
  std::vector<std::string> lines(count), errors(count);
  std::atomic<std::size_t> next{0}, done{0};
  app::Progress progress("fitting", count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        app::LoadedCloud input;
        lines[i] = toJson(fit(arguments.clouds[i], options, input).file, -1);
      } catch (const std::exception& error) {
        errors[i] = arguments.clouds[i] + ": " + app::sentenceOf(error);
      }
      progress.update(++done);
    }
  };
  std::vector<std::thread> pool;
  for (std::size_t i = 1; i < workers; ++i)
    pool.emplace_back(work);
  work();
  for (std::thread& thread : pool)
    thread.join();

  std::string text;
  int code = app::DONE;
  for (std::size_t i = 0; i < count; ++i) {
    if (!errors[i].empty()) {
      std::cerr << "pcl_sq_fit: " << errors[i] << '\n';
      code = app::FAILED;
    } else
      text += lines[i] + "\n";
  }
  if (options.output.empty())
    std::cout << text;
  else if (!text.empty())
    app::writeTextFile(options.output, text);
  return code;
}

int checkedFit(const Arguments& arguments) {
  const app::ModelOptions& options = arguments.options;
  const bool single_outputs = !options.mesh.empty() || !options.grasp_points.empty() ||
                              !options.snapshot.empty();
  if (arguments.clouds.size() > 1 && !arguments.jsonl)
    throw app::UsageError("several clouds need --jsonl, one JSON line for each.");
  if (arguments.jsonl && (single_outputs || arguments.grasps > 0))
    throw app::UsageError(
        "--jsonl goes with -o alone; --mesh, --grasp-points, --grasps and --snapshot "
        "are for one cloud.");
  if (arguments.grasps > 0 && options.taper)
    throw app::UsageError("--grasps cannot respect a taper; leave --taper out.");
  if (arguments.grasps > 0)
    app::checkGraspOptions(arguments.grasp_options);
  app::checkModelOptions(options);
  return arguments.jsonl ? fitMany(arguments) : fitOne(arguments);
}

} // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  return app::run(
      argc,
      argv,
      "pcl_sq_fit",
      DESCRIPTION,
      EXAMPLES,
      [&](CLI::App& cli) {
        cli.add_option("cloud", arguments.clouds, "Point clouds")
            ->required()
            ->type_name("FILE...");
        cli.add_flag("--jsonl",
                     arguments.jsonl,
                     "One JSON line per cloud, on stdout or in -o; clouds in parallel");
        app::addCloudOptions(cli, arguments.options.cloud);
        app::addModelOptions(cli, arguments.options);
        app::addTaperOption(cli, arguments.options);
        cli.add_option("--grasps",
                       arguments.grasps,
                       "Number of ranked grasps to add to the model file")
            ->check(app::wholeNumber(0, 10000))
            ->capture_default_str();
        app::addGripperOptions(cli, arguments.grasp_options);
      },
      [&] { return checkedFit(arguments); });
}
