// SPDX-License-Identifier: BSD-3-Clause
#include "app.h"
#include "cloud_bytes.h"
#include "files.h"
#include "model_options.h"

#include "pcl_sq/grasp_point_filter.h"

#ifdef PCL_SQ_HAVE_VISUALIZATION
#include "cloud_picture.h"
#include "pcl_sq/visualization/mesh_writer.h"
#include "pcl_sq/visualization/snapshot_renderer.h"
#endif

#include <cstdio>

namespace pcl_sq::app {

namespace {

void writeGraspPoints(const std::string& path,
                      const LoadedCloud& input,
                      const MultiSuperquadric& model,
                      const pcl::Indices& indices) {
  GraspPointFilter<pcl::PointXYZRGBA> filter;
  filter.setInputCloud(input.cloud);
  filter.setModel(model);
  pcl::PointCloud<PointGrasp> points;
  filter.describe(indices, points);
  if (points.empty())
    throw Failure("no point lies on the model's surface; '" + path +
                  "' is not written.");
  writeOutput(path, pcdBytes(points));
}

#ifdef PCL_SQ_HAVE_VISUALIZATION
void writeSnapshot(const std::string& path,
                   const LoadedCloud& input,
                   const ModelResult& result) {
  SnapshotOptions picture;
  if (result.up)
    picture.up = *result.up;
  picture.sensor = result.sensor;
  SnapshotRenderer renderer(picture);
  addCloud(renderer, input);
  addModel(renderer, result.file);
  renderer.save(path);
  noteWritten(path);
}
#endif

} // namespace

void writeOutputs(const LoadedCloud& input,
                  const ModelResult& result,
                  const ModelOptions& options) {
  if (!options.output.empty())
    writeOutput(options.output, toJson(result.file) + "\n");
  if (!options.grasp_points.empty())
    writeGraspPoints(
        options.grasp_points, input, result.file.model, result.report.grasp_indices);
#ifdef PCL_SQ_HAVE_VISUALIZATION
  if (!options.mesh.empty()) {
    writeMesh(options.mesh, meshesOf(result.file));
    noteWritten(options.mesh);
  }
  if (!options.snapshot.empty())
    writeSnapshot(options.snapshot, input, result);
#endif
}

void printSummary(const ModelResult& result) {
  const ModelFile& file = result.file;
  std::printf("%s: %zu points, %zu of them the object, %zu superquadric%s\n",
              file.input_path.c_str(),
              file.input_points,
              result.report.region_points,
              file.model.size(),
              file.model.size() == 1 ? "" : "s");
  std::printf("  part  points   size along its axes [mm]   e1    e2    rms [mm]\n");
  for (std::size_t i = 0; i < file.model.size(); ++i) {
    const Superquadric& s = file.model.parts[i];
    const PartStatistics& statistics = file.statistics[i];
    std::printf("  %4zu  %6zu   %7.1f %7.1f %7.1f   %4.2f  %4.2f  %7.2f",
                i + 1,
                statistics.points,
                2e3 * s.semi_axes.x(),
                2e3 * s.semi_axes.y(),
                2e3 * s.semi_axes.z(),
                s.epsilon1,
                s.epsilon2,
                1e3 * statistics.rms_distance);
    if (i < file.tapers.size())
      std::printf("   taper %.3f %.3f", file.tapers[i][0], file.tapers[i][1]);
    std::printf("\n");
  }
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

} // namespace pcl_sq::app
