// SPDX-License-Identifier: BSD-3-Clause
// A superquadric among clutter, found by PCL's RANSAC.
#include <pcl_sq/sac_model_superquadric.h>
#include <pcl_sq/triangle_mesh.h>

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>

#include <cstdio>
#include <random>

int main() {
  // a can of 9 x 9 x 14 cm, 0.5 mm noise, and as many points elsewhere
  pcl_sq::Superquadric can;
  can.center = {0.1, -0.05, 0.8};
  can.semi_axes = {0.045, 0.045, 0.07};
  can.epsilon1 = 0.2;
  std::mt19937 engine(1);
  std::normal_distribution<float> noise(0.0F, 0.0005F);
  std::uniform_real_distribution<float> anywhere(-0.2F, 0.2F);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3d& p : pcl_sq::sampleUniform(can, 1000)) {
    cloud->push_back({float(p.x()) + noise(engine),
                      float(p.y()) + noise(engine),
                      float(p.z()) + noise(engine)});
    cloud->push_back({float(can.center.x()) + anywhere(engine),
                      float(can.center.y()) + anywhere(engine),
                      float(can.center.z()) + anywhere(engine)});
  }

  using Model = pcl_sq::SampleConsensusModelSuperquadric<pcl::PointXYZ>;
  Model::Ptr model(new Model(cloud));
  model->setRadiusLimits(0.01, 0.2); // of the semi-axes [m]
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, 0.002);
  ransac.setMaxIterations(100);
  if (!ransac.computeModel())
    return 1;
  pcl::Indices inliers;
  ransac.getInliers(inliers);

  Eigen::VectorXf coarse, fine;
  ransac.getModelCoefficients(coarse);
  model->optimizeModelCoefficients(inliers, coarse, fine);
  const auto s = pcl_sq::Superquadric::fromCoefficients(fine);
  std::printf("%zu of %zu points; semi-axes %.4f %.4f %.4f m, exponents %.2f %.2f\n",
              inliers.size(),
              cloud->size(),
              s.semi_axes[0],
              s.semi_axes[1],
              s.semi_axes[2],
              s.epsilon1,
              s.epsilon2);
  return 0;
}
