// SPDX-License-Identifier: BSD-3-Clause
// What the user reads of a model: its size, its parts, what to know about it.
#include "report/summary.h"

#include "command_line/app.h"
#include "report/text.h"

#include "pcl_sq/sides.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

namespace pcl_sq::app {

namespace {

void printParts(const ModelResult& result) {
  const ModelFile& file = result.file;
  std::printf("  part  points   sides [mm]                e1    e2    rms [mm]\n");
  for (std::size_t i = 0; i < file.model.size(); ++i) {
    const Superquadric& s = file.model.parts[i];
    const PartStatistics& statistics = file.statistics[i];
    const Eigen::Vector3d sides = 1e3 * sidesOf(s);
    std::printf("  %4zu  %6zu   %7.1f %7.1f %7.1f   %4.2f  %4.2f  %7.2f",
                i + 1,
                statistics.points,
                sides.x(),
                sides.y(),
                sides.z(),
                s.epsilon1,
                s.epsilon2,
                1e3 * statistics.rms_distance);
    if (s.isTapered())
      std::printf("   taper %.3f %.3f", s.kx, s.ky);
    if (s.isBent())
      std::printf("   bent, radius %.0f mm", 1e3 / std::abs(s.bend));
    if (s.isHollow())
      std::printf("   open, wall %.1f mm", 1e3 * s.wall);
    std::printf("\n");
  }
}

} // namespace

ObjectSize sizeOf(const ModelResult& result) {
  ObjectSize size;
  const MultiSuperquadric model = result.file.model;
  const OrientedBox box = boxAround(model, result.up);
  size.sides = 2.0 * box.half_sizes;
  size.upright = result.up.has_value();
  if (result.file.table) {
    const auto& table = *result.file.table;
    size.sides.z() = model.support({table[0], table[1], table[2]}) + table[3];
    size.on_table = true;
  } else if (!size.upright) // no side is the height: the longest first
    std::sort(size.sides.data(), size.sides.data() + 3, std::greater<>());
  return size;
}

void printSummary(const ModelResult& result) {
  const ModelFile& file = result.file;
  std::printf("%s: %zu points, %zu of them the object, %zu superquadric%s\n",
              printable(file.input_path).c_str(),
              file.input_points,
              result.report.region_points,
              file.model.size(),
              file.model.size() == 1 ? "" : "s");
  const ObjectSize size = sizeOf(result);
  std::printf("  size %.1f x %.1f x %.1f mm%s\n",
              1e3 * size.sides.x(),
              1e3 * size.sides.y(),
              1e3 * size.sides.z(),
              size.on_table  ? " (width x depth x height above the table)"
              : size.upright ? " (width x depth x height)"
                             : "");
  if (result.report.view.points.cols() > 0)
    std::printf("  confidence %.0f %%\n", 100.0 * result.report.confidence);
  printParts(result);
  if (result.taper)
    std::printf("  a taper is %s by the points (margin %.1f, %.0f would do)\n",
                result.taper->model.isTapered() ? "demanded" : "not demanded",
                result.taper->margin,
                TaperedFit::DEMAND);
  std::printf(
      "  distortion (paper's unit) %.3f, rms distance %.2f mm, %zu grasp points\n",
      file.distortion * std::sqrt(1e9),
      1e3 * file.rms_distance,
      result.report.grasp_indices.size());
  std::printf("  time:");
  for (const auto& [stage, ms] : file.timings_ms)
    std::printf(" %s %.1f ms", stage.c_str(), ms);
  std::printf("\n");
}

void printNotes(const ModelResult& result, const std::string& cloud) {
  for (const std::string& sentence : result.report.notes)
    note(sentence, cloud);
}

std::string wordsFor(const std::string& stage) {
  static const std::map<std::string, const char*> words = {
      {"load", "reading"},
      {"object", "finding the object"},
      {"crop", "finding the object"},
      {"observe", "looking at the object"},
      {"decompose", "dividing the object"},
      {"fit", "fitting"},
      {"taper", "fitting tapers"},
      {"evaluate", "measuring"},
      {"grasp_points", "finding grasp points"},
      {"look", "looking at the scene"},
      {"table", "finding the table"},
      {"match", "matching the images"},
      {"segment", "finding the object in the image"},
      {"roi", "finding the object in depth"}};
  const auto found = words.find(stage);
  return found == words.end() ? stage : found->second;
}

} // namespace pcl_sq::app
