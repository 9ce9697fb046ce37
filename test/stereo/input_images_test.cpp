// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"
#include "files/image_file.h"
#include "files/image_header.h"
#include "folder.h"
#include "mutate.h"
#include "stereo/input_images.h"
#include "stereo/pipeline/texture_check.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

constexpr int AS_IT_IS = cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR;

std::string encoded(const cv::Mat& image, const std::string& ending) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, image, bytes);
  return {bytes.begin(), bytes.end()};
}

cv::Mat noise(int type, int rows = 24, int cols = 32) {
  cv::Mat image(rows, cols, type);
  cv::theRNG().state = 7;
  cv::randu(image, cv::Scalar::all(0), cv::Scalar::all(200));
  return image;
}

std::string refusalOfImage(const std::string& bytes) {
  try {
    (void)app::decodeImage(bytes, "x", AS_IT_IS);
  } catch (const app::Failure& e) {
    return e.what();
  }
  return "nothing was refused";
}

cv::Mat depthRamp(int type, double scale) {
  cv::Mat depth(24, 32, type);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const double z = (0.6 + 0.01 * v) / scale;
      if (type == CV_16U)
        depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(z);
      else
        depth.at<float>(v, u) = static_cast<float>(z);
    }
  return depth;
}

} // namespace

TEST(ImageFile, ReadsWhatItsHeadSaysInEveryFormat) {
  for (const char* ending : {".png", ".jpg", ".bmp", ".ppm", ".tiff"}) {
    const std::string bytes = encoded(noise(CV_8UC3), ending);
    app::ImageHeader header;
    std::string why;
    ASSERT_TRUE(app::readImageHeader(bytes, header, &why)) << ending << why;
    EXPECT_EQ(header.width, 32u) << ending;
    EXPECT_EQ(header.height, 24u) << ending;
    EXPECT_EQ(app::decodeImage(bytes, "x", AS_IT_IS).size(), cv::Size(32, 24));
  }
}

TEST(ImageFile, APfmIsThreeNumbersAndItsDataOrIsRefusedBeforeADecoderSeesIt) {
  const std::string data(8, '\0');
  app::ImageHeader header;
  std::string why;
  for (const char* head : {"Pf\n2 1\n-1.0\n", "Pf\n2 1\n1\n", "Pf\n2\n1 -1e0 "}) {
    EXPECT_TRUE(app::readImageHeader(head + data, header, &why)) << head << why;
    EXPECT_EQ(header.width, 2U);
    EXPECT_EQ(app::decodeImage(head + data, "x", AS_IT_IS).size(), cv::Size(2, 1));
  }
  for (const char* head : {"Pf\n2 1\n",
                           "Pf 2 1 -1\n",
                           "Pf\n2 1\n0\n",
                           "Pf\n2 1\nx\n",
                           "Pf\r\n2 1\n-1\n",
                           "Pf\n# 2 1\n2 1\n-1\n",
                           "PF\n2 1\n-1\n"}) // three times the data
    EXPECT_FALSE(app::readImageHeader(head + data, header, &why)) << head;
}

TEST(ImageFile, WhatIsNoImageOrCutOffOrHugeIsRefusedInOneSentence) {
  EXPECT_NE(refusalOfImage("").find("is empty"), std::string::npos);
  EXPECT_NE(refusalOfImage("{\"a\": 1}").find("is no PNG"), std::string::npos);
  EXPECT_NE(refusalOfImage("Pf\n30000 30000\n-1.0\n").find("ends too early"),
            std::string::npos);
  EXPECT_NE(refusalOfImage("P5\n40000000000 4\n255\n").find("64 megapixels"),
            std::string::npos);
  const std::string png = encoded(noise(CV_8UC3), ".png");
  EXPECT_NE(refusalOfImage(png.substr(0, png.size() / 2)).find("ends too early"),
            std::string::npos);
  const std::string jpg = encoded(noise(CV_8UC3), ".jpg");
  EXPECT_NE(refusalOfImage(jpg.substr(0, jpg.size() / 2)).find("ends too early"),
            std::string::npos);
}

TEST(ImageFile, WhatOpenCvWouldTakeForDicomIsRefused) {
  // its decoder ends the program at the damaged element that follows
  std::string bytes = "Pf\n6 6\n-1\n";
  bytes.resize(128, '\0');
  bytes += std::string("DICM3   OB\xff\0\n", 13);
  EXPECT_NE(refusalOfImage(bytes).find("DICOM"), std::string::npos)
      << refusalOfImage(bytes);
}

TEST(ImageFile, ChangedFilesAreRefusedOrDecodedAndNobodyElseSpeaks) {
  testing::internal::CaptureStderr();
  for (const char* ending : {".png", ".jpg", ".bmp", ".ppm", ".tiff"})
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
      Mutator mutate(seed);
      const std::string bytes = mutate(encoded(noise(CV_8UC3), ending));
      try {
        EXPECT_FALSE(app::decodeImage(bytes, "x", AS_IT_IS).empty());
      } catch (const app::Failure&) {
        // refused
      }
    }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(InputImages, DeepImagesAreScaledAlikeAndSaidSo) {
  const Folder folder;
  cv::Mat left = noise(CV_16U) * 20, right = left / 2;
  const std::string l = folder.write("l.png", encoded(left, ".png"));
  const std::string r = folder.write("r.png", encoded(right, ".png"));
  std::vector<std::string> notes;
  app::readPair(l, r, left, right, notes);
  ASSERT_EQ(left.depth(), CV_8U);
  EXPECT_NEAR(cv::mean(left)[0], 2.0 * cv::mean(right)[0], 3.0);
  EXPECT_GT(cv::mean(left)[0], 100.0);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("more than 8 bits"), std::string::npos);
}

TEST(InputImages, GreyAndTransparentImagesAreReadWithoutAWord) {
  const Folder folder;
  for (const int type : {CV_8U, CV_8UC4}) {
    const std::string file = folder.write("a.png", encoded(noise(type), ".png"));
    cv::Mat left, right;
    std::vector<std::string> notes;
    app::readPair(file, file, left, right, notes);
    EXPECT_EQ(left.depth(), CV_8U);
    EXPECT_TRUE(left.channels() == 1 || left.channels() == 3);
    EXPECT_TRUE(notes.empty());
  }
}

TEST(InputImages, TheStepOfADepthImageIsAssumedByItsKindAndDoubted) {
  const Folder folder;
  const auto read = [&](const cv::Mat& depth, double given, std::string& note) {
    const std::string ending = depth.depth() == CV_32F ? ".tiff" : ".png";
    const std::string file = folder.write("d" + ending, encoded(depth, ending));
    std::vector<std::string> notes;
    double scale = given;
    (void)app::readDepth(file, scale, notes);
    note = notes.empty() ? "" : notes[0];
    return scale;
  };
  std::string note;
  EXPECT_DOUBLE_EQ(read(depthRamp(CV_16U, 1e-3), 0.0, note), 1e-3);
  EXPECT_NE(note.find("taken as 1 mm"), std::string::npos);
  EXPECT_EQ(note.find("no depth camera"), std::string::npos);
  EXPECT_DOUBLE_EQ(read(depthRamp(CV_32F, 1.0), 0.0, note), 1.0);
  EXPECT_DOUBLE_EQ(read(depthRamp(CV_16U, 2e-4), 2e-4, note), 2e-4);
  EXPECT_EQ(note, "");
  (void)read(depthRamp(CV_16U, 1e-4), 0.0, note); // tenths of a millimetre
  EXPECT_NE(note.find("no depth camera"), std::string::npos);
  (void)read(depthRamp(CV_32F, 1e-3), 0.0, note); // floats of millimetres
  EXPECT_NE(note.find("no depth camera"), std::string::npos);
}

TEST(InputImages, PicturesOfDepthsAreRefusedAndEightBitsNeedAScale) {
  const Folder folder;
  const std::string colours = folder.write("c.png", encoded(noise(CV_8UC3), ".png"));
  const std::string bytes = folder.write("b.png", encoded(noise(CV_8U), ".png"));
  std::vector<std::string> notes;
  double none = 0.0, centimetre = 0.01;
  EXPECT_THROW((void)app::readDepth(colours, centimetre, notes), app::Failure);
  EXPECT_THROW((void)app::readDepth(bytes, none, notes), app::Failure);
  EXPECT_EQ(app::readDepth(bytes, centimetre, notes).depth(), CV_16U);
}

TEST(TextureCheck, TextureIsToldFromNoiseOfTwoCameras) {
  StereoResult stereo;
  stereo.left = noise(CV_8U, 80, 120);
  stereo.right = stereo.left.clone();
  stereo.disparity = cv::Mat::zeros(80, 120, CV_32F);
  cv::Mat mask = cv::Mat::zeros(80, 120, CV_8U);
  mask(cv::Rect(30, 20, 50, 40)).setTo(255);
  EXPECT_GT(detail::texturedShare(stereo, mask, 11).of_pixels, 0.99);
  cv::randn(stereo.left(cv::Rect(30, 20, 50, 40)), 128.0, 2.0); // a plain body
  cv::randn(stereo.right(cv::Rect(30, 20, 50, 40)), 128.0, 2.0);
  EXPECT_LT(detail::texturedShare(stereo, mask, 11).of_pixels, 0.01);
  // a label: few of the pixels, but most of those that were matched
  noise(CV_8U, 20, 20).copyTo(stereo.left(cv::Rect(35, 25, 20, 20)));
  stereo.left.copyTo(stereo.right);
  cv::randn(stereo.right(cv::Rect(56, 20, 24, 40)), 128.0, 2.0);
  stereo.disparity(cv::Rect(61, 20, 19, 40)).setTo(std::nan(""));
  const detail::TexturedShare label = detail::texturedShare(stereo, mask, 11);
  EXPECT_LT(label.of_pixels, 0.7);
  EXPECT_GT(label.of_matches, label.of_pixels + 0.2);
  stereo.disparity(cv::Rect(30, 20, 50, 40)).setTo(std::nan(""));
  EXPECT_EQ(detail::texturedShare(stereo, mask, 11).of_pixels, 0.0);
}
