// SPDX-License-Identifier: BSD-3-Clause
// Calibration files, as one text or as two: refused, or a camera that is valid.
#include "pcl_sq/stereo/stereo_calibration.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_sq;
  std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<CalibrationText> texts = {{"first", text}};
  // a line of '@'s parts two files
  if (const std::size_t cut = text.find("\n@@@@\n"); cut != std::string::npos)
    texts = {{"first", text.substr(0, cut)}, {"second", text.substr(cut + 6)}};
  try {
    const auto c = StereoCalibration::fromText(texts, 1.0, 672, 376);
    const StereoIntrinsics& k = c.getIntrinsics();
    if (k.fx != 0.0 && !k.isValid()) // 0: known with the images
      std::abort();
  } catch (const Exception& e) {
    if (std::string(e.what()).size() < 20)
      std::abort();
  }
  return 0;
}
