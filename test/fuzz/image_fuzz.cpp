// SPDX-License-Identifier: BSD-3-Clause
// Images: refused, or decoded to what their head says. Large ones are left to the
// decoder's own tests: here they would only cost memory.
#include "command_line/app.h"
#include "files/image_file.h"
#include "files/image_header.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_sq;
  constexpr std::uint64_t LARGE = 1U << 18U;
  constexpr int AS_IT_IS = 2 | 4; // cv::IMREAD_ANYDEPTH, cv::IMREAD_ANYCOLOR
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  app::ImageHeader header;
  std::string why;
  if (!app::readImageHeader(bytes, header, &why)) {
    if (why.empty())
      std::abort();
    return 0;
  }
  if (header.width > 65535 || header.height > 65535 ||
      header.width * header.height > LARGE)
    return 0;
  try {
    const cv::Mat image = app::decodeImage(bytes, "image", AS_IT_IS);
    if (image.empty())
      std::abort();
  } catch (const app::Failure&) {
    // refused
  }
  return 0;
}
