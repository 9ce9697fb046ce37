// SPDX-License-Identifier: BSD-3-Clause
// One superquadric from bare points: samples a box, adds noise, fits all eleven
// parameters.
#include <pcl_sq/fit_superquadric.h>
#include <pcl_sq/triangle_mesh.h>

#include <iostream>
#include <random>

int main() {
  pcl_sq::Superquadric box;
  box.center = {0.1, 0.0, 0.8};
  box.semi_axes = {0.03, 0.05, 0.10};
  box.epsilon1 = box.epsilon2 = 0.2;

  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.0005);
  const auto samples = pcl_sq::sampleUniform(box, 2000);
  Eigen::Matrix3Xd points(3, samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    points.col(i) =
        samples[i] + Eigen::Vector3d(noise(engine), noise(engine), noise(engine));

  const pcl_sq::FitSummary fit = pcl_sq::fitSuperquadric(points);
  if (!fit.ok()) {
    std::cerr << "no model: " << toString(fit.termination) << '\n';
    return 1;
  }
  std::cout << "semi-axes [m]  " << fit.model.semi_axes.transpose() << '\n'
            << "exponents      " << fit.model.epsilon1 << ' ' << fit.model.epsilon2
            << '\n'
            << "centre [m]     " << fit.model.center.transpose() << '\n'
            << "rms [mm]       " << 1e3 * fit.rms_distance << '\n';
  return 0;
}
