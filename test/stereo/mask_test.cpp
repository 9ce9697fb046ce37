// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"
#include "files/image_file.h"

#include "folder.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

using namespace pcl_sq;
using pcl_sq::test::Folder;

namespace {

/** \brief A gray image of 2 x 2 pixels as PGM. */
std::string pixels(const std::string& values) {
  return "P5\n2 2\n255\n" + values;
}

} // namespace

TEST(Mask, OnesAreAsGoodAsWhite) {
  const Folder folder;
  for (const char object : {'\x01', '\xff', '\xc8'}) {
    const cv::Mat mask = app::readMask(
        folder.write("mask.pgm", pixels(std::string{'\0', object, object, '\0'})));
    EXPECT_EQ(cv::countNonZero(mask), 2);
    EXPECT_EQ(mask.at<unsigned char>(0, 0), 0);
    EXPECT_EQ(mask.at<unsigned char>(0, 1), 255);
  }
}

TEST(Mask, LabelsOfSeveralThingsAreRefusedWithTheCure) {
  const Folder folder;
  const std::string path =
      folder.write("labels.pgm", pixels(std::string{'\0', '\x01', '\x02', '\x03'}));
  try {
    app::readMask(path);
    FAIL() << "labels were read as a mask";
  } catch (const app::Failure& e) {
    EXPECT_NE(std::string(e.what()).find("one object"), std::string::npos);
  }
}

TEST(Mask, NothingMarkedIsNothing) {
  const Folder folder;
  const std::string black = folder.write("mask.pgm", pixels(std::string(4, '\0')));
  EXPECT_EQ(cv::countNonZero(app::readMask(black)), 0);
}
