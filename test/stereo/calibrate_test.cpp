// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_calibrate on real chessboards, its file used; skipped without the data.
#include "chessboard.h"
#include "program.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A board of 9 x 6 inner corners as a camera at \a place sees it, squares of a
 * length of 1; the board is turned a little for each \a pose. */
cv::Mat seenBoard(int pose, double place) {
  constexpr int PIXELS = 40; // of a square
  cv::Mat board(9 * PIXELS, 12 * PIXELS, CV_8U, cv::Scalar(255));
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 10; ++u)
      if ((u + v) % 2 == 0)
        board(cv::Rect((u + 1) * PIXELS, (v + 1) * PIXELS, PIXELS, PIXELS)).setTo(0);
  const cv::Mat camera = (cv::Mat_<double>(3, 3) << 400, 0, 200, 0, 400, 150, 0, 0, 1);
  cv::Mat turn;
  cv::Rodrigues(cv::Vec3d(0.25 * (pose % 3 - 1), 0.3 * (pose % 2) - 0.15, 0.05 * pose),
                turn);
  cv::Mat plane = cv::Mat::eye(3, 3, CV_64F); // pixels of the board to the camera
  turn.col(0).copyTo(plane.col(0));
  turn.col(1).copyTo(plane.col(1));
  const cv::Mat middle = (cv::Mat_<double>(3, 1) << -place, 0.0, 16.0 + pose % 4);
  plane.col(2) = middle - turn * (cv::Mat_<double>(3, 1) << 6.0, 4.5, 0.0);
  const cv::Mat squares =
      (cv::Mat_<double>(3, 3) << 1.0 / PIXELS, 0, 0, 0, 1.0 / PIXELS, 0, 0, 0, 1);
  cv::Mat image;
  cv::warpPerspective(board,
                      image,
                      camera * plane * squares,
                      {400, 300},
                      cv::INTER_AREA,
                      cv::BORDER_CONSTANT,
                      cv::Scalar(255));
  return image;
}

} // namespace

TEST(CalibrateProgram, SquaresInMillimetresAreRefusedWithTheBaselineTheyWouldMake) {
  const Folder folder;
  std::vector<std::string> images;
  for (const double place : {0.0, 3.0})
    for (int pose = 0; pose < 6; ++pose) {
      images.push_back(folder / (std::to_string(images.size()) + ".png"));
      cv::imwrite(images.back(), seenBoard(pose, place));
    }
  const std::string file = folder / "calib.yml";
  const auto calibrate = [&](const std::string& square) {
    std::vector<std::string> arguments = images;
    for (const std::string& word : {std::string("--square"), square, std::string("-o")})
      arguments.push_back(word);
    arguments.push_back(file);
    return runProgram("pcl_sq_calibrate", arguments);
  };
  const ProgramRun slip = calibrate("25");
  EXPECT_EQ(slip.code, 1);
  EXPECT_NE(slip.err.find("m with --square 25, which is not plausible"),
            std::string::npos)
      << slip.err;
  EXPECT_NE(slip.err.find("0.025 for 25 mm"), std::string::npos) << slip.err;
  EXPECT_FALSE(std::filesystem::exists(file));
  const ProgramRun run = calibrate("0.025");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(StereoCalibration::load(file).getIntrinsics().baseline, 0.075, 0.002);
}

TEST(CalibrateProgram, ItsFileBringsRowsTogetherAndKeepsLengths) {
  const std::string folder = PCL_SQ_TEST_DATA "/stereo/opencv_calib/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  const Folder out;
  const std::string file = out / "calib.yml";
  const ProgramRun run = runProgram("pcl_sq_calibrate",
                                    {"--list",
                                     folder + "stereo_calib.xml",
                                     "--board",
                                     "9x6",
                                     "--square",
                                     "1",
                                     "-o",
                                     file});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("reprojection rms"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("epipolar error"), std::string::npos) << run.out;
  {
    const cv::FileStorage storage(file, cv::FileStorage::READ);
    EXPECT_LE(static_cast<double>(storage["rms_px"]), 0.3);
    EXPECT_LE(static_cast<double>(storage["epipolar_error_px"]), 0.25);
  }
  StereoCalibration calibration = StereoCalibration::load(file);
  // what comes with the pictures says 3.343 squares
  EXPECT_NEAR(calibration.getIntrinsics().baseline, 3.343, 0.03);
  expectGoodChessboards(folder, calibration);
}
