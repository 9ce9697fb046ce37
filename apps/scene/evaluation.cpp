// SPDX-License-Identifier: BSD-3-Clause
#include "scene/evaluation.h"

#include "scene/noise.h"
#include "scene/threads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_sq::app {
namespace {

constexpr double DEGREES = 180.0 / 3.14159265358979323846;

/** \brief Figures of distances; summed in order, so repeatable. */
DistanceFigures figuresOf(std::vector<double> d) {
  DistanceFigures figures;
  if (d.empty())
    return figures;
  for (double& value : d)
    value = std::abs(value);
  const auto n = static_cast<double>(d.size());
  figures.mean = std::accumulate(d.begin(), d.end(), 0.0) / n;
  figures.rms = std::sqrt(std::inner_product(d.begin(), d.end(), d.begin(), 0.0) / n);
  const auto middle = d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2);
  std::nth_element(d.begin(), middle, d.end());
  figures.median = *middle;
  figures.max = *std::max_element(middle, d.end());
  return figures;
}

/** \brief Distances of points from the model's parts; tells how far it is. */
DistanceFigures distancesToModel(const MultiSuperquadric& model,
                                 const Eigen::Matrix3Xd& points,
                                 unsigned int threads,
                                 const WorkDone& done) {
  constexpr Eigen::Index AT_A_TIME = 4096;
  std::vector<double> distances;
  distances.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index first = 0; first < points.cols(); first += AT_A_TIME) {
    const Eigen::VectorXd d = model.euclideanDistances(
        points.middleCols(first, std::min(AT_A_TIME, points.cols() - first)), threads);
    distances.insert(distances.end(), d.begin(), d.end());
    if (done)
      done("distances",
           static_cast<double>(distances.size()) / static_cast<double>(points.cols()));
  }
  return figuresOf(std::move(distances));
}

double areaOf(const TriangleMesh& mesh, std::vector<double>* running = nullptr) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
    if (running != nullptr)
      running->push_back(sum);
  }
  return sum;
}

/** \brief Points uniform in area. */
Eigen::Matrix3Xd sampleMesh(const TriangleMesh& mesh, std::size_t count) {
  std::vector<double> running;
  const double area = areaOf(mesh, &running);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double at = area * uniformOf(3 * i);
    const auto found = std::upper_bound(running.begin(), running.end(), at);
    const auto index =
        std::min<std::ptrdiff_t>(std::distance(running.begin(), found),
                                 static_cast<std::ptrdiff_t>(running.size()) - 1);
    const auto& t = mesh.triangles[static_cast<std::size_t>(index)];
    const double s = std::sqrt(uniformOf(3 * i + 1)), r = uniformOf(3 * i + 2);
    points.col(static_cast<Eigen::Index>(i)) = (1.0 - s) * mesh.vertices[t[0]] +
                                               s * (1.0 - r) * mesh.vertices[t[1]] +
                                               s * r * mesh.vertices[t[2]];
  }
  return points;
}

/** \brief Points of the union's surface: those of each part outside of the others. */
std::vector<Eigen::Vector3d> sampleUnion(const MultiSuperquadric& model,
                                         std::size_t count) {
  std::vector<double> areas;
  for (const Superquadric& part : model.parts)
    areas.push_back(areaOf(meshSuperquadric(part)));
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < model.size(); ++k) {
    const auto share =
        static_cast<std::size_t>(static_cast<double>(count) * areas[k] / total);
    for (const Eigen::Vector3d& p : sampleUniform(model.parts[k], share)) {
      bool hidden = false;
      for (std::size_t j = 0; j < model.size(); ++j)
        hidden = hidden || (j != k && model.parts[j].inMaterial(p));
      if (!hidden)
        points.push_back(p);
    }
  }
  return points;
}

/** \brief Rotation angle between two frames [deg]. */
double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const double c = 0.5 * ((a.transpose() * b).trace() - 1.0);
  return DEGREES * std::acos(std::clamp(c, -1.0, 1.0));
}

/** \brief Counts of samples in two sets and in both. */
struct Overlap {
  long in_model = 0, in_shape = 0, in_both = 0;
  void add(bool model, bool shape) {
    in_model += model ? 1 : 0;
    in_shape += shape ? 1 : 0;
    in_both += model && shape ? 1 : 0;
  }
  void add(const Overlap& o) {
    in_model += o.in_model;
    in_shape += o.in_shape;
    in_both += o.in_both;
  }
  double iou() const {
    const long in_any = in_model + in_shape - in_both;
    return in_any == 0 ? 0.0
                       : static_cast<double>(in_both) / static_cast<double>(in_any);
  }
};

/** \brief How far the model and the shape fill the same samples of a box, with their
 * hollows filled and as material. */
void measureVolumes(const MultiSuperquadric& model,
                    const MeshBvh& mesh,
                    const ReferenceShape& shape,
                    std::size_t samples,
                    int threads,
                    ShapeFigures& figures) {
  Eigen::AlignedBox3d box = model.boundingBox();
  for (const Eigen::Vector3d& v : shape.mesh.vertices)
    box.extend(shape.rotation * v + shape.translation);
  Overlap filled, material;
#pragma omp parallel num_threads(threads)
  {
    Overlap own_filled, own_material;
#pragma omp for schedule(dynamic, 512)
    for (std::size_t i = 0; i < samples; ++i) {
      const Eigen::Vector3d unit(
          uniformOf(3 * i), uniformOf(3 * i + 1), uniformOf(3 * i + 2));
      const Eigen::Vector3d p = box.min() + unit.cwiseProduct(box.sizes());
      const Eigen::Vector3d q = shape.rotation.transpose() * (p - shape.translation);
      const bool within = mesh.contains(q);
      own_filled.add(model.contains(p), within || mesh.isEnclosed(q));
      own_material.add(
          std::any_of(model.parts.begin(),
                      model.parts.end(),
                      [&p](const Superquadric& s) { return s.inMaterial(p); }),
          within);
    }
#pragma omp critical
    {
      filled.add(own_filled);
      material.add(own_material);
    }
  }
  const double per_sample = box.volume() / static_cast<double>(samples);
  figures.model_volume = per_sample * static_cast<double>(material.in_model);
  figures.true_volume = per_sample * static_cast<double>(material.in_shape);
  figures.iou = filled.iou();
  figures.iou_material = material.iou();
}

} // namespace

double axisError(const Eigen::Matrix3d& model,
                 const Eigen::Matrix3d& shape,
                 Symmetry symmetry) {
  if (symmetry == Symmetry::SPHERE)
    return 0.0;
  if (symmetry == Symmetry::REVOLUTION) {
    // any of the model's axes may be the upright one
    const double c = (model.transpose() * shape.col(2)).cwiseAbs().maxCoeff();
    return DEGREES * std::acos(std::min(1.0, c));
  }
  // names and signs of a superquadric's axes mean nothing: 24 right-handed frames
  double best = 360.0;
  int order[3] = {0, 1, 2};
  do
    for (int signs = 0; signs < 4; ++signs) {
      Eigen::Matrix3d frame;
      frame.col(0) = (signs & 1 ? -1.0 : 1.0) * model.col(order[0]);
      frame.col(1) = (signs & 2 ? -1.0 : 1.0) * model.col(order[1]);
      frame.col(2) = frame.col(0).cross(frame.col(1));
      best = std::min(best, angleBetween(frame, shape));
    }
  while (std::next_permutation(order, order + 3));
  return best;
}

ShapeFigures evaluateShape(const MultiSuperquadric& model,
                           const ReferenceShape& shape,
                           std::size_t samples,
                           unsigned int threads,
                           const WorkDone& done) {
  ShapeFigures figures;
  const MeshBvh mesh(shape.mesh);
  figures.true_size = mesh.box().sizes();
  Eigen::Vector3d middle;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d n = shape.rotation.col(k);
    const double high = model.support(n), low = -model.support(-n);
    figures.model_size[k] = high - low;
    middle[k] = 0.5 * (high + low);
  }
  const Eigen::Vector3d true_center =
      shape.rotation * mesh.box().center() + shape.translation;
  figures.center_error = shape.rotation * middle - true_center;
  const auto largest =
      std::max_element(model.parts.begin(), model.parts.end(), [](auto& a, auto& b) {
        return a.volume() < b.volume();
      });
  figures.axis_error_deg = axisError(largest->rotation, shape.rotation, shape.symmetry);
  const int count = threadCount(threads);
  if (done)
    done("volumes", 0.0);
  measureVolumes(model, mesh, shape, samples, count, figures);
  const std::vector<Eigen::Vector3d> on_model = sampleUnion(model, samples);
  std::vector<double> to_truth(on_model.size());
#pragma omp parallel for schedule(dynamic, 256) num_threads(count)
  for (std::size_t i = 0; i < on_model.size(); ++i)
    to_truth[i] =
        mesh.distance(shape.rotation.transpose() * (on_model[i] - shape.translation));
  figures.model_to_truth = figuresOf(std::move(to_truth));
  const Eigen::Matrix3Xd on_truth =
      (shape.rotation * sampleMesh(shape.mesh, samples)).colwise() + shape.translation;
  figures.truth_to_model = distancesToModel(model, on_truth, threads, done);
  return figures;
}

CloudFigures evaluateCloud(const MultiSuperquadric& model,
                           const Eigen::Matrix3Xd& points,
                           unsigned int threads,
                           const WorkDone& done) {
  CloudFigures figures;
  figures.points = static_cast<std::size_t>(points.cols());
  figures.distortion_mm = model.distortion(points, 1e-3);
  figures.distance = distancesToModel(model, points, threads, done);
  return figures;
}

} // namespace pcl_sq::app
