// SPDX-License-Identifier: BSD-3-Clause
// Share of planned grasps that hold on the TRUE shape, found with other means than the
// planner's: the closing line is cast through a mesh of the truth, collisions are
// looked for with points of its surface.
#include "command_line/app.h"
#include "files/cloud_io.h"
#include "files/files.h"
#include "grasp_truth.h"
#include "scene/mesh_reader.h"

#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/model_io.h"

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include <pcl/common/point_tests.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

using namespace pcl_sq;
using namespace nlohmann::literals;

namespace {

/** \brief The points without those far from the others, as the outliers of a stereo
 * camera are: beyond three times the median distance from the median. */
Eigen::Matrix3Xd withoutOutliers(const Eigen::Matrix3Xd& points) {
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  Eigen::Vector3d middle;
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd row = points.row(k);
    middle[k] = median({row.data(), row.data() + row.size()});
  }
  const Eigen::VectorXd distances = (points.colwise() - middle).colwise().norm();
  const double limit =
      3.0 * median({distances.data(), distances.data() + distances.size()});
  Eigen::Matrix3Xd kept(3, points.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (distances[i] <= limit)
      kept.col(count++) = points.col(i);
  return kept.leftCols(count);
}

/** \brief One box around points, along their principal axes: the baseline. */
MultiSuperquadric principalBox(const Eigen::Matrix3Xd& all) {
  const Eigen::Matrix3Xd points = withoutOutliers(all);
  const Eigen::Vector3d mean = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred *
                                                            centred.transpose());
  Superquadric box;
  box.rotation = axes.eigenvectors();
  if (box.rotation.determinant() < 0.0)
    box.rotation.col(0) *= -1.0;
  const Eigen::Matrix3Xd local = box.rotation.transpose() * centred;
  Eigen::Vector3d low, high; // 1 % left out on each side
  for (int k = 0; k < 3; ++k) {
    std::vector<double> row(std::size_t(local.cols()));
    Eigen::VectorXd::Map(row.data(), local.cols()) = local.row(k);
    std::sort(row.begin(), row.end());
    low[k] = row[row.size() / 100];
    high[k] = row[row.size() - 1 - row.size() / 100];
  }
  box.semi_axes = (0.5 * (high - low)).cwiseMax(1e-3);
  box.center = mean + box.rotation * (0.5 * (low + high));
  box.epsilon1 = box.epsilon2 = 0.1;
  MultiSuperquadric model;
  model.parts = {box};
  return model;
}

/** \brief The true parts a little wrong: sizes by 5 %, places by 3 mm, turned by 2
 * degrees, exponents by 0.1. */
MultiSuperquadric perturbed(MultiSuperquadric model, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return Eigen::Vector3d(normal(engine), normal(engine), normal(engine));
  };
  for (Superquadric& s : model.parts) {
    s.semi_axes.array() *= 1.0 + 0.05 * vector().array();
    s.center += 0.003 * vector();
    s.rotation =
        Eigen::AngleAxisd(2.0 * M_PI / 180.0 * normal(engine), vector().normalized())
            .toRotationMatrix() *
        s.rotation;
    for (double* e : {&s.epsilon1, &s.epsilon2})
      *e = std::clamp(*e + 0.1 * normal(engine), 0.05, 2.0);
  }
  return model;
}

Eigen::Matrix3Xd readPoints(const std::string& path) {
  const app::LoadedCloud loaded = app::loadCloud(path);
  Eigen::Matrix3Xd points(3, Eigen::Index(loaded.finite_points));
  Eigen::Index count = 0;
  for (const auto& p : *loaded.cloud)
    if (pcl::isXYZFinite(p))
      points.col(count++) = p.getVector3fMap().cast<double>();
  return points;
}

Eigen::Vector3d vectorOf(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Eigen::Matrix3d matrixOf(const nlohmann::json& rows) {
  Eigen::Matrix3d matrix;
  for (std::size_t r = 0; r < 3; ++r)
    matrix.row(Eigen::Index(r)) = vectorOf(rows.at(r));
  return matrix;
}

/** \brief The mesh that a truth file names, in the scene's frame. */
TriangleMesh trueMesh(const std::string& truth_path, const nlohmann::json& truth) {
  const auto folder = std::filesystem::path(truth_path).parent_path();
  TriangleMesh mesh =
      app::readMesh((folder / truth.at("mesh").get<std::string>()).string());
  const Eigen::Matrix3d rotation = matrixOf(truth.at("pose").at("rotation"));
  const Eigen::Vector3d translation = vectorOf(truth.at("pose").at("translation"));
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex = rotation * vertex + translation;
  return mesh;
}

void setTable(const nlohmann::json& plane, GraspScene& scene) {
  scene.has_table = plane.is_array() && plane.size() == 4;
  if (!scene.has_table)
    return;
  scene.table_normal = vectorOf(plane);
  scene.table_offset = plane.at(3);
}

} // namespace

int main(int argc, char** argv) {
  std::string truth_path, model, points_path, gripper_name = "wsg_50";
  GraspPlannerOptions options;
  options.count = 10;
  unsigned seed = 0;
  bool blind = false;
  return app::run(
      argc,
      argv,
      "pcl_sq_benchmark_grasp_evaluation",
      "Plans on a model and checks every grasp on the truth; one line of JSON.",
      "  ... scene/truth.json --model perturbed --seed 3\n",
      [&](CLI::App& cli) {
        cli.add_option("truth", truth_path, "truth.json: parts, table")->required();
        cli.add_option("--model", model, "true, perturbed, box or a model file")
            ->required();
        cli.add_option("--points", points_path, "Object's points (for box)");
        cli.add_option("--gripper", gripper_name)->capture_default_str();
        cli.add_option("--count", options.count)->capture_default_str();
        cli.add_option("--friction", options.friction)->capture_default_str();
        cli.add_option("--seed", seed)->capture_default_str();
        cli.add_flag(
            "--no-view", blind, "Do not tell the planner points and viewpoint");
      },
      [&] {
        const auto json = nlohmann::json::parse(app::readFile(truth_path));
        MultiSuperquadric parts;
        for (const auto& p : json.value("parts", nlohmann::json::array())) {
          Superquadric s;
          s.semi_axes = vectorOf(p.at("a"));
          s.epsilon1 = p.at("e").at(0);
          s.epsilon2 = p.at("e").at(1);
          s.center = vectorOf(p.at("t"));
          for (int k = 0; k < 9; ++k)
            s.rotation(k / 3, k % 3) = p.at("R").at(std::size_t(k));
          parts.parts.push_back(s);
        }
        const GraspTruth truth(json.contains("mesh") ? trueMesh(truth_path, json)
                                                     : parts.meshParts(48));
        GraspScene scene;
        setTable(json.value("table", nlohmann::json()), scene);
        if (!blind && !points_path.empty()) {
          scene.cloud = readPoints(points_path);
          scene.has_viewpoint = true; // at the origin of the camera's frame
        }
        GraspScene known = scene;
        MultiSuperquadric planned;
        if (model == "true")
          planned = parts;
        else if (model == "perturbed")
          planned = perturbed(parts, seed);
        else if (model == "box")
          planned = principalBox(readPoints(points_path));
        else {
          ModelFile file;
          std::string why;
          if (!fromJson(app::readFile(model), file, &why))
            throw app::Failure("'" + model + "': " + why);
          planned = file.model;
          // a robot knows no other table than the one that the fit found
          setTable(nlohmann::json::parse(app::readFile(model))
                       .value("/report/table"_json_pointer, nlohmann::json()),
                   known);
        }
        Gripper gripper;
        if (!Gripper::preset(gripper_name, gripper) || gripper.fingers != 2)
          throw app::UsageError("--gripper takes a preset with two jaws");
        const GraspPlan plan = GraspPlanner(gripper, options).plan(planned, known);
        nlohmann::ordered_json out = {
            {"truth", truth_path}, {"model", model}, {"grasps", plan.grasps.size()}};
        if (!plan.ok())
          out["failure"] = plan.failure;
        out["antipodal"] = nlohmann::json::array();
        out["free"] = nlohmann::json::array();
        out["score"] = nlohmann::json::array();
        for (const Grasp& grasp : plan.grasps) {
          out["antipodal"].push_back(truth.isAntipodal(grasp, options.friction));
          out["free"].push_back(truth.isFree(grasp, scene, gripper, options.retreat));
          out["score"].push_back(grasp.scores.total);
        }
        std::printf("%s\n", out.dump().c_str());
        return int(app::DONE);
      });
}
