// SPDX-License-Identifier: BSD-3-Clause
// pcl::SACSegmentation knows a fixed list of models, but the method that makes one is
// virtual: a subclass of eight lines adds superquadrics, and everything else of the
// segmentation (indices, threshold, probability, refinement) works as ever.
#include <pcl_sq/sac_model_superquadric.h>
#include <pcl_sq/triangle_mesh.h>

#include <pcl/point_types.h>
#include <pcl/segmentation/impl/sac_segmentation.hpp>

#include <cstdio>

namespace {

class SuperquadricSegmentation : public pcl::SACSegmentation<pcl::PointXYZ> {
protected:
  bool initSACModel(const int) override {
    using Model = pcl_sq::SampleConsensusModelSuperquadric<pcl::PointXYZ>;
    model_ = pcl::make_shared<Model>(input_, *indices_);
    if (radius_max_ < 1.0) // set by the user
      model_->setRadiusLimits(radius_min_, radius_max_);
    return true;
  }
};

} // namespace

int main() {
  pcl_sq::Superquadric box;
  box.center = {0.0, 0.1, 0.7};
  box.semi_axes = {0.11, 0.15, 0.03};
  box.epsilon1 = box.epsilon2 = 0.15;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3d& p : pcl_sq::sampleUniform(box, 1500))
    cloud->push_back({float(p.x()), float(p.y()), float(p.z())});
  for (int i = 0; i < 300; ++i) // a wall behind it
    cloud->push_back(
        {-0.3F + 0.03F * float(i % 20), -0.2F + 0.03F * float(i / 20), 1.0F});

  SuperquadricSegmentation segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.003);
  segmentation.setMaxIterations(60);
  segmentation.setOptimizeCoefficients(true);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  segmentation.segment(inliers, coefficients);
  if (inliers.indices.empty())
    return 1;
  const auto s = pcl_sq::Superquadric::fromCoefficients(coefficients.values);
  std::printf("%zu of %zu points; semi-axes %.4f %.4f %.4f m, exponents %.2f %.2f\n",
              inliers.indices.size(),
              cloud->size(),
              s.semi_axes[0],
              s.semi_axes[1],
              s.semi_axes[2],
              s.epsilon1,
              s.epsilon2);
  return 0;
}
