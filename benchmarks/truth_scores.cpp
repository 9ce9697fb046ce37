// SPDX-License-Identifier: BSD-3-Clause
#include "truth_scores.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>

namespace pcl_sq::benchmark {

namespace {

constexpr int VOLUME_SAMPLES = 40000;
constexpr std::size_t SURFACE_SAMPLES = 1500;

Superquadric readPart(const nlohmann::json& json) {
  Superquadric s;
  for (int i = 0; i < 3; ++i) {
    s.semi_axes[i] = json["a"][i];
    s.center[i] = json["t"][i];
    for (int k = 0; k < 3; ++k)
      s.rotation(i, k) = json["R"][3 * i + k];
  }
  s.epsilon1 = std::min(2.0, std::max(0.05, double(json["e"][0])));
  s.epsilon2 = std::min(2.0, std::max(0.05, double(json["e"][1])));
  if (json.contains("k")) {
    s.kx = json["k"][0];
    s.ky = json["k"][1];
  }
  return s;
}

double meanDistance(const MultiSuperquadric& from, const MultiSuperquadric& to) {
  double sum = 0.0, n = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k)
    for (const Eigen::Vector3d& p : sampleUniform(from.parts[k], SURFACE_SAMPLES, 7)) {
      bool inner = false;
      for (std::size_t j = 0; j < from.size() && !inner; ++j)
        inner = j != k && from.parts[j].gauge(p) < 0.999;
      if (inner)
        continue;
      double d = 1e300;
      for (const Superquadric& s : to.parts)
        d = std::min(d, std::abs(s.footPointDistance(p)));
      sum += d;
      n += 1.0;
    }
  return n > 0.0 ? sum / n : 1.0;
}

} // namespace

Truth readTruth(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error(path + " cannot be read");
  const nlohmann::json json = nlohmann::json::parse(file);
  Truth t;
  t.name = json.value("name", "single");
  if (json.contains("parts"))
    for (const auto& part : json["parts"])
      t.model.parts.push_back(readPart(part));
  else
    t.model.parts.push_back(readPart(json));
  if (json.contains("cam")) {
    t.has_camera_center = true;
    for (int k = 0; k < 3; ++k)
      t.camera_center[k] = json["cam"][k];
  }
  if (json.contains("camera")) {
    t.f = json["camera"]["f"];
    t.cx = json["camera"]["cx"];
    t.cy = json["camera"]["cy"];
  }
  return t;
}

Scores score(const MultiSuperquadric& truth, const MultiSuperquadric& model) {
  Scores s;
  if (model.empty()) {
    s.surface = 1.0;
    return s;
  }
  Eigen::AlignedBox3d box = truth.boundingBox();
  box.extend(model.boundingBox());
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int both = 0, any = 0;
  for (int i = 0; i < VOLUME_SAMPLES; ++i) {
    const Eigen::Vector3d p =
        box.min() + box.sizes().cwiseProduct(
                        Eigen::Vector3d(unit(engine), unit(engine), unit(engine)));
    const bool a = truth.contains(p), b = model.contains(p);
    both += a && b;
    any += a || b;
  }
  s.iou = any > 0 ? double(both) / any : 0.0;
  s.surface = 0.5 * (meanDistance(truth, model) + meanDistance(model, truth));
  return s;
}

} // namespace pcl_sq::benchmark
