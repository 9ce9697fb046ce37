// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/input_images.h"

#include "command_line/app.h"
#include "files/image_file.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_sq::app {
namespace {

/** \brief Appends the finite values of an image. */
void collect(const cv::Mat& image, std::vector<float>& values) {
  cv::Mat floats;
  image.convertTo(floats, CV_32F);
  for (int v = 0; v < floats.rows; ++v) {
    const auto* row = floats.ptr<float>(v);
    std::copy_if(row,
                 row + static_cast<std::ptrdiff_t>(floats.cols) * floats.channels(),
                 std::back_inserter(values),
                 [](float x) { return std::isfinite(x); });
  }
}

float quantile(std::vector<float>& values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string brief(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

/** \brief Scales both images alike, so that what is the same stays the same. */
void toEightBits(cv::Mat& left, cv::Mat& right, std::vector<std::string>& notes) {
  // defective pixels of a sensor, fewer than one in a thousand, do not set the range
  constexpr double DEFECTIVE = 1e-3;
  std::vector<float> values;
  collect(left, values);
  collect(right, values);
  if (values.empty())
    throw Failure("the images hold no finite value; give images of the scene.");
  const double low = quantile(values, DEFECTIVE),
               high = quantile(values, 1.0 - DEFECTIVE);
  if (!(high > low))
    throw Failure("the images show one brightness alone; give images of the scene.");
  const double scale = 255.0 / (high - low);
  for (cv::Mat* image : {&left, &right}) {
    if (image->depth() == CV_32F)
      cv::patchNaNs(*image, low);
    image->convertTo(*image, CV_8U, scale, -low * scale);
  }
  notes.push_back("the images have more than 8 bits; their values from " + brief(low) +
                  " to " + brief(high) + " were scaled to 0 to 255");
}

} // namespace

void readPair(const std::string& left_path,
              const std::string& right_path,
              cv::Mat& left,
              cv::Mat& right,
              std::vector<std::string>& notes) {
  constexpr int AS_IT_IS = cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR;
  left = readImage(left_path, AS_IT_IS);
  right = readImage(right_path, AS_IT_IS);
  suitMatcher(left_path, right_path, left, right, notes);
}

void suitMatcher(const std::string& left_path,
                 const std::string& right_path,
                 cv::Mat& left,
                 cv::Mat& right,
                 std::vector<std::string>& notes) {
  for (cv::Mat* image : {&left, &right})
    if (image->depth() > CV_16U)
      image->convertTo(*image, CV_32F);
  if (left.depth() != right.depth())
    throw Failure("'" + left_path + "' and '" + right_path +
                  "' differ in bits per pixel; give two images of one camera pair.");
  if (left.depth() != CV_8U)
    toEightBits(left, right, notes);
}

cv::Mat
readDepth(const std::string& path, double& scale, std::vector<std::string>& notes) {
  return checkedDepth(
      readImage(path, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR), path, scale, notes);
}

cv::Mat checkedDepth(cv::Mat depth,
                     const std::string& path,
                     double& scale,
                     std::vector<std::string>& notes) {
  if (depth.channels() != 1)
    throw Failure("the depth image '" + path +
                  "' has colours: a picture of depths holds no depths; save the "
                  "camera's raw depth as a 16-bit PNG.");
  const bool given = scale > 0.0;
  if (depth.depth() == CV_8U) {
    if (!given)
      throw Failure(
          "the depth image '" + path +
          "' has 8 bits, too few for millimetres; save the camera's raw depth "
          "as a 16-bit PNG, or tell the length of one step with "
          "--depth-scale.");
    depth.convertTo(depth, CV_16U);
  }
  const bool integers = depth.depth() == CV_16U;
  if (!integers)
    depth.convertTo(depth, CV_32F);
  if (!given)
    scale = integers ? 0.001 : 1.0;
  std::vector<float> values;
  collect(depth, values);
  values.erase(
      std::remove_if(values.begin(), values.end(), [](float x) { return x <= 0; }),
      values.end());
  if (values.empty())
    throw Failure("the depth image '" + path + "' holds no depth; give another one.");
  const double median = scale * quantile(values, 0.5);
  // Specified ranges of depth cameras: RealSense D405 from 0.07 m, D455 to 6 m, Azure
  // Kinect to 5.5 m, Kinect 2 to 4.5 m; with other optics up to 20 m.
  const double farthest = given ? 20.0 : 6.0;
  const bool doubtful = median < 0.07 || median > farthest;
  if (!given || doubtful)
    notes.push_back("one step of the depth image is " +
                    std::string(given ? "given as " : "taken as ") +
                    brief(1e3 * scale) + " mm, so its median depth is " +
                    brief(median) + " m" +
                    (doubtful ? ", which no depth camera measures well" : "") +
                    "; --depth-scale sets the length of a step in metres");
  return depth;
}

} // namespace pcl_sq::app
