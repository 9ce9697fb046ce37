// SPDX-License-Identifier: BSD-3-Clause
// One superquadric from bare points: 1000 noisy points of a known one in, its eleven
// parameters out, beside the true ones.
#include <pcl_sq/fit_superquadric.h>
#include <pcl_sq/triangle_mesh.h>

#include <iostream>
#include <random>

namespace {

void print(const char* name, const pcl_sq::Superquadric& superquadric) {
  std::cout << name << ": centre " << superquadric.center.transpose()
            << " m, semi-axes " << superquadric.semi_axes.transpose()
            << " m, exponents " << superquadric.epsilon1 << ' ' << superquadric.epsilon2
            << '\n';
}

} // namespace

int main() {
  pcl_sq::Superquadric truth; // a can, 66 mm wide and 115 mm high, tilted
  truth.center = Eigen::Vector3d(0.1, 0.2, 0.8);
  truth.rotation =
      Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  truth.semi_axes = Eigen::Vector3d(0.033, 0.033, 0.0575);
  truth.epsilon1 = 0.1;

  const std::vector<Eigen::Vector3d> samples = pcl_sq::sampleUniform(truth, 1000);
  Eigen::Matrix3Xd points(3, samples.size());
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.0005);
  for (std::size_t i = 0; i < samples.size(); ++i)
    points.col(i) = samples[i] + Eigen::Vector3d::NullaryExpr(
                                     [&](Eigen::Index) { return noise(generator); });

  const pcl_sq::FitSummary summary = pcl_sq::fitSuperquadric(points);
  if (!summary.ok()) {
    std::cerr << "No fit: " << toString(summary.termination) << '\n';
    return 1;
  }
  print("true  ", truth);
  print("fitted", summary.model);
  std::cout << "rms distance " << 1000.0 * summary.rms_distance
            << " mm, estimated noise " << 1000.0 * summary.sigma << " mm\n";
  return 0;
}
