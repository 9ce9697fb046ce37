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
  const auto numbers = [&cli](const char* name,
                              std::vector<double>& values,
                              int count,
                              const char* type,
                              const char* description) {
    cli.add_option(name, values, description)
        ->expected(count)
        ->delimiter(',')
        ->type_name(type);
  };
  numbers("--intrinsics",
          options.intrinsics,
          4,
          "FX,FY,CX,CY",
          "Camera of an organized cloud [px]; else found from the cloud");
  numbers("--viewpoint",
          options.viewpoint,
          3,
          "X,Y,Z",
          "Camera's place [m]; else the cloud's own; the origin only where its points "
          "look so");
  numbers("--table",
          options.table,
          4,
          "NX,NY,NZ,D",
          "Table n.p + d = 0, n towards the camera; else found in organized clouds");
  cli.parse_complete_callback([&cli, &options, preset] {
    const auto given = [&cli](const char* name) { // a program may lack the option
      const CLI::Option* option = cli.get_option_no_throw(name);
      return option && option->count() > 0;
    };
    const bool paper_option =
        std::any_of(std::begin(PAPER_OPTIONS), std::end(PAPER_OPTIONS), given);
    const bool paper = *preset == "paper" || (preset->empty() && paper_option);
    EstimationOptions& estimation = options.estimation;
    if (paper && !given("--decomposition"))
      estimation.decomposition = EstimationOptions::paper().decomposition;
    if (!given("--fit") && (paper || estimation.decomposition == Decomposition::PRISMS))
      estimation.fit = EstimationOptions::paper().fit;
    if (paper && estimation.decomposition == Decomposition::PARTS)
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
  if (options.viewpoint.size() == 3)
    view.viewpoint = Eigen::Vector3d(
        options.viewpoint[0], options.viewpoint[1], options.viewpoint[2]);
  if (options.table.size() == 4) {
    TableModel table;
    table.normal =
        Eigen::Vector3d(options.table[0], options.table[1], options.table[2]);
    const double length = table.normal.norm();
    if (!(length > 0.0))
      throw Failure("the normal of --table must not be zero.");
    table.normal /= length;
    table.offset = options.table[3] / length;
    view.table = table;
  }
#ifdef PCL_SQ_HAVE_OPENCV
  if (!options.mask.empty())
    view.mask = readMask(options.mask);
#endif
  return view;
}

} // namespace pcl_sq::app
