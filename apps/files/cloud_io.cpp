// SPDX-License-Identifier: BSD-3-Clause
#include "files/cloud_io.h"

#include "command_line/app.h"
#include "files/files.h"
#include "input/shape.h"
#include "report/text.h"

namespace pcl_sq::app {

Shape loadShape(const std::string& path) {
  const std::string bytes = readFile(path);
  try {
    return readShape(bytes, extensionOf(path));
  } catch (const Failure& failure) {
    throw Failure("cannot read '" + printable(path) + "': " + failure.what() + ".");
  }
}

LoadedCloud readCloud(const std::string& path, const CloudOptions& options) {
  Shape shape = loadShape(path);
  try {
    return makeCloud(std::move(shape), options);
  } catch (const Failure& failure) {
    throw Failure("cannot read '" + printable(path) + "': " + failure.what() + ".");
  }
}

LoadedCloud loadCloud(const std::string& path, const CloudOptions& options) {
  LoadedCloud loaded = readCloud(path, options);
  for (const std::string& sentence : loaded.notes)
    note(sentence);
  return loaded;
}

} // namespace pcl_sq::app
