// SPDX-License-Identifier: BSD-3-Clause
// Gripper files: refused, or a gripper that is valid.
#include "command_line/app.h"
#include "files/gripper_file.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_sq;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    std::string missing;
    if (!app::gripperFromToml(text, "hand.toml", missing).isValid())
      std::abort();
  } catch (const app::UsageError&) {
    // refused
  }
  return 0;
}
