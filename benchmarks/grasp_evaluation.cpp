// SPDX-License-Identifier: BSD-3-Clause
// Share of planned grasps that hold on the TRUE shape, found with other means than the
// planner's: the closing line is cast through a mesh of the truth, collisions are
// looked for with points of its surface.
#include "app.h"
#include "files.h"

#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/model_io.h"

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <random>
#include <sstream>

using namespace pcl_sq;

namespace {

struct Truth {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> samples; ///< uniform on the surface
};

struct Outcome {
  bool antipodal = false, collision_free = false;
};

constexpr std::size_t SAMPLES = 30000;

/** \brief Surface points by area, repeatable. */
void sampleSurface(Truth& truth) {
  std::vector<double> areas;
  for (const auto& t : truth.mesh.triangles)
    areas.push_back((truth.mesh.vertices[t[1]] - truth.mesh.vertices[t[0]])
                        .cross(truth.mesh.vertices[t[2]] - truth.mesh.vertices[t[0]])
                        .norm());
  std::mt19937 engine(7);
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0.0, 1.0);
  while (truth.samples.size() < SAMPLES) {
    const auto& t = truth.mesh.triangles[pick(engine)];
    double u = share(engine), v = share(engine);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d& a = truth.mesh.vertices[t[0]];
    truth.samples.push_back(a + u * (truth.mesh.vertices[t[1]] - a) +
                            v * (truth.mesh.vertices[t[2]] - a));
  }
}

/** \brief First hit of a ray with the mesh: distance and the triangle's normal, turned
 * against the ray. */
bool castRay(const TriangleMesh& mesh,
             const Eigen::Vector3d& origin,
             const Eigen::Vector3d& direction,
             double& distance,
             Eigen::Vector3d& normal) {
  distance = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    const Eigen::Vector3d p = direction.cross(ac);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-18)
      continue;
    const Eigen::Vector3d s = origin - a;
    const double u = s.dot(p) / det;
    const Eigen::Vector3d q = s.cross(ab);
    const double v = direction.dot(q) / det, at = ac.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at < 0.0 || at >= distance)
      continue;
    distance = at;
    normal = ab.cross(ac).normalized();
    if (normal.dot(direction) > 0.0)
      normal = -normal;
  }
  return std::isfinite(distance);
}

/** \brief Closes two jaws from the open position on the true surface. */
bool trulyAntipodal(const Grasp& grasp, const Truth& truth, double friction) {
  const Eigen::Vector3d y = grasp.closing();
  const double out = 0.5 * grasp.open_width;
  const Eigen::Vector3d line =
      0.5 * (grasp.contacts[0].position + grasp.contacts[1].position);
  double d[2];
  Eigen::Vector3d n[2];
  if (!castRay(truth.mesh, line + out * y, -y, d[0], n[0]) ||
      !castRay(truth.mesh, line - out * y, y, d[1], n[1]))
    return false;
  if (d[0] + d[1] >= 2.0 * out) // the jaws met nothing between them
    return false;
  const double least = 1.0 / std::sqrt(1.0 + friction * friction);
  return n[0].dot(y) >= least && n[1].dot(-y) >= least;
}

bool trulyFree(const Grasp& grasp,
               const Truth& truth,
               const GraspScene& scene,
               const Gripper& gripper,
               double retreat) {
  const std::vector<double> reach(2, 0.5 * grasp.open_width);
  for (const double back : {0.0, 0.2, 0.5, 1.0})
    for (const OrientedBox& box :
         gripper.boxes(grasp.position - back * retreat * grasp.approach(),
                       grasp.rotation,
                       reach)) {
      if (scene.has_table &&
          scene.table_offset - box.support(-scene.table_normal) < 0.0)
        return false;
      for (const Eigen::Vector3d& p : truth.samples)
        if (box.contains(p))
          return false;
    }
  return true;
}

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
  std::istringstream stream(app::readFile(path));
  std::vector<double> numbers;
  for (double x; stream >> x;)
    numbers.push_back(x);
  return Eigen::Map<Eigen::Matrix3Xd>(
      numbers.data(), 3, Eigen::Index(numbers.size() / 3));
}

TriangleMesh readOff(const std::string& path) {
  std::istringstream stream(app::readFile(path));
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  stream >> word >> vertices >> faces >> edges;
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    Eigen::Vector3d v;
    stream >> v.x() >> v.y() >> v.z();
    mesh.vertices.push_back(v);
  }
  for (std::size_t i = 0; i < faces; ++i) {
    std::array<std::uint32_t, 3> t;
    std::size_t count = 0;
    stream >> count >> t[0] >> t[1] >> t[2];
    mesh.triangles.push_back(t);
  }
  if (!stream || word != "OFF")
    throw app::Failure("'" + path + "' is no OFF file of triangles.");
  return mesh;
}

Eigen::Vector3d vectorOf(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

} // namespace

int main(int argc, char** argv) {
  std::string truth_path, model, mesh_path, points_path, gripper_name = "wsg_50";
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
        cli.add_option("--mesh", mesh_path, "True surface as OFF instead of the parts");
        cli.add_option("--points", points_path, "Object's points (for box), text");
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
        Truth truth;
        truth.mesh = mesh_path.empty() ? parts.meshParts(48) : readOff(mesh_path);
        sampleSurface(truth);
        GraspScene scene;
        scene.has_table = json.contains("table");
        if (scene.has_table) {
          scene.table_normal = vectorOf(json.at("table"));
          scene.table_offset = json.at("table").at(3);
        }
        if (!blind && !points_path.empty()) {
          scene.cloud = readPoints(points_path);
          scene.has_viewpoint = true; // at the origin of the camera's frame
        }
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
        }
        Gripper gripper;
        if (!Gripper::preset(gripper_name, gripper) || gripper.fingers != 2)
          throw app::UsageError("--gripper takes a preset with two jaws");
        const GraspPlan plan = GraspPlanner(gripper, options).plan(planned, scene);
        nlohmann::ordered_json out = {
            {"truth", truth_path}, {"model", model}, {"grasps", plan.grasps.size()}};
        if (!plan.ok())
          out["failure"] = plan.failure;
        out["antipodal"] = nlohmann::json::array();
        out["free"] = nlohmann::json::array();
        out["score"] = nlohmann::json::array();
        for (const Grasp& grasp : plan.grasps) {
          out["antipodal"].push_back(trulyAntipodal(grasp, truth, options.friction));
          out["free"].push_back(
              trulyFree(grasp, truth, scene, gripper, options.retreat));
          out["score"].push_back(grasp.scores.total);
        }
        std::printf("%s\n", out.dump().c_str());
        return int(app::DONE);
      });
}
