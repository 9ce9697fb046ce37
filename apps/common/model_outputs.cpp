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

} // namespace pcl_sq::app
