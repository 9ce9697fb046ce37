// SPDX-License-Identifier: BSD-3-Clause
// Stereo pair (or depth image) in, union of superquadrics out.
#include "command_line/app.h"
#include "files/cloud_bytes.h"
#include "files/files.h"
#include "files/image_file.h"
#include "options/model_options.h"
#include "pcl_sq/stereo/histogram_plot.h"
#include "report/summary.h"
#include "stereo/panel.h"
#include "stereo/sequence.h"
#include "stereo/stereo_cloud.h"
#include "stereo/stereo_front.h"
#include "stereo/stereo_model.h"

#include <opencv2/core.hpp>
#include <pcl/common/io.h>

#include <cfloat>
#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::app;

namespace {

struct Outputs {
  std::string cloud, object_cloud, disparity, panel, mask, histogram;
};

void addOutputs(CLI::App& cli, Outputs& o) {
  cli.add_option("--cloud", o.cloud, "Organized cloud as .pcd or .ply")
      ->type_name("FILE");
  cli.add_option("--object-cloud", o.object_cloud, "The object's points alone")
      ->type_name("FILE");
  cli.add_option(
         "--disparity",
         o.disparity,
         "Disparity: .png (16-bit, 1/256 px, 0 = none) or .pfm (px, inf = none)")
      ->type_name("FILE");
  cli.add_option("--panel", o.panel, "The steps side by side, as the paper's Fig. 5")
      ->type_name("FILE");
  cli.add_option("--write-mask", o.mask, "The object's mask as PNG")->type_name("FILE");
  cli.add_option("--histogram", o.histogram, "Depth histogram with the aperture as PNG")
      ->type_name("FILE");
}

void checkOutputs(const Outputs& o) {
  claimOutput("--cloud", o.cloud, {".pcd", ".ply"});
  claimOutput("--object-cloud", o.object_cloud, {".pcd", ".ply"});
  claimOutput("--disparity", o.disparity, {".png", ".pfm"});
  claimImage("--panel", o.panel);
  claimImage("--write-mask", o.mask);
  claimImage("--histogram", o.histogram);
}

void writeDisparity(const std::string& path, const cv::Mat& disparity) {
  const cv::Mat missing = ~(disparity > -FLT_MAX); // a NaN is not larger
  cv::Mat out = disparity.clone();
  if (formatOf(path, ".png") == ".pfm")
    out.setTo(std::numeric_limits<float>::infinity(), missing);
  else {
    out.setTo(0.0f, missing);
    out.convertTo(out, CV_16U, 256.0);
  }
  writeImage(path, out);
}

void writeCloud(const std::string& path,
                const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
  writeOutput(path,
              formatOf(path, ".pcd") == ".ply" ? plyBytes(cloud) : pcdBytes(cloud));
}

PanelInput panelInput(const StereoView& front,
                      const LoadedCloud& scene,
                      const LoadedCloud& object,
                      const ModelResult& result) {
  PanelInput in;
  in.image = front.stereo.left;
  if (in.image.empty()) // a depth image without colours
    in.image = cv::Mat(static_cast<int>(front.stereo.cloud->height),
                       static_cast<int>(front.stereo.cloud->width),
                       CV_8UC3,
                       cv::Scalar::all(180));
  in.mask = front.segment.mask;
  in.rect = front.rect;
  in.histogram = front.histogram;
  in.disparity_scale = front.stereo.intrinsics.fx * front.stereo.intrinsics.baseline;
  static_cast<CameraIntrinsics&>(in.camera) = front.stereo.intrinsics;
  in.region = front.region;
  in.cloud = scene.cloud;
  in.object = object.cloud;
  in.report = result.report;
  in.model = result.file.model;
  return in;
}

/** \brief The whole pair in full detail: of what is not the object, models need less.
 */
StereoResult wholeOf(const StereoResult& stereo, StereoOptions options) {
  if (stereo.detail.empty())
    return stereo;
  options.check_order = false; // the order was seen to be right
  StereoReprojector reprojector(StereoCalibration::fromRectified(stereo.intrinsics));
  reprojector.setOptions(options);
  return reprojector.compute(stereo.left, stereo.right);
}

void writeFront(const StereoView& front,
                const StereoOptions& options,
                const Outputs& outputs) {
  const StereoIntrinsics& k = front.stereo.intrinsics;
  if (!outputs.disparity.empty() || !outputs.cloud.empty()) {
    const StereoResult whole = wholeOf(front.stereo, options);
    if (!outputs.disparity.empty())
      writeDisparity(outputs.disparity, whole.disparity);
    if (!outputs.cloud.empty())
      writeCloud(outputs.cloud, *whole.cloud);
  }
  if (!outputs.mask.empty() && !front.segment.mask.empty())
    writeImage(outputs.mask, front.segment.mask);
  if (!outputs.histogram.empty())
    writeImage(outputs.histogram,
               plotDepthHistogram(front.histogram, k.fx * k.baseline));
  if (!outputs.object_cloud.empty()) {
    pcl::PointCloud<pcl::PointXYZRGB> points;
    pcl::copyPointCloud(*front.stereo.cloud, front.object, points);
    writeCloud(outputs.object_cloud, points);
  }
}

/** \brief Where no outline was found the mask is that of the points' pixels. */
void writePixels(const CellMask& pixels, const std::string& path) {
  if (pixels.cells.empty()) {
    note("there is no outline of the object, so '" + path +
         "' is not written; give another hint");
    return;
  }
  cv::Mat mask(pixels.height, pixels.width, CV_8U);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      mask.at<std::uint8_t>(y, x) = pixels(x, y) ? 255 : 0;
  writeImage(path, mask);
}

/** \brief Refuses what is for a single model. */
void checkSequence(const ModelOptions& model, const Outputs& o) {
  const bool files = !model.mesh.empty() || !model.grasp_points.empty() ||
                     !model.snapshot.empty() || model.exported.any();
  for (const std::string* output :
       {&o.cloud, &o.object_cloud, &o.disparity, &o.panel, &o.mask, &o.histogram})
    if (files || !output->empty())
      throw UsageError("--sequence goes with -o alone; pictures, clouds, masks, meshes "
                       "and exports are for one pair.");
  if (model.output.empty())
    claimOutput("--sequence", "-");
}

int work(FrontOptions front_options, ModelOptions model, const Outputs& outputs) {
  chooseMatcher(model, front_options);
  front_options.mask = model.mask;
  front_options.intrinsics = model.intrinsics;
  checkFrontOptions(front_options, model.roi);
  model.cloud.unit_option = unitOptionOf(front_options);
  claimInput(model.mask);
  if (!front_options.sequence)
    for (const std::string& input :
         {front_options.left, front_options.right, front_options.depth})
      claimInput(input);
  for (const std::string& calibration : front_options.calib)
    claimInput(calibration);
  checkModelOptions(model);
  if (!front_options.depth.empty() && !outputs.disparity.empty())
    throw UsageError("a depth image has no disparity to write; leave out --disparity.");
  checkOutputs(outputs);
  if (front_options.sequence) {
    checkSequence(model, outputs);
    return runSequence(front_options, model);
  }
  StageLine line;
  model.estimation.progress = [&line](const std::string& stage, double share) {
    line.show(wordsFor(stage), share);
  };
  front_options.progress = model.estimation.progress;
  std::optional<StereoPipeline> pipeline;
  const StereoView front = runFront(front_options, model.roi, pipeline);
  line.clear();
  for (const std::string& sentence : front.notes)
    note(sentence);
  writeFront(front, pipeline->getOptions().stereo, outputs);
  StereoModel made = makeStereoModel(front_options, front, model);
  line.clear();
  const ModelResult& result = made.result;
  printNotes(result);
  if (!outputs.mask.empty() && front.segment.mask.empty())
    writePixels(result.report.view.pixels, outputs.mask);
  writeOutputs(made.object, result, model);
  if (!outputs.panel.empty())
    writeImage(outputs.panel,
               drawPanel(panelInput(front, made.scene, made.object, result)));
  if (!quiet())
    printSummary(result);
  return DONE;
}

} // namespace

int main(int argc, char** argv) {
  FrontOptions front;
  ModelOptions model;
  Outputs outputs;
  return run(
      argc,
      argv,
      "pcl_sq_stereo",
      "Fits a union of superquadrics to the object in a stereo pair.",
      "  pcl_sq_stereo left.png right.png --calib calib.yml -o model.json "
      "--panel panel.png\n"
      "  pcl_sq_stereo im0.png im1.png --calib calib.txt --roi 481,179,62,407 "
      "--segment grabcut\n"
      "  pcl_sq_stereo left.png right.png --calib calib.yml --matcher sgbm "
      "--click 512,380 --cloud scene.pcd\n"
      "  pcl_sq_stereo left.png right.png --calib left.yaml right.yaml -o model.json\n"
      "  pcl_sq_stereo left.png right.png --intrinsics 1310,1310,511.5,383.5 "
      "--baseline .12\n"
      "  pcl_sq_stereo color.png --depth depth.png --intrinsics 616,616,310,237\n"
      "  pcl_sq_stereo --sequence 'left_*.png' 'right_*.png' --calib calib.yml "
      "-o models.jsonl\n",
      [&](CLI::App& cli) {
        addFrontOptions(cli, front);
        cli.add_flag("--sequence",
                     front.sequence,
                     "The images are patterns (in quotes) of frames that follow each "
                     "other: one JSON line per frame; what fails has an \"error\". A "
                     "hint is for the first frame, and others start from the last one");
        addOutputs(cli, outputs);
        addModelOptions(cli, model);
      },
      [&] { return work(front, model, outputs); });
}
