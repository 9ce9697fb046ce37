// SPDX-License-Identifier: BSD-3-Clause
// Model files: refused with a reason, or a model whose figures are finite and whose own
// file is read again.
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/model_io.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_sq;
  const std::string text(reinterpret_cast<const char*>(data), size);
  ModelFile file, again;
  std::string why;
  if (!fromJson(text, file, &why, TaperedParts::READ)) {
    if (why.empty())
      std::abort();
    return 0;
  }
  for (const Superquadric& s : file.model.parts)
    if (!std::isfinite(s.volume()) || !s.inertia().allFinite() || !(s.volume() > 0.0))
      std::abort();
  if (file.model.size() < 4 && !massProperties(file.model, 8).inertia.allFinite())
    std::abort();
  const std::string written = toJson(file);
  if (!fromJson(written, again, &why, TaperedParts::READ) ||
      again.model.size() != file.model.size())
    std::abort();
  return 0;
}
