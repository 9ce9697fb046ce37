// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"
#include "files/cloud_bytes.h"
#include "files/files.h"
#include "options/model_options.h"
#include "options/offset.h"

#include "pcl_sq/grasp_point_filter.h"

#ifdef PCL_SQ_HAVE_VISUALIZATION
#include "model/cloud_picture.h"
#include "pcl_sq/visualization/mesh_writer.h"
#include "pcl_sq/visualization/snapshot_renderer.h"
#endif

namespace pcl_sq::app {

namespace {

/** \brief The model where the cloud's floats are. */
ModelFile nearFile(const LoadedCloud& input, const ModelResult& result) {
  ModelFile file = result.file;
  file.model = moved(std::move(file.model), -input.offset);
  return file;
}

/** \brief Says of a file of floats that it cannot hold georeferenced coordinates. */
void tellOffset(const std::string& path, const Eigen::Vector3d& offset) {
  if (offset.isZero())
    return;
  char text[120];
  std::snprintf(
      text, sizeof(text), "%.0f %.0f %.0f m", offset.x(), offset.y(), offset.z());
  note("'" + path + "' holds single precision: its coordinates are less by " + text);
}

void writeGraspPoints(const std::string& path,
                      const LoadedCloud& input,
                      const MultiSuperquadric& model,
                      const pcl::Indices& indices) {
  GraspPointFilter<pcl::PointXYZRGBA> filter;
  filter.setInputCloud(input.cloud);
  filter.setModel(model);
  pcl::PointCloud<PointGrasp> points;
  filter.describe(indices, points);
  tellOffset(path, input.offset);
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
  if (result.sensor)
    picture.sensor = *result.sensor - input.offset;
  SnapshotRenderer renderer(picture);
  addCloud(renderer, input);
  renderer.addModel(nearFile(input, result).model);
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
    writeGraspPoints(options.grasp_points,
                     input,
                     nearFile(input, result).model,
                     result.report.grasp_indices);
#ifdef PCL_SQ_HAVE_VISUALIZATION
  const std::string format = formatOf(options.mesh, ".ply");
  const bool single_precision = format == ".ply" || format == ".stl";
  if (!options.mesh.empty()) {
    writeMesh(options.mesh,
              meshesOf(single_precision ? nearFile(input, result) : result.file));
    noteWritten(options.mesh);
    if (single_precision)
      tellOffset(options.mesh, input.offset);
  }
  if (!options.snapshot.empty())
    writeSnapshot(options.snapshot, input, result);
#endif
  writeExports(options.exported, result.file, &input);
}

} // namespace pcl_sq::app
