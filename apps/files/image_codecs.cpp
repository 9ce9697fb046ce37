// SPDX-License-Identifier: BSD-3-Clause
#ifdef PCL_SQ_HAVE_OPENCV
#include "files/image_codecs.h"

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include <fcntl.h>
#include <unistd.h>

namespace pcl_sq::app {
namespace {

/** \brief Keeps what the decoders would print away from the user: the programs say it
 * themselves, in one sentence. */
class SilentDecoders {
public:
  SilentDecoders() : kept_(dup(STDERR_FILENO)) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0)
      dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0)
      close(nowhere);
  }
  ~SilentDecoders() {
    if (kept_ >= 0) {
      dup2(kept_, STDERR_FILENO);
      close(kept_);
    }
  }
  SilentDecoders(const SilentDecoders&) = delete;
  SilentDecoders& operator=(const SilentDecoders&) = delete;

private:
  int kept_;
};

cv::Mat decode(const std::string& bytes, int flags) {
  const SilentDecoders silent;
  try {
    const cv::Mat data(1,
                       static_cast<int>(bytes.size()),
                       CV_8U,
                       const_cast<char*>(bytes.data())); // only read
    return cv::imdecode(data, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

bool encode(const std::string& ending,
            const cv::Mat& image,
            std::vector<unsigned char>& bytes) {
  try {
    return cv::imencode(ending, image, bytes);
  } catch (const cv::Exception&) {
    return false;
  }
}

bool canWrite(const std::string& ending) {
  return cv::haveImageWriter("image" + ending);
}

} // namespace
} // namespace pcl_sq::app

const pcl_sq::app::ImageCodecs* pcl_sq_image_codecs() {
  using namespace pcl_sq::app;
  static const ImageCodecs CODECS{decode, encode, canWrite};
  return &CODECS;
}
#endif
