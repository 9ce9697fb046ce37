// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_calibrate on real chessboards, its file used; skipped without the data.
#include "chessboard.h"
#include "program.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <filesystem>

using namespace pcl_sq;
using namespace pcl_sq::test;

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
