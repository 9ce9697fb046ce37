// SPDX-License-Identifier: BSD-3-Clause
// Real and rendered pairs with ground truth; skipped where the data are not there.
#include "chessboard.h"
#include "pcl_sq/stereo/object_segmenter.h"
#include "scene/pose_file.h"
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const std::string DATA = PCL_SQ_TEST_DATA;

struct PairCase {
  const char* name;
  double least_coverage; ///< as OpenCV's own StereoBM reached on the pair
};

class MiddleburyPairs : public ::testing::TestWithParam<PairCase> {};

} // namespace

TEST_P(MiddleburyPairs, BlockMatchingIsWithinAFifthOfAPixel) {
  const std::string folder = DATA + "/stereo/" + GetParam().name + "/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  const cv::Mat left = cv::imread(folder + "im0.png");
  const cv::Mat right = cv::imread(folder + "im1.png");
  const cv::Mat truth = readPfm(folder + "disp0.pfm");
  cv::Mat mask(truth.size(), CV_8U, cv::Scalar(255));
  if (std::filesystem::exists(folder + "mask0nocc.png"))
    mask = cv::imread(folder + "mask0nocc.png", cv::IMREAD_GRAYSCALE);
  StereoReprojector reprojector(StereoCalibration::load(folder + "calib.txt"));
  const StereoResult result = reprojector.compute(left, right);
  const DisparityError error = compareDisparity(result.disparity, truth, mask);
  EXPECT_LE(error.median, 0.2);
  EXPECT_GE(error.coverage, GetParam().least_coverage);
  EXPECT_THROW((void)reprojector.compute(right, left), Exception);
}

TEST_P(MiddleburyPairs, OcclusionsFollowFromTheLeftTruth) {
  const std::string folder = DATA + "/stereo/" + GetParam().name + "/";
  if (!std::filesystem::exists(folder + "mask0nocc.png"))
    GTEST_SKIP() << "no mask in " << folder;
  const cv::Mat mask = cv::imread(folder + "mask0nocc.png", cv::IMREAD_GRAYSCALE);
  const cv::Mat visible = visibleInRight(readPfm(folder + "disp0.pfm"));
  const int agree = cv::countNonZero((visible == 255) == (mask == 255));
  EXPECT_GE(agree, 0.97 * static_cast<double>(mask.total()));
}

// The set has neither a mask of occlusions nor doffs: disparities only. Its truth comes
// in thirds of a pixel and ours in sixteenths, so that errors are multiples of 1/48 px.
TEST(LaundryPair, BlockMatchingIsWithinAFifthOfAPixelWhereBothCamerasSee) {
  const std::string folder = DATA + "/stereo/laundry/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  const cv::Mat left = cv::imread(folder + "im0.png");
  const cv::Mat right = cv::imread(folder + "im1.png");
  const cv::Mat truth = readPfm(folder + "disp0.pfm");
  StereoIntrinsics k;
  k.fx = k.fy = 3740.0 / 3.0;
  k.cx = 0.5 * left.cols;
  k.cy = 0.5 * left.rows;
  k.baseline = 0.16;
  const StereoReprojector reprojector;
  const cv::Mat disparity = reprojector.computeDisparity(left, right, k);
  const DisparityError error =
      compareDisparity(disparity, truth, visibleInRight(truth));
  EXPECT_LE(error.median, 0.2);
  EXPECT_GE(error.coverage, 0.6);
  Segment segment;
  ObjectSegmenter segmenter;
  const CellRect bottle{290, 150, 90, 197}; // by hand, about 5 px
  ASSERT_TRUE(segmenter.segmentBox(
      left,
      {bottle.x - 8, bottle.y - 8, bottle.width + 16, bottle.height + 16},
      segment));
  EXPECT_GE(overlap(segment.rect, bottle), 0.85);
}

INSTANTIATE_TEST_SUITE_P(Data,
                         MiddleburyPairs,
                         ::testing::Values(PairCase{"adirondack", 0.72},
                                           PairCase{"recycle", 0.72},
                                           PairCase{"artl", 0.55},
                                           PairCase{"motorcycle", 0.72}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(OpenCvCalibration, RowsAgreeAndChessboardSquaresHaveTheirLength) {
  const std::string folder = DATA + "/stereo/opencv_calib/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  StereoCalibration calibration =
      StereoCalibration::load({folder + "intrinsics.yml", folder + "extrinsics.yml"});
  expectGoodChessboards(folder, calibration);
}

class RenderedPairs : public ::testing::TestWithParam<const char*> {};

TEST_P(RenderedPairs, RawPairsGiveTheObjectsDepthWithinTwoMillimetres) {
  const std::string folder = DATA + "/synthetic_stereo/" + GetParam() + "/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  StereoCalibration calibration = StereoCalibration::load(folder + "calib_raw.yml");
  StereoReprojector reprojector(calibration);
  const cv::Mat left = cv::imread(folder + "raw_left.png");
  const cv::Mat right = cv::imread(folder + "raw_right.png");
  const StereoResult result = reprojector.compute(left, right);
  // the exact depths belong to the ideal rig, whose left camera stands in the same
  // place but is turned; both are turned against the mesh
  const cv::Mat truth = readPfm(folder + "rect_disp0.pfm");
  const cv::Mat mask = cv::imread(folder + "rect_mask.png", cv::IMREAD_GRAYSCALE);
  Eigen::Matrix3d ideal, raw;
  Eigen::Vector3d t;
  app::readPose(folder + "gt.yml:T_mesh_to_rectleft", ideal, t);
  app::readPose(folder + "gt.yml:T_mesh_to_rawleft", raw, t);
  cv::Mat r1, r2, p1, p2, q, m1, d1, m2, d2, r, translation;
  cv::FileStorage file(folder + "calib_raw.yml", cv::FileStorage::READ);
  file["M1"] >> m1;
  file["D1"] >> d1;
  file["M2"] >> m2;
  file["D2"] >> d2;
  file["R"] >> r;
  file["T"] >> translation;
  cv::stereoRectify(m1,
                    d1,
                    m2,
                    d2,
                    left.size(),
                    r,
                    translation,
                    r1,
                    r2,
                    p1,
                    p2,
                    q,
                    cv::CALIB_ZERO_DISPARITY,
                    0.0);
  Eigen::Matrix3d rectify;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      rectify(i, j) = r1.at<double>(i, j);
  const Eigen::Matrix3d turn = rectify * raw * ideal.transpose();
  StereoIntrinsics k;
  k.fx = k.fy = 811.6;
  k.cx = 319.5;
  k.cy = 239.5;
  k.baseline = 0.12;
  std::vector<double> errors;
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      if (mask.at<std::uint8_t>(v, u) == 0)
        continue;
      const Eigen::Vector3d p =
          turn * k.backProject(u, v, k.depth(double(truth.at<float>(v, u))));
      const Eigen::Vector2d pixel = result.intrinsics.project(p);
      const auto x = static_cast<int>(std::lround(pixel.x()));
      const auto y = static_cast<int>(std::lround(pixel.y()));
      if (x < 0 || y < 0 || x >= truth.cols || y >= truth.rows)
        continue;
      const float z = result.cloud->at(x, y).z;
      if (std::isfinite(z))
        errors.push_back(std::abs(double(z) - p.z()));
    }
  ASSERT_GT(errors.size(), 1000u);
  EXPECT_LE(medianOf(errors), 2e-3);
}

TEST_P(RenderedPairs, ExchangedImagesAreDetectedRawAndRectified) {
  const std::string folder = DATA + "/synthetic_stereo/" + GetParam() + "/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  for (const std::string kind : {"raw", "rect"}) {
    StereoReprojector reprojector(
        StereoCalibration::load(folder + "calib_" + kind + ".yml"));
    const cv::Mat left = cv::imread(folder + kind + "_left.png");
    const cv::Mat right = cv::imread(folder + kind + "_right.png");
    std::string message;
    try {
      (void)reprojector.compute(right, left);
    } catch (const Exception& e) {
      message = e.what();
    }
    EXPECT_NE(message.find("exchange left and right"), std::string::npos)
        << kind << ": " << message;
  }
}

TEST_P(RenderedPairs, ABoxHintGivesTheExactRegion) {
  const std::string folder = DATA + "/synthetic_stereo/" + GetParam() + "/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  const cv::Mat image = cv::imread(folder + "rect_left.png");
  const cv::Mat mask = cv::imread(folder + "rect_mask.png", cv::IMREAD_GRAYSCALE) > 127;
  const CellRect roi = boundingRect(mask);
  ObjectSegmenter segmenter;
  Segment segment;
  ASSERT_TRUE(segmenter.segmentBox(
      image, {roi.x - 12, roi.y - 12, roi.width + 24, roi.height + 24}, segment));
  EXPECT_GE(overlap(segment.rect, roi), 0.9);
}

INSTANTIATE_TEST_SUITE_P(
    Data,
    RenderedPairs,
    ::testing::Values("mustard_bottle", "mug", "cracker_box", "apple"),
    [](const auto& test) { return std::string(test.param); });
