// SPDX-License-Identifier: BSD-3-Clause
#ifdef PCL_SQ_HAVE_OPENCV
#include "image_file.h"

#include "app.h"
#include "files.h"

#include <opencv2/imgcodecs.hpp>

#include <vector>

namespace pcl_sq::app {

void claimImage(const std::string& option, const std::string& path) {
  if (path.empty())
    return;
  const std::string format = formatOf(path, ".png");
  if (format.size() < 2 || !cv::haveImageWriter("image" + format))
    throw UsageError(option + ": '" + path +
                     "' does not end like a picture; use .png.");
  claimOutput(option, path);
}

void writeImage(const std::string& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  bool done = false;
  try {
    done = cv::imencode(formatOf(path, ".png"), image, bytes);
  } catch (const cv::Exception&) { // the sentence below tells more
  }
  if (!done)
    throw Failure("'" + path + "' is of a format that cannot hold this picture; use "
                               ".png.");
  writeOutput(path, std::string(bytes.begin(), bytes.end()));
}

} // namespace pcl_sq::app
#endif
