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

/** \brief A PNG of 2 x 2 numbers, 0 1 above and below \a second and 1, to which a
 * palette gives black, red and green. */
std::string numbered(bool three) {
  const std::string head =
      "89504e470d0a1a0a0000000d49484452000000020000000208030000004568fd1600000009504c54"
      "45000000800000008000a65065530000000e49444154789c";
  const std::string hex = head +
                          (three ? "6360606460620400000f00052bdc644f"
                                 : "6360606460600400000b00035229788f") +
                          "0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

void expectRefused(const std::string& path, const std::string& word) {
  try {
    app::readMask(path);
    FAIL() << path << " was read as a mask";
  } catch (const app::Failure& e) {
    EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
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
  expectRefused(path, "one object");
  expectRefused(folder.write("labels.png", numbered(true)), "one object");
  const std::string wide{'\0', '\0', '\1', '\0', '\2', '\0', '\3', '\0'};
  expectRefused(folder.write("wide.pgm", "P5\n2 2\n65535\n" + wide), "one object");
}

TEST(Mask, OneThingsDarkNumberOrColorIsAMask) {
  const Folder folder;
  for (const std::string& path :
       {folder.write("mask.pgm", pixels(std::string{'\0', '\x26', '\0', '\x26'})),
        folder.write("mask.png", numbered(false)),
        folder.write(
            "wide.pgm",
            "P5\n2 2\n65535\n" +
                std::string{'\0', '\0', '\0', '\1', '\0', '\0', '\0', '\1'})}) {
    const cv::Mat mask = app::readMask(path);
    EXPECT_EQ(cv::countNonZero(mask), 2) << path;
    EXPECT_EQ(cv::countNonZero(mask.col(1)), 2) << path;
  }
}

TEST(Mask, APictureIsNone) {
  const Folder folder;
  expectRefused(
      folder.write("photo.pgm", pixels(std::string{'\x28', '\x50', '\x78', '\xc8'})),
      "is a picture");
}

TEST(Labels, AreTheNumbersAndNotTheirColors) {
  const Folder folder;
  const cv::Mat numbers = app::readNumbers(folder.write("labels.png", numbered(true)));
  ASSERT_EQ(numbers.type(), CV_8U);
  EXPECT_EQ(cv::countNonZero(numbers != (cv::Mat_<unsigned char>(2, 2) << 0, 1, 2, 1)),
            0);
}

TEST(Mask, NothingMarkedIsNothing) {
  const Folder folder;
  const std::string black = folder.write("mask.pgm", pixels(std::string(4, '\0')));
  EXPECT_EQ(cv::countNonZero(app::readMask(black)), 0);
}
