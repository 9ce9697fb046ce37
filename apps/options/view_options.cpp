// SPDX-License-Identifier: BSD-3-Clause
// Options of the best mode: what is known of the view, and how many parts.
#include "command_line/app.h"
#include "command_line/option_rules.h"
#include "command_line/value_checks.h"
#include "options/model_options.h"

#ifdef PCL_SQ_HAVE_OPENCV
#include "files/image_file.h"

#include <opencv2/core.hpp>
#endif

#include <cmath>
#include <memory>

namespace pcl_sq::app {

namespace {

#ifdef PCL_SQ_HAVE_OPENCV
CellMask maskOf(const std::string& path) {
  const cv::Mat image = readMask(path);
  CellMask mask(image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      mask.set(x, y, image.at<unsigned char>(y, x) > 0);
  return mask;
}
#endif

} // namespace

void addCoverageOptions(CLI::App& cli, ModelOptions& options) {
  cli.add_flag_callback(
      "--complete",
      [&options] { options.estimation.view.coverage = Coverage::COMPLETE; },
      "The points show the object from all round; else told by the points");
  cli.add_flag_callback(
      "--one-sided",
      [&options] { options.estimation.view.coverage = Coverage::ONE_SIDED; },
      "The points show one side of it, from a place that is guessed where it is not "
      "given");
}

void addViewOptions(CLI::App& cli, ModelOptions& options) {
  // the command line itself is asked which one, see asksForPaper()
  cli.add_option_function<std::string>(
         "--preset",
         [](const std::string&) {},
         "best: points, outline and table, parts found; paper: the paper's chain "
         "(also chosen by its own options)")
      ->default_str("best")
      ->check(oneOf({"best", "paper"}));
  cli.add_option("--parts",
                 options.estimation.object_fit.parts,
                 "Number of superquadrics; 0: found")
      ->check(wholeNumber(0, 64))
      ->capture_default_str();
  cli.add_option(
         "--max-parts",
         options.estimation.object_fit.max_parts,
         "Largest number of superquadrics that is looked for; 0: 6 where a "
         "camera saw the object, 16 for a cloud from all round, of which a number "
         "that is given asks for more detail")
      ->check(wholeNumber(0, 64))
      ->capture_default_str();
#ifdef PCL_SQ_HAVE_OPENCV
  cli.add_option("--mask", options.mask, "Object's pixels as PNG (organized clouds)")
      ->type_name("FILE")
      ->check(existingFile());
#endif
  cli.add_option("--intrinsics",
                 options.intrinsics,
                 "Camera of an organized cloud [px]; else found from the cloud")
      ->expected(4)
      ->delimiter(',')
      ->type_name("FX,FY,CX,CY")
      ->check(number(-FARTHEST, FARTHEST));
  addFrameOptions(cli, options.frame);
  cli.parse_complete_callback([&cli, &options] {
    const CommandLine line(cli);
    const bool paper = asksForPaper(line);
    EstimationOptions& estimation = options.estimation;
    if (paper && !line.given("--decomposition"))
      estimation.decomposition = EstimationOptions::paper().decomposition;
    if (!line.given("--fit") &&
        (paper || estimation.decomposition == Decomposition::PRISMS))
      estimation.fit = EstimationOptions::paper().fit;
  });
}

ViewOptions makeView(const ModelOptions& options) {
  ViewOptions view = options.estimation.view;
  if (options.intrinsics.size() == 4) {
    PinholeCamera camera;
    camera.fx = options.intrinsics[0];
    camera.fy = options.intrinsics[1];
    camera.cx = options.intrinsics[2];
    camera.cy = options.intrinsics[3];
    view.camera = camera;
  }
  view.viewpoint = options.frame.viewpointOf();
  view.table = options.frame.tableOf();
  view.up = options.frame.upOf();
#ifdef PCL_SQ_HAVE_OPENCV
  if (!options.mask.empty())
    view.mask = maskOf(options.mask);
#endif
  return view;
}

} // namespace pcl_sq::app
