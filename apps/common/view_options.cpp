// SPDX-License-Identifier: BSD-3-Clause
// Options of the best mode: what is known of the view, and how many parts.
#include "app.h"
#include "model_options.h"

#ifdef PCL_SQ_HAVE_OPENCV
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <memory>

namespace pcl_sq::app {

namespace {

/** \brief Options that only the paper's chain has: naming one asks for that chain. */
const char* const PAPER_OPTIONS[] = {"--fit",
                                     "--cost",
                                     "--axis-assignment",
                                     "--extents",
                                     "--pca",
                                     "--center",
                                     "--voxel-percent",
                                     "--voxel-size",
                                     "--divisions",
                                     "--run",
                                     "--exclusive"};

#ifdef PCL_SQ_HAVE_OPENCV
CellMask readMask(const std::string& path) {
  // OpenCV would add a warning of its own
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw Failure("'" + path + "' is no image that can be read; --mask wants a PNG.");
  CellMask mask(image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      mask.set(x, y, image.at<unsigned char>(y, x) > 127);
  return mask;
}
#endif

} // namespace

void addViewOptions(CLI::App& cli, ModelOptions& options) {
  auto preset = std::make_shared<std::string>();
  cli.add_option(
         "--preset",
         *preset,
         "best: points, outline and table, parts found; paper: the paper's chain "
         "(also chosen by its own options)")
      ->type_name("paper|best")
      ->default_str("best")
      ->check(CLI::IsMember({"paper", "best"}));
  options.estimation.decomposition = Decomposition::PARTS;
  cli.add_option("--parts",
                 options.estimation.object_fit.parts,
                 "Number of superquadrics; 0: found")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  cli.add_option("--max-parts",
                 options.estimation.object_fit.max_parts,
                 "Largest number of superquadrics that is looked for")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
#ifdef PCL_SQ_HAVE_OPENCV
  cli.add_option("--mask", options.mask, "Object's pixels as PNG (organized clouds)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
#endif
  cli.add_option("--intrinsics",
                 options.intrinsics,
                 "Camera of an organized cloud [px]; else found from the cloud")
      ->expected(4)
      ->delimiter(',')
      ->type_name("FX,FY,CX,CY");
  addFrameOptions(cli, options.frame);
  cli.parse_complete_callback([&cli, &options, preset] {
    const auto given = [&cli](const char* name) { // a program may lack the option
      const CLI::Option* option = cli.get_option_no_throw(name);
      return option && option->count() > 0;
    };
    const bool paper_option =
        std::any_of(std::begin(PAPER_OPTIONS), std::end(PAPER_OPTIONS), given);
    const bool paper = *preset == "paper" || (preset->empty() && paper_option);
    if (paper && !given("--decomposition"))
      options.estimation.decomposition = Decomposition::PRISMS;
    if (!paper && options.estimation.decomposition == Decomposition::NONE)
      options.estimation.fit = FitMode::FULL;
    if (paper && options.estimation.decomposition == Decomposition::PARTS)
      throw UsageError(
          "--decomposition parts is no part of the paper's chain; leave out "
          "the paper's options");
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
    view.mask = readMask(options.mask);
#endif
  return view;
}

} // namespace pcl_sq::app
