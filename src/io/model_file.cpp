// SPDX-License-Identifier: BSD-3-Clause
// Models and scenes by file name.
#include "pcl_sq/file_io.h"
#include "pcl_sq/model_io.h"
#include "pcl_sq/scene_io.h"

namespace pcl_sq {

namespace {

/** \param[in] kind what the file should be, "model" */
template <class File>
bool load(const std::string& path,
          const std::string& kind,
          File& file,
          std::string* why) {
  file = {};
  std::string text, reason;
  if (!readFile(path, text, why))
    return false;
  if (fromJson(text, file, &reason))
    return true;
  if (why)
    *why = "'" + path + "' is no " + kind + " file: " + reason;
  return false;
}

} // namespace

bool saveModel(const std::string& path, const ModelFile& file, std::string* why) {
  return writeFile(path, toJson(file) + "\n", why);
}

bool loadModel(const std::string& path, ModelFile& file, std::string* why) {
  return load(path, "model", file, why);
}

bool saveScene(const std::string& path, const SceneFile& file, std::string* why) {
  return writeFile(path, toJson(file) + "\n", why);
}

bool loadScene(const std::string& path, SceneFile& file, std::string* why) {
  return load(path, "scene", file, why);
}

} // namespace pcl_sq
