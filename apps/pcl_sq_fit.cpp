// SPDX-License-Identifier: BSD-3-Clause
// Point clouds in, unions of superquadrics out.
#include "command_line/app.h"
#include "command_line/process.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/manifest.h"
#include "model/grasp_output.h"
#include "model/model_line.h"
#include "options/model_options.h"
#include "report/ordered_lines.h"
#include "report/summary.h"
#include "report/text.h"

#include "pcl_sq/stage_timer.h"

#include <algorithm>
#include <atomic>
#include <iostream>
#include <thread>

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION = "Fits a union of superquadrics to the object in a "
                                "point cloud (PCD, PLY, OBJ, STL or text).";
const char* const EXAMPLES =
    "  pcl_sq_fit cup.pcd -o cup.json --snapshot cup.png\n"
    "  pcl_sq_fit scene.pcd --remove-plane --mesh object.ply\n"
    "  pcl_sq_fit kinect.pcd --roi 250,200,140,180 --grasp-points grasp.pcd\n"
    "  pcl_sq_fit can.ply --decomposition none\n"
    "  pcl_sq_fit cup.ply --decomposition none --taper --mesh cup.stl\n"
    "  pcl_sq_fit scene.pcd --mask mask.png --grasps 20 --gripper wsg_50 -o cup.json\n"
    "  pcl_sq_fit cup.pcd --export cup.urdf --export cup.glb --html cup.html\n"
    "  pcl_sq_fit objects/*.pcd --jsonl > models.jsonl\n"
    "  pcl_sq_fit objects/*.pcd --jsonl --shard 1/2 --resume -o models_1.jsonl\n";

struct Arguments {
  std::vector<std::string> clouds;
  std::string manifest; ///< names further clouds, or empty
  std::string shard;    ///< I/N, or empty: all
  bool jsonl = false;
  bool resume = false;
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
  if (!options.intrinsics.empty() && !input.cloud->isOrganized())
    throw app::Failure("--intrinsics needs an organized cloud (an image of points); "
                       "give the camera's place by --viewpoint.");
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

/** \brief The model as a line, or why there is none. \return whether there is */
bool fitLine(const std::string& path,
             const app::ModelOptions& options,
             std::string& line) {
  app::ModelLine made = app::makeModelLine(path, options);
  line = std::move(made.line);
  for (const std::string& sentence : made.notes)
    app::note(sentence, path);
  if (made.failure.empty())
    return true;
  std::cerr << "pcl_sq_fit: " + app::printable(path + ": " + made.failure) + "\n";
  return false;
}

/** \brief One JSON line per cloud, written as it is done; clouds in parallel. */
int fitMany(const Arguments& arguments) {
  app::ModelOptions options = arguments.options;
  std::vector<std::string> clouds = arguments.clouds;
  app::DoneLines before;
  if (arguments.resume) {
    before = app::readDoneLines(options.output);
    clouds = app::withoutDone(clouds, before);
  }
  const std::size_t count = clouds.size();
  if (count == 0) // all was done before, or the shard is empty
    return before.all_fitted ? app::DONE : app::FAILED;
  const unsigned cores =
      options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  const std::size_t workers = std::clamp<std::size_t>(cores, 1, count);
  options.threads = workers > 1 ? 1 : options.threads;
  // as many turns of all workers as one cloud may take longer than the others
  constexpr std::size_t TURNS = 8;
  const std::string output = options.output.empty() ? "-" : options.output;
  app::OrderedLines lines(output, TURNS * workers);
  app::setInterruptAction([&] { lines.flush(); });
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> all_fitted{before.all_fitted};
  const std::size_t first = before.text.empty() ? 0 : 1;
  if (first > 0) // the old lines take their place in the file with the first new one
    lines.put(0, before.text);
  app::Progress progress("fitting", count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count && lines.failure().empty(); i = next++) {
      std::string line;
      if (!fitLine(clouds[i], options, line))
        all_fitted = false;
      lines.put(first + i, line);
      progress.update(++done);
    }
  };
  std::vector<std::thread> pool;
  for (std::size_t i = 1; i < workers; ++i)
    pool.emplace_back(work);
  work();
  for (std::thread& thread : pool)
    thread.join();
  lines.flush();
  app::setInterruptAction({});
  if (!lines.failure().empty())
    throw app::Failure(lines.failure() + ".");
  app::noteWritten(output);
  return all_fitted ? app::DONE : app::FAILED;
}

int checkedFit(Arguments& arguments) {
  const app::ModelOptions& options = arguments.options;
  if (!arguments.manifest.empty()) {
    app::claimInput(arguments.manifest);
    for (const std::string& name : app::readManifest(arguments.manifest))
      arguments.clouds.push_back(name);
  }
  if (arguments.clouds.empty())
    throw app::UsageError("a point cloud is missing; name one, or give --manifest.");
  if (!arguments.jsonl && (!arguments.shard.empty() || arguments.resume))
    throw app::UsageError("--shard and --resume are for many clouds: add --jsonl.");
  const bool single_outputs = !options.mesh.empty() || !options.grasp_points.empty() ||
                              !options.snapshot.empty() || options.exported.any();
  if (arguments.clouds.size() > 1 && !arguments.jsonl)
    throw app::UsageError("several clouds need --jsonl, one JSON line for each.");
  if (!arguments.shard.empty())
    arguments.clouds = app::shardOf(arguments.clouds, arguments.shard);
  if (arguments.jsonl && (single_outputs || arguments.grasps > 0))
    throw app::UsageError(
        "--jsonl goes with -o alone; --mesh, --grasp-points, --grasps, --snapshot, "
        "--export and --html are for one cloud.");
  if (arguments.resume && (options.output.empty() || options.output == "-"))
    throw app::UsageError("--resume goes on with a file: name it with -o.");
  if (arguments.grasps > 0)
    app::checkGraspOptions(arguments.grasp_options);
  for (const std::string& cloud : arguments.clouds)
    app::claimInput(cloud);
  app::claimInput(options.mask);
  app::checkModelOptions(options);
  if (arguments.jsonl && options.output.empty())
    app::claimOutput("--jsonl", "-");
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
        cli.add_option("cloud", arguments.clouds, "Point clouds; -: standard input")
            ->type_name("FILE...");
        cli.add_option("--manifest",
                       arguments.manifest,
                       "File that names clouds, one a line, beside those given")
            ->type_name("FILE");
        cli.add_flag("--jsonl",
                     arguments.jsonl,
                     "One JSON line per cloud, on standard output or in -o, in the "
                     "order of the clouds; each is added as soon as it is done, so "
                     "that Ctrl-C keeps those; what fails has an \"error\" instead of "
                     "a model. Clouds in parallel");
        cli.add_option("--shard",
                       arguments.shard,
                       "Share I of N of the clouds, with --jsonl: every Nth from the "
                       "Ith, for so many processes or machines")
            ->type_name("I/N");
        cli.add_flag(
            "--resume",
            arguments.resume,
            "Go on with the -o of a run of --jsonl that was ended: clouds that "
            "have a line there are not done again");
        app::addCloudOptions(cli, arguments.options.cloud);
        app::addModelOptions(cli, arguments.options);
        app::addCoverageOptions(cli, arguments.options);
        cli.add_option("--grasps",
                       arguments.grasps,
                       "Number of ranked grasps to add to the model file")
            ->check(app::wholeNumber(0, 10000))
            ->capture_default_str();
        app::addGripperOptions(cli, arguments.grasp_options);
      },
      [&] { return checkedFit(arguments); });
}
