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

cv::Mat readMask(const std::string& path) {
  const cv::Mat image = readImage(path, cv::IMREAD_GRAYSCALE);
  double brightest = 0.0;
  cv::minMaxLoc(image, nullptr, &brightest);
  if (brightest > 1.0 && brightest < 128.0) // too dark for a picture: numbers of things
    throw Failure(
        "'" + path + "' holds values up to " + std::to_string(int(brightest)) +
        " only, as labels do; give a mask of one object, its pixels white (or "
        "1) and the others black.");
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
