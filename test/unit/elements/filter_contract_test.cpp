// SPDX-License-Identifier: BSD-3-Clause
// What PCL promises of a pcl::FilterIndices, for each of ours.
#include "pcl_sq/grasp_point_filter.h"
#include "pcl_sq/roi_crop.h"

#include "clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

namespace {

/** Each case has a filter that is set up and the slow truth about it. */
struct RoiCropCase {
  using Filter = RoiCrop<pcl::PointXYZ>;
  static void setUp(Filter& filter) {
    filter.setRegion({{-0.5, -0.9, -0.2}, {0.7, 0.4, 0.9}});
  }
  static bool passes(const pcl::PointXYZ& p) {
    return p.x >= -0.5 && p.x <= 0.7 && p.y >= -0.9 && p.y <= 0.4 && p.z >= -0.2 &&
           p.z <= 0.9;
  }
};

struct GraspPointCase {
  using Filter = GraspPointFilter<pcl::PointXYZ>;
  static void setUp(Filter& filter) {
    MultiSuperquadric unit_sphere;
    unit_sphere.parts.resize(1);
    filter.setModel(unit_sphere);
    filter.setGaugeTolerance(0.2);
  }
  static bool passes(const pcl::PointXYZ& p) {
    return std::abs(p.getVector3fMap().cast<double>().norm() - 1.0) <= 0.2;
  }
};

template <typename Case>
class FilterContract : public testing::Test {
protected:
  using Filter = typename Case::Filter;

  FilterContract() : cloud(randomCloud(500, 1)) {
    for (const std::size_t i : {4u, 9u, 77u})
      (*cloud)[i].y = NOT_A_NUMBER;
    (*cloud)[13].z = std::numeric_limits<float>::infinity();
    (*cloud)[14].x = (*cloud)[14].y = (*cloud)[14].z = 1e30f;
    cloud->is_dense = false;
    indices = someIndices(cloud->size());
    Case::setUp(filter);
    filter.setInputCloud(cloud);
  }

  static bool isFinite(const pcl::PointXYZ& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  }
  /** The finite ones of some indices that pass, or those that do not. */
  pcl::Indices expected(const pcl::Indices& from, bool passing) const {
    pcl::Indices result;
    for (const int i : from)
      if (isFinite((*cloud)[static_cast<std::size_t>(i)]) &&
          Case::passes((*cloud)[static_cast<std::size_t>(i)]) == passing)
        result.push_back(i);
    return result;
  }
  pcl::Indices all() const {
    pcl::Indices result;
    for (std::size_t i = 0; i < cloud->size(); ++i)
      result.push_back(static_cast<int>(i));
    return result;
  }

  Cloud::Ptr cloud;
  pcl::IndicesPtr indices;
  Filter filter{true};
};

using Cases = testing::Types<RoiCropCase, GraspPointCase>;
TYPED_TEST_SUITE(FilterContract, Cases);

} // namespace

TYPED_TEST(FilterContract, KeepsWhatPassesInTheOrderOfTheIndices) {
  pcl::Indices kept;
  this->filter.filter(kept);
  EXPECT_EQ(kept, this->expected(this->all(), true));
  EXPECT_FALSE(kept.empty());
  this->filter.setIndices(this->indices);
  this->filter.filter(kept);
  EXPECT_EQ(kept, this->expected(*this->indices, true));
  EXPECT_FALSE(kept.empty());
}

TYPED_TEST(FilterContract, NegativeKeepsTheOtherFinitePoints) {
  this->filter.setIndices(this->indices);
  this->filter.setNegative(true);
  pcl::Indices kept;
  this->filter.filter(kept);
  EXPECT_EQ(kept, this->expected(*this->indices, false));
  EXPECT_EQ(*this->filter.getRemovedIndices(), this->expected(*this->indices, true));
}

TYPED_TEST(FilterContract, RemovedIndicesAreTheFinitePointsThatDoNotPass) {
  this->filter.setIndices(this->indices);
  pcl::Indices kept;
  this->filter.filter(kept);
  EXPECT_EQ(*this->filter.getRemovedIndices(), this->expected(*this->indices, false));
}

TYPED_TEST(FilterContract, RemovedIndicesAreOnlyCollectedOnDemand) {
  typename TestFixture::Filter plain;
  TypeParam::setUp(plain);
  plain.setInputCloud(this->cloud);
  pcl::Indices kept;
  plain.filter(kept);
  EXPECT_TRUE(plain.getRemovedIndices()->empty());
}

TYPED_TEST(FilterContract, NaNIsInNeitherListEvenIfTheCloudClaimsToBeDense) {
  this->cloud->is_dense = true;
  pcl::Indices kept;
  for (const bool negative : {false, true}) {
    this->filter.setNegative(negative);
    this->filter.filter(kept);
    std::set<int> seen(kept.begin(), kept.end());
    seen.insert(this->filter.getRemovedIndices()->begin(),
                this->filter.getRemovedIndices()->end());
    for (const int bad : {4, 9, 77, 13})
      EXPECT_EQ(seen.count(bad), 0u);
    EXPECT_EQ(seen.size(), 496u);
  }
}

TYPED_TEST(FilterContract, RepeatedIndicesAreKeptAsOftenAsGiven) {
  pcl::IndicesPtr repeated(new pcl::Indices);
  for (int n = 0; n < 3; ++n)
    for (const int i : this->all())
      repeated->push_back(i);
  this->filter.setIndices(repeated);
  pcl::Indices kept;
  this->filter.filter(kept);
  EXPECT_EQ(kept, this->expected(*repeated, true));
}

TYPED_TEST(FilterContract, CloudOutputHasThePointsHeaderAndSensorPose) {
  this->filter.setIndices(this->indices);
  Cloud output;
  this->filter.filter(output);
  const pcl::Indices kept = this->expected(*this->indices, true);
  ASSERT_EQ(output.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    EXPECT_EQ(output[i].getVector3fMap(),
              (*this->cloud)[static_cast<std::size_t>(kept[i])].getVector3fMap());
  EXPECT_EQ(output.width, output.size());
  EXPECT_EQ(output.height, 1u);
  EXPECT_EQ(output.header.frame_id, "camera");
  EXPECT_EQ(output.header.stamp, 1234u);
  EXPECT_EQ(output.sensor_origin_, this->cloud->sensor_origin_);
  EXPECT_EQ(output.sensor_orientation_.coeffs(),
            this->cloud->sensor_orientation_.coeffs());
}

TYPED_TEST(FilterContract, KeepOrganizedReplacesWhatIsRemoved) {
  this->cloud->width = 25;
  this->cloud->height = 20;
  this->filter.setKeepOrganized(true);
  for (const float value : {NOT_A_NUMBER, -7.0f}) {
    this->filter.setUserFilterValue(value);
    Cloud output;
    this->filter.filter(output);
    ASSERT_EQ(output.size(), this->cloud->size());
    EXPECT_EQ(output.width, 25u);
    EXPECT_EQ(output.height, 20u);
    EXPECT_FALSE(output.is_dense);
    for (std::size_t i = 0; i < output.size(); ++i) {
      const pcl::PointXYZ& before = (*this->cloud)[i];
      if (!this->isFinite(before))
        EXPECT_FALSE(this->isFinite(output[i]));
      else if (TypeParam::passes(before))
        EXPECT_EQ(output[i].getVector3fMap(), before.getVector3fMap());
      else if (std::isnan(value))
        EXPECT_TRUE(std::isnan(output[i].x));
      else
        EXPECT_EQ(output[i].x, value);
    }
  }
}

TYPED_TEST(FilterContract, OutputMayBeTheInput) {
  const std::size_t kept = this->expected(this->all(), true).size();
  this->filter.filter(*this->cloud);
  EXPECT_EQ(this->cloud->size(), kept);
  EXPECT_EQ(this->cloud->header.frame_id, "camera");
}

TYPED_TEST(FilterContract, EmptyCloudsAndCloudsOfNaNGiveNothing) {
  Cloud::Ptr bad(new Cloud);
  for (const std::size_t count : {0u, 1u, 100u}) {
    bad->assign(count, pcl::PointXYZ(NOT_A_NUMBER, 0, 0));
    this->filter.setInputCloud(bad);
    Cloud output = *this->cloud;
    this->filter.filter(output);
    EXPECT_TRUE(output.empty());
    EXPECT_TRUE(this->filter.getRemovedIndices()->empty());
  }
}
