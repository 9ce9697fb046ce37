// SPDX-License-Identifier: BSD-3-Clause
// Stereo pairs of procedural objects with the exact truth.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/image_file.h"
#include "scene/mesh_reader.h"
#include "scene/truth.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::app;

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;

struct Options {
  std::string scene, mesh_path, folder, rig = "bumblebee";
  std::string up = "z";
  double mesh_unit = 1.0;
  double distance = 0.0, yaw = std::nan(""), pitch = 10.0;
  std::vector<double> offset{0.0, 0.0};
  double contrast = 1.0, noise = 2.0;
  int supersampling = 2;
  std::uint64_t seed = 1;
  bool distortion = false;
  unsigned int threads = 0;
};

void addOptions(CLI::App& cli, Options& o) {
  cli.add_option("scene", o.scene, "Object on the table")->check(oneOf(objectNames()));
  cli.add_option("--mesh", o.mesh_path, "Any object: OBJ, STL or PLY")
      ->type_name("FILE");
  cli.add_option("--mesh-up", o.up, "Axis of the mesh that points upwards")
      ->check(oneOf({"x", "y", "z"}))
      ->capture_default_str();
  cli.add_option("--mesh-unit", o.mesh_unit, "Length of the mesh's unit [m]")
      ->check(number(1e-6, 1e6))
      ->capture_default_str();
  cli.add_option("-o,--out", o.folder, "Folder for the results; made if absent")
      ->required()
      ->type_name("DIR");
  cli.add_option(
         "--rig", o.rig, "bumblebee: 1024x768, f 1310 px; vga: 640x480, f 811.6")
      ->check(oneOf({"bumblebee", "vga", "small"}))
      ->capture_default_str();
  cli.add_option("--distance", o.distance, "Depth of the object's middle [m]")
      ->check(number(0.3, 10.0));
  cli.add_option("--offset", o.offset, "Its place right and down of the axis [m]")
      ->expected(2)
      ->delimiter(',')
      ->type_name("X,Y")
      ->check(number(-10.0, 10.0));
  cli.add_option("--yaw", o.yaw, "Turn about the vertical [deg]")
      ->check(number(-360.0, 360.0));
  cli.add_option("--pitch", o.pitch, "Downward tilt of the camera [deg]")
      ->check(number(0.0, 80.0))
      ->capture_default_str();
  cli.add_option("--contrast", o.contrast, "Strength of the textures")
      ->check(number(0.0, 2.0))
      ->capture_default_str();
  cli.add_option("--noise", o.noise, "Sensor noise, sigma [grey levels]")
      ->check(number(0.0, 50.0))
      ->capture_default_str();
  cli.add_option("--supersampling", o.supersampling, "Rays per pixel and direction")
      ->check(wholeNumber(1, 8))
      ->capture_default_str();
  cli.add_option("--seed", o.seed, "Same seed, same bytes")
      ->check(wholeNumber(0, std::numeric_limits<long long>::max()))
      ->capture_default_str();
  cli.add_flag(
      "--distortion",
      o.distortion,
      "Also raw_left.png, raw_right.png, calib_raw.yml: the same scene through "
      "distorted, slightly turned cameras");
  cli.add_option("--threads", o.threads, "0 = all cores")->check(wholeNumber(0, 1024));
}

cv::Mat matrix(const Eigen::MatrixXd& m) {
  cv::Mat result(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
  for (int i = 0; i < result.rows; ++i)
    for (int j = 0; j < result.cols; ++j)
      result.at<double>(i, j) = m(i, j);
  return result;
}

Eigen::Matrix3d cameraMatrix(const SceneCamera& c) {
  Eigen::Matrix3d k;
  k << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1;
  return k;
}

/** \brief P1, P2 and Q of the ideal rig under OpenCV's names. */
void writeProjections(cv::FileStorage& out, const StereoRig& rig) {
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(3, 4);
  p.leftCols<3>() = cameraMatrix(rig.left);
  out << "P1" << matrix(p);
  p(0, 3) = -rig.left.fx * rig.baseline;
  out << "P2" << matrix(p);
  Eigen::Matrix4d q = Eigen::Matrix4d::Identity();
  q(0, 3) = -rig.left.cx;
  q(1, 3) = -rig.left.cy;
  q(2, 2) = 0.0;
  q(2, 3) = rig.left.fx;
  q(3, 3) = 0.0;
  q(3, 2) = 1.0 / rig.baseline;
  out << "Q" << matrix(q);
}

void writeCalibration(const std::string& path,
                      const StereoRig& ideal,
                      const StereoRig* raw) {
  cv::FileStorage out(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  out << "image_width" << ideal.left.width << "image_height" << ideal.left.height;
  if (raw != nullptr) {
    const Eigen::Matrix3d relative =
        raw->right.rotation * raw->left.rotation.transpose();
    const Eigen::Vector3d t =
        raw->right.rotation * (raw->left.position - raw->right.position);
    out << "M1" << matrix(cameraMatrix(raw->left)) << "D1"
        << cv::Mat(raw->left.distortion, true).reshape(1, 1) << "M2"
        << matrix(cameraMatrix(raw->right)) << "D2"
        << cv::Mat(raw->right.distortion, true).reshape(1, 1) << "R" << matrix(relative)
        << "T" << matrix(t);
    // this rectification leads to the ideal rig, in whose frame the truth is
    out << "R1" << matrix(raw->left.rotation.transpose()) << "R2"
        << matrix(raw->right.rotation.transpose());
  }
  writeProjections(out, ideal);
  writeOutput(path, out.releaseAndGetString());
}

void writeRendered(const std::string& path, RenderedImage image) {
  writeImage(path, cv::Mat(image.height, image.width, CV_8UC3, image.bgr.data()));
}

StereoRig makeRig(const Options& o) {
  if (o.rig == "bumblebee")
    return app::makeRig(1024, 768, 1310.0, 0.12);
  return o.rig == "vga" ? app::makeRig(640, 480, 811.6, 0.12)
                        : app::makeRig(320, 240, 405.8, 0.12);
}

SceneTruth makeTruth(const Options& o,
                     const SceneObject& object,
                     const Scene& scene,
                     const StereoRig& rig,
                     const RenderedTruth& seen) {
  SceneTruth t;
  t.scene =
      o.scene.empty() ? std::filesystem::path(o.mesh_path).stem().string() : o.scene;
  t.seed = o.seed;
  t.width = rig.left.width;
  t.height = rig.left.height;
  t.focal_length = rig.left.fx;
  t.cx = rig.left.cx;
  t.cy = rig.left.cy;
  t.baseline = rig.baseline;
  t.rotation = scene.rotation;
  t.translation = scene.translation;
  t.size = object.box().sizes();
  t.symmetry = object.symmetry;
  t.mesh = "mesh.ply";
  for (Superquadric s : object.superquadrics.parts) {
    s.center = scene.rotation * s.center + scene.translation;
    s.rotation = scene.rotation * s.rotation;
    t.parts.parts.push_back(s);
  }
  t.table << scene.table_normal, scene.table_offset;
  t.roi = seen.roi;
  t.visible_pixels = seen.visible_pixels;
  return t;
}

int work(const Options& o) {
  if (o.scene.empty() == o.mesh_path.empty())
    throw UsageError("give one scene or --mesh FILE.");
  if (o.offset.size() != 2)
    throw UsageError("--offset needs two numbers: X,Y.");
  claimInput(o.mesh_path);
  claimFolder(o.folder);
  SceneObject object = o.mesh_path.empty()
                           ? makeObject(o.scene)
                           : makeObject(readMesh(o.mesh_path), o.up[0], o.mesh_unit);
  const double distance = o.distance > 0.0 ? o.distance : object.distance;
  const double yaw = std::isnan(o.yaw) ? object.yaw : o.yaw * DEGREE;
  Scene scene = placeOnTable(
      object.box(), {o.offset[0], o.offset[1], distance}, yaw, o.pitch * DEGREE);
  scene.color = object.color;
  scene.contrast = o.contrast;
  scene.noise_sigma = o.noise;
  scene.supersampling = o.supersampling;
  scene.seed = o.seed;
  const MeshBvh mesh(object.mesh);
  const StereoRig rig = makeRig(o);
  const RenderedTruth seen = renderTruth(scene, mesh, rig.left, o.threads);
  if (seen.visible_pixels == 0)
    throw Failure(
        "the object is not in sight; change --distance, --offset or --pitch.");

  makeFolder(o.folder);
  const std::string folder = o.folder + "/";
  std::vector<std::string> names = {"left.png",
                                    "right.png",
                                    "calib.yml",
                                    "disparity.pfm",
                                    "mask.png",
                                    "mesh.ply",
                                    "truth.json"};
  if (o.distortion)
    names.insert(names.end(), {"raw_left.png", "raw_right.png", "calib_raw.yml"});
  for (const std::string& name : names)
    claimOutput("--out", folder + name);
  Progress progress("Rendering", o.distortion ? 4 : 2);
  writeRendered(folder + "left.png", render(scene, mesh, rig.left, 0, o.threads));
  progress.update(1);
  writeRendered(folder + "right.png", render(scene, mesh, rig.right, 1, o.threads));
  progress.update(2);
  writeCalibration(folder + "calib.yml", rig, nullptr);
  if (o.distortion) {
    const StereoRig raw = distorted(rig);
    writeRendered(folder + "raw_left.png", render(scene, mesh, raw.left, 2, o.threads));
    progress.update(3);
    writeRendered(folder + "raw_right.png",
                  render(scene, mesh, raw.right, 3, o.threads));
    progress.update(4);
    writeCalibration(folder + "calib_raw.yml", rig, &raw);
  }
  cv::Mat disparity(seen.height, seen.width, CV_32F);
  for (int i = 0; i < seen.height * seen.width; ++i) // nothing in sight: infinitely far
    disparity.ptr<float>()[i] = static_cast<float>(
        rig.left.fx * rig.baseline / seen.depth[static_cast<std::size_t>(i)]);
  writeImage(folder + "disparity.pfm", disparity);
  writeImage(
      folder + "mask.png",
      cv::Mat(
          seen.height, seen.width, CV_8U, const_cast<std::uint8_t*>(seen.mask.data())));
  writePly(folder + "mesh.ply", object.mesh);
  const SceneTruth truth = makeTruth(o, object, scene, rig, seen);
  writeOutput(folder + "truth.json", toJson(truth));
  if (!quiet())
    std::cout << truth.scene << ": " << seen.visible_pixels << " px in the box "
              << seen.roi.x << ',' << seen.roi.y << ',' << seen.roi.width << ','
              << seen.roi.height << '\n';
  return DONE;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  return run(
      argc,
      argv,
      "pcl_sq_render",
      "Renders a stereo pair of an object on a table, with the exact truth.",
      "  pcl_sq_render bottle --out bottle\n"
      "  pcl_sq_render cup --out cup --rig vga --seed 7 --distortion\n"
      "  pcl_sq_render --mesh mug.stl --out mug --distance 0.8\n",
      [&](CLI::App& cli) { addOptions(cli, options); },
      [&] { return work(options); });
}
