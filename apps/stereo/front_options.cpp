// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/image_file.h"
#include "stereo/stereo_front.h"

namespace pcl_sq::app {

void addPairOptions(CLI::App& cli, FrontOptions& o) {
  cli.add_option("--calib",
                 o.calib,
                 "Calibration: OpenCV's YAML, XML or JSON, ROS camera_info (left and "
                 "right), Kalibr's camchain, ZED's SN*.conf, Middlebury's calib.txt; "
                 "one file or two")
      ->expected(1, 2)
      ->type_name("FILE");
  cli.add_option("--calib-unit", o.calib_unit, "Length of its unit [m]")
      ->check(positiveNumber(1000.0))
      ->capture_default_str();
  cli.add_option("--baseline",
                 o.baseline,
                 "Distance of the cameras of a rectified pair [m], with --intrinsics "
                 "instead of --calib")
      ->check(positiveNumber(1000.0));
  cli.add_option_function<std::string>(
         "--matcher",
         [&o](const std::string& name) {
           o.matcher = name == "bm" ? StereoMatcher::BM : StereoMatcher::SGBM;
         },
         "Block matching or semi-global; default: bm in the paper's mode only")
      ->check(oneOf({"bm", "sgbm"}));
  cli.add_option(
         "--block-size", o.stereo.block_size, "Matched window [px], odd; 0: auto")
      ->check(wholeNumber(0, 51))
      ->capture_default_str();
  cli.add_option("--min-depth", o.stereo.min_depth, "Nearest depth [m]; 0: found")
      ->check(number(0.0, FARTHEST))
      ->capture_default_str();
  cli.add_option("--max-depth", o.stereo.max_depth, "Farthest depth [m]; 0: found")
      ->check(number(0.0, FARTHEST))
      ->capture_default_str();
  cli.add_option("--uniqueness", o.stereo.uniqueness, "Margin of the best match [%]")
      ->check(wholeNumber(0, 100))
      ->capture_default_str();
  cli.add_option(
         "--left-right", o.stereo.left_right_tolerance, "Check [px]; negative: none")
      ->check(wholeNumber(-1, 100))
      ->capture_default_str();
  cli.add_flag_function(
      "--refine,!--no-refine",
      [&o](std::int64_t given) { o.refine = given > 0; },
      "Least-squares matching with slanted windows after the matcher; default but in "
      "the paper's mode");
  cli.add_flag("--wls", o.stereo.wls, "Edge-aware smoothing of the disparities");
  cli.add_option("--depth",
                 o.depth,
                 "Depth image (16-bit PNG, float TIFF or PFM) instead of a right one")
      ->type_name("FILE");
  cli.add_option("--depth-scale,--depth-unit",
                 o.depth_scale,
                 "Length of one step of it [m]; default: .001 of 16 bits, 1 of floats")
      ->check(positiveNumber(1000.0));
}

void addFrontOptions(CLI::App& cli, FrontOptions& o) {
  cli.add_option("left", o.left, "Left image (with --depth: the colour image)")
      ->type_name("LEFT");
  cli.add_option("right", o.right, "Right image")->type_name("RIGHT");
  addPairOptions(cli, o);
  cli.add_option(
         "--segment",
         o.segment,
         "How the object's outline is found; none: only the box of --roi counts")
      ->default_str("grabcut")
      ->check(oneOf({"none", "color", "grabcut"}));
  cli.add_option("--click", o.click, "Hint: a pixel of the object")
      ->expected(2)
      ->delimiter(',')
      ->type_name("X,Y")
      ->check(wholeNumber(0, MAX_PIXELS));
  cli.add_option("--color", o.color, "Hint: the object's colour, 0 to 255 each")
      ->expected(3)
      ->delimiter(',')
      ->check(wholeNumber(0, 255))
      ->type_name("R,G,B");
  cli.add_flag("--border-filter",
               o.border_filter,
               "Texture-based filter of the object's rim (section IV)");
}

std::string unitOptionOf(const FrontOptions& o) {
  return !o.depth.empty()  ? "--depth-scale"
         : o.calib.empty() ? "--baseline"
                           : "--calib-unit";
}

void checkPairOptions(const FrontOptions& o) {
  std::string why;
  if (!o.stereo.isValid(&why))
    throw UsageError(why + ".");
  if (o.depth.empty()) {
    if (o.left.empty() || o.right.empty())
      throw UsageError("give a left and a right image (or --depth and --intrinsics).");
    if (o.calib.empty() && (o.baseline <= 0.0 || o.intrinsics.size() != 4))
      throw UsageError("--calib is missing; give the calibration of the pair, or "
                       "--intrinsics and --baseline of a rectified one.");
    if (!o.calib.empty() && (o.baseline > 0.0 || !o.intrinsics.empty()))
      throw UsageError(
          "the calibration file says the baseline and the intrinsics; give "
          "either --calib or --intrinsics and --baseline.");
  } else {
    if (!o.right.empty())
      throw UsageError("give either a right image or --depth, not both.");
    if (o.intrinsics.size() != 4)
      throw UsageError("--depth needs --intrinsics FX,FY,CX,CY.");
  }
}

void checkFrontOptions(const FrontOptions& o, const std::vector<int>& roi) {
  checkPairOptions(o);
  if (!o.depth.empty() && o.left.empty() && o.mask.empty() && !roi.empty() &&
      o.segment != "none")
    throw UsageError("give the colour image, or --segment none, for the depth image.");
  const bool box_only = o.segment == "none";
  if (!o.mask.empty() && !o.segment.empty() && !box_only)
    throw UsageError("give either --mask or --segment, not both.");
  if (box_only && (roi.empty() || !o.click.empty() || !o.color.empty()))
    throw UsageError("--segment none needs --roi and no other hint.");
  if (o.border_filter && box_only && o.mask.empty())
    throw UsageError(
        "--border-filter needs the object's outline: --segment or --mask.");
}

} // namespace pcl_sq::app
