// SPDX-License-Identifier: BSD-3-Clause
// Models by file name.
#include "pcl_sq/file_io.h"
#include "pcl_sq/model_io.h"

namespace pcl_sq {

bool saveModel(const std::string& path, const ModelFile& file, std::string* why) {
  return writeFile(path, toJson(file) + "\n", why);
}

bool loadModel(const std::string& path, ModelFile& file, std::string* why) {
  file = {};
  std::string text, reason;
  if (!readFile(path, text, why))
    return false;
  if (fromJson(text, file, &reason))
    return true;
  if (why)
    *why = "'" + path + "' is no model file: " + reason;
  return false;
}

} // namespace pcl_sq
