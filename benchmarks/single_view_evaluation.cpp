// SPDX-License-Identifier: BSD-3-Clause
// Scores the single-view fit on the generated scenes (gen_scene.py: folders with
// cloud.pcd, mask.png, truth.json) and on bare clouds (gen.py, gen_multi.py: .xyz and
// .json). Usage: single_view_evaluation [--no-mask] [--no-view] [--parts] [-v]
//                [--no-taper] [--kind NAME] FOLDER...
#include "pcl_sq/fit_object.h"
#include "truth_scores.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>

using namespace pcl_sq;
using namespace pcl_sq::benchmark;
namespace fs = std::filesystem;

namespace {

struct Settings {
  bool mask = true, view = true, verbose = false;
  ObjectFitOptions fit;
  std::string kind;
  double correlation = 0.0, sigma = 0.0, dilation = 0.0; ///< 0: the default
};

struct Result {
  std::string name;
  Scores scores;
  std::size_t parts = 0, true_parts = 0;
  double milliseconds = 0.0;
};

struct Case {
  Eigen::Matrix3Xf points;
  int width = 0, height = 1;
  std::vector<int> object;
  ViewOptions view;
};

Case readScene(const fs::path& folder, const Truth& truth, const Settings& settings) {
  Case c;
  pcl::PointCloud<pcl::PointXYZ> cloud;
  if (pcl::io::loadPCDFile((folder / "cloud.pcd").string(), cloud) < 0)
    throw std::runtime_error("no cloud in " + folder.string());
  c.width = int(cloud.width);
  c.height = int(cloud.height);
  c.points.resize(3, Eigen::Index(cloud.size()));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    c.points.col(Eigen::Index(i)) = cloud[i].getVector3fMap();
  PinholeCamera camera;
  camera.fx = camera.fy = truth.f;
  camera.cx = truth.cx;
  camera.cy = truth.cy;
  c.view.camera = camera;
  if (settings.mask) {
    const cv::Mat image =
        cv::imread((folder / "mask.png").string(), cv::IMREAD_GRAYSCALE);
    c.view.mask = CellMask(image.cols, image.rows);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        c.view.mask.set(x, y, image.at<unsigned char>(y, x) > 127);
  }
  return c;
}

Case readBare(const fs::path& file, const Truth& truth, const Settings& settings) {
  Case c;
  std::ifstream in(file);
  std::vector<Eigen::Vector3f> points;
  float x, y, z;
  while (in >> x >> y >> z)
    points.emplace_back(x, y, z);
  c.points.resize(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    c.points.col(Eigen::Index(i)) = points[i];
  c.width = int(points.size());
  if (settings.view && truth.has_camera_center)
    c.view.viewpoint = truth.camera_center;
  return c;
}

Result evaluate(Case c, const Truth& truth, const Settings& settings) {
  Result r;
  r.name = truth.name;
  r.true_parts = truth.model.size();
  if (settings.correlation > 0.0)
    c.view.correlation = settings.correlation;
  if (settings.sigma > 0.0)
    c.view.mask_sigma = settings.sigma;
  if (settings.dilation > 0.0)
    c.view.mask_dilation = settings.dilation;
  const std::clock_t begin = std::clock();
  std::string why;
  ObjectFit fit;
  ObservedObject observed;
  const bool ok =
      observeObject(c.points, c.width, c.height, c.object, c.view, observed, &why);
  const std::clock_t seen = std::clock();
  if (ok)
    fit = fitObject(observed, settings.fit);
  else
    std::printf("  failed: %s\n", why.c_str());
  r.milliseconds = 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC;
  r.parts = fit.model.size();
  r.scores = score(truth.model, fit.model);
  if (settings.verbose) {
    std::printf("    observe %.1f ms, %d points, %zu contour, depth %.3f\n",
                1e3 * double(seen - begin) / CLOCKS_PER_SEC,
                int(observed.points.cols()),
                observed.contour.size(),
                observed.depth);
    if (truth.model.size() == 1 && observed.hasCamera()) {
      double sum = 0.0, square = 0.0, n = 0.0;
      for (const TangentPlane& plane :
           observed.evidence(observed.contour, 48, true).silhouette) {
        const double out = (plane.offset - truth.model.support(plane.normal)) /
                           plane.sigma * observed.outline_sigma;
        sum += out;
        square += out * out;
        n += 1.0;
      }
      std::printf(
          "    outline beyond the truth: mean %.2f px, deviation %.2f px of %d\n",
          sum / n,
          std::sqrt(square / n - sum * sum / n / n),
          int(n));
    }
    if (observed.table)
      std::printf("    table sigma %.2f mm, truth sticks out %.2f mm\n",
                  1e3 * observed.table->sigma,
                  1e3 * (truth.model.support(-observed.table->normal) -
                         observed.table->offset));
    std::printf("    extent %.3f m\n", observed.extent);
    std::printf("    misfit of one %.2f, effective %.0f\n",
                fit.misfit,
                observed.effective_points);
    for (const ViewFit& part : fit.parts) {
      const Superquadric& m = part.chosen.model;
      std::printf("    %s%s%s margin %.1f noise %.2f mm  a %.1f %.1f %.1f e %.2f %.2f "
                  "k %.2f %.2f |",
                  toString(part.chosen.shape),
                  part.chosen.upright ? " upright" : "",
                  part.chosen.on_axis ? " on axis" : "",
                  part.margin,
                  1e3 * part.noise,
                  1e3 * m.semi_axes[0],
                  1e3 * m.semi_axes[1],
                  1e3 * m.semi_axes[2],
                  m.epsilon1,
                  m.epsilon2,
                  m.kx,
                  m.ky);
      for (const ShapeCandidate& k : part.candidates)
        std::printf(" %s%s %.0f", toString(k.shape), k.upright ? "^" : "", k.bic);
      std::printf("\n");
    }
    for (const Superquadric& m : truth.model.parts)
      std::printf("    true a %.1f %.1f %.1f e %.2f %.2f taper %.2f %.2f\n",
                  1e3 * m.semi_axes[0],
                  1e3 * m.semi_axes[1],
                  1e3 * m.semi_axes[2],
                  m.epsilon1,
                  m.epsilon2,
                  m.kx,
                  m.ky);
    for (const std::string& note : observed.notes)
      std::printf("    note: %s\n", note.c_str());
  }
  return r;
}

void printTable(const std::map<std::string, std::vector<Result>>& kinds) {
  std::printf("%-10s %4s %7s %7s %6s %6s %9s %6s %8s %8s\n",
              "kind",
              "n",
              "IoU",
              "p10",
              ">.9",
              ">.8",
              "surf mm",
              "exact",
              "ms med",
              "ms max");
  for (const auto& [name, results] : kinds) {
    std::vector<double> iou, ms;
    double surface = 0.0, exact = 0.0, good = 0.0, fair = 0.0, sum = 0.0;
    for (const Result& r : results) {
      iou.push_back(r.scores.iou);
      ms.push_back(r.milliseconds);
      sum += r.scores.iou;
      surface += r.scores.surface;
      exact += r.parts == r.true_parts;
      good += r.scores.iou > 0.9;
      fair += r.scores.iou > 0.8;
    }
    std::sort(iou.begin(), iou.end());
    std::sort(ms.begin(), ms.end());
    const double n = double(results.size());
    std::printf("%-10s %4zu %7.4f %7.4f %5.0f%% %5.0f%% %9.3f %5.0f%% %8.1f %8.1f\n",
                name.c_str(),
                results.size(),
                sum / n,
                iou[std::size_t(0.1 * n)],
                100 * good / n,
                100 * fair / n,
                1e3 * surface / n,
                100 * exact / n,
                ms[ms.size() / 2],
                ms.back());
  }
}

} // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::vector<fs::path> folders;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--no-mask")
      settings.mask = false;
    else if (a == "--no-view")
      settings.view = false;
    else if (a == "--no-taper")
      settings.fit.fit.taper = false;
    else if (a == "--single")
      settings.fit.max_parts = 1;
    else if (a == "--max-parts" && i + 1 < argc)
      settings.fit.max_parts = std::atoi(argv[++i]);
    else if (a == "--correlation" && i + 1 < argc)
      settings.correlation = std::atof(argv[++i]);
    else if (a == "--sigma" && i + 1 < argc)
      settings.sigma = std::atof(argv[++i]);
    else if (a == "--dilation" && i + 1 < argc)
      settings.dilation = std::atof(argv[++i]);
    else if (a == "-v")
      settings.verbose = true;
    else if (a == "--kind" && i + 1 < argc)
      settings.kind = argv[++i];
    else
      folders.emplace_back(a);
  }
  std::map<std::string, std::vector<Result>> kinds;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> entries;
    if (fs::is_directory(folder))
      for (const auto& entry : fs::directory_iterator(folder))
        entries.push_back(entry.path());
    else
      entries.push_back(folder);
    if (fs::exists(folder / "truth.json"))
      entries = {folder};
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries) {
      const bool scene = fs::is_directory(entry);
      if (!scene && entry.extension() != ".xyz")
        continue;
      const fs::path truth_path =
          scene ? entry / "truth.json" : fs::path(entry).replace_extension(".json");
      const Truth truth = readTruth(truth_path.string());
      if (!settings.kind.empty() && settings.kind != truth.name)
        continue;
      const Case c =
          scene ? readScene(entry, truth, settings) : readBare(entry, truth, settings);
      const Result r = evaluate(c, truth, settings);
      if (settings.verbose)
        std::printf("%s %s IoU %.4f surface %.3f mm parts %zu/%zu %.1f ms\n",
                    entry.c_str(),
                    r.name.c_str(),
                    r.scores.iou,
                    1e3 * r.scores.surface,
                    r.parts,
                    r.true_parts,
                    r.milliseconds);
      kinds[r.name].push_back(r);
      kinds["~all"].push_back(r);
      if (r.true_parts == 1)
        kinds["~one part"].push_back(r);
    }
  }
  printTable(kinds);
  return 0;
}
