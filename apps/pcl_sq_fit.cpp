// SPDX-License-Identifier: BSD-3-Clause
// Point cloud in, union of superquadrics out.
#include "app.h"
#include "model_options.h"

#include "pcl_sq/stage_timer.h"

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION = "Fits a union of superquadrics to the object in a "
                                "point cloud (PCD, PLY, OBJ, XYZ).";
const char* const EXAMPLES =
    "  pcl_sq_fit cup.pcd -o cup.json --snapshot cup.png\n"
    "  pcl_sq_fit scene.pcd --remove-plane --mesh object.ply\n"
    "  pcl_sq_fit kinect.pcd --roi 250,200,140,180 --grasp-points grasp.pcd\n"
    "  pcl_sq_fit can.ply --decomposition none --axis-assignment best_of_3\n";

} // namespace

int main(int argc, char** argv) {
  std::string input_path;
  app::ModelOptions options;
  return app::run(
      argc,
      argv,
      "pcl_sq_fit",
      DESCRIPTION,
      EXAMPLES,
      [&](CLI::App& cli) {
        cli.add_option("cloud", input_path, "Point cloud")
            ->required()
            ->type_name("FILE");
        app::addModelOptions(cli, options);
      },
      [&] {
        app::checkModelOptions(options);
        std::vector<std::pair<std::string, double>> timings;
        StageTimer timer(timings);
        const app::LoadedCloud input =
            timer.run("load", [&] { return app::loadCloud(input_path); });
        const app::ModelResult result =
            app::makeModel(input, input_path, options, timings.back().second);
        app::writeOutputs(input, result, options);
        if (!app::quiet())
          app::printSummary(result);
        return int(app::DONE);
      });
}
