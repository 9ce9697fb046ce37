// SPDX-License-Identifier: BSD-3-Clause
#ifdef PCL_SQ_HAVE_OPENCV
#include "files/image_file.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/image_codecs.h"
#include "files/image_header.h"

#ifdef PCL_SQ_PLUG_INS
#include "util/plug_in.h"
#endif

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace pcl_sq::app {

const ImageCodecs& imageCodecs() {
#ifdef PCL_SQ_PLUG_INS
  std::string why;
  auto* codecs = detail::functionOf<const ImageCodecs*()>(
      "pcl_sq_images.so", "pcl_sq_image_codecs", &why);
  if (codecs == nullptr)
    throw Failure(why + ".");
  return *codecs();
#else
  return *pcl_sq_image_codecs();
#endif
}

cv::Mat readImage(const std::string& path, int flags) {
  return decodeImage(readFile(path), path, flags);
}

cv::Mat decodeImage(const std::string& bytes, const std::string& name, int flags) {
  // sixteen times what stereo cameras have; a picture of it still fits into memory
  constexpr std::uint64_t MOST_PIXELS = 1U << 26U;
  constexpr std::uint64_t LONGEST_SIDE = 1U << 15U;
  const auto refuse = [&name](const std::string& what) -> void {
    throw Failure("the image '" + name + "' " + what);
  };
  ImageHeader header;
  std::string why;
  if (!readImageHeader(bytes, header, &why))
    refuse(why + "; check the file or write it again as PNG.");
  if (header.width == 0 || header.height == 0 || header.width > LONGEST_SIDE ||
      header.height > LONGEST_SIDE || header.width * header.height > MOST_PIXELS)
    refuse("says it has " + std::to_string(header.width) + " x " +
           std::to_string(header.height) +
           " px; 1 x 1 to 64 megapixels can be read: make it smaller.");
  cv::Mat image = imageCodecs().decode(bytes, flags);
  if (image.empty())
    refuse(
        "cannot be decoded; it is damaged, or of a rare kind: write it again as PNG.");
  return image;
}

cv::Mat readNumbers(const std::string& path) {
  const std::string bytes = readFile(path);
  cv::Mat image = decodeImage(bytes, path, cv::IMREAD_UNCHANGED);
  const auto palette = paletteOf(bytes);
  if (palette.empty() || image.channels() < 3 || image.depth() != CV_8U)
    return image;
  std::map<std::array<std::uint8_t, 3>, std::uint8_t> number;
  for (std::size_t k = 0; k < palette.size(); ++k)
    number.emplace(palette[k], static_cast<std::uint8_t>(k));
  cv::Mat numbers(image.size(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const std::uint8_t* bgr = image.ptr(y, x);
      const auto found = number.find({bgr[2], bgr[1], bgr[0]});
      if (found != number.end())
        numbers.at<std::uint8_t>(y, x) = found->second;
    }
  return numbers;
}

namespace {

/** \brief How many kinds of brightness an image has but black, at most two, and the
 * share of its pixels that are neither dark nor bright. */
struct Shades {
  int kinds = 0;
  double between = 0.0;
};

Shades shadesOf(const cv::Mat& image, double brightest) {
  Shades shades;
  double first = 0.0;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double value = image.at<float>(y, x);
      if (value > 0.0 && (shades.kinds == 0 || (shades.kinds == 1 && value != first))) {
        first = value;
        ++shades.kinds;
      }
      shades.between += value > 0.1 * brightest && value < 0.9 * brightest ? 1.0 : 0.0;
    }
  shades.between /= double(image.total());
  return shades;
}

/** \brief Whether the pixels are numbers that have colours to be told apart by. */
bool hasColors(const std::string& bytes) {
  const auto palette = paletteOf(bytes);
  return std::any_of(palette.begin(), palette.end(), [](const auto& c) {
    return c[0] != c[1] || c[1] != c[2];
  });
}

} // namespace

cv::Mat readMask(const std::string& path) {
  // a mask's soft edges and the noise of JPEG are few pixels
  constexpr double MOST_BETWEEN = 0.25;
  const std::string bytes = readFile(path);
  cv::Mat image = decodeImage(bytes, path, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
  const double half_bright = image.depth() == CV_16U ? 32768.0 : 128.0;
  image.convertTo(image, CV_32F);
  double brightest = 0.0;
  cv::minMaxLoc(image, nullptr, &brightest);
  const Shades shades = shadesOf(image, brightest);
  // too dark for a picture, or coloured by number: several things
  if (shades.kinds > 1 && (brightest < half_bright || hasColors(bytes)))
    throw Failure("'" + path +
                  "' holds labels of several things; give a mask of one object, its "
                  "pixels white (or 1) and the others black.");
  if (shades.between > MOST_BETWEEN)
    throw Failure("'" + path +
                  "' is a picture and no mask: give the object's pixels in white and "
                  "the others in black.");
  return image > 0.5 * std::max(brightest, 1.0);
}

void claimImage(const std::string& option, const std::string& path) {
  if (path.empty())
    return;
  const std::string format = formatOf(path, ".png");
  if (format.size() < 2 || !imageCodecs().canWrite(format))
    throw UsageError(option + ": '" + path +
                     "' does not end like a picture; use .png.");
  claimOutput(option, path);
}

void writeImage(const std::string& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!imageCodecs().encode(formatOf(path, ".png"), image, bytes))
    throw Failure("'" + path +
                  "' is of a format that cannot hold this picture; use "
                  ".png.");
  writeOutput(path, std::string(bytes.begin(), bytes.end()));
}

} // namespace pcl_sq::app
#endif
