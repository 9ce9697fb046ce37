// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a mesh, of any extension.
#include "check_readers.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const char* const extensions[] = {".ply", ".obj", ".stl"};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string complaint =
      pcl_sq::test::complaintOfMesh(bytes, extensions[data[0] % 3]);
  if (!complaint.empty()) {
    std::fprintf(stderr, "%s\n", complaint.c_str());
    std::abort();
  }
  return 0;
}
