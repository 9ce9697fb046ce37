// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/sequence.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/image_header.h"
#include "model/model_json.h"
#include "report/ordered_lines.h"
#include "report/text.h"
#include "stereo/stereo_model.h"

#include <nlohmann/json.hpp>

#include <glob.h>

#include <algorithm>
#include <cstring>
#include <iostream>

namespace pcl_sq::app {
namespace {

/** \brief The frames' files; one list is empty where its pattern is. */
struct Frames {
  std::vector<std::string> left, right, depth;

  explicit Frames(const FrontOptions& o) {
    const auto fill = [](const std::string& pattern, std::vector<std::string>& files) {
      if (!pattern.empty())
        files = filesOf(pattern);
    };
    fill(o.left, left);
    fill(o.right, right);
    fill(o.depth, depth);
    const std::vector<std::string>& others = o.depth.empty() ? right : depth;
    if (!left.empty() && left.size() != others.size())
      throw Failure("'" + o.left + "' names " + std::to_string(left.size()) +
                    " files but '" + (o.depth.empty() ? o.right : o.depth) + "' " +
                    std::to_string(others.size()) +
                    "; each frame needs one of each: add or remove some.");
  }

  std::size_t size() const { return std::max(left.size(), depth.size()); }

  void choose(std::size_t i, FrontOptions& o) const {
    const auto take = [i](const std::vector<std::string>& files, std::string& name) {
      if (!files.empty())
        name = files[i];
    };
    take(left, o.left);
    take(right, o.right);
    take(depth, o.depth);
  }
};

std::string errorLine(const std::string& path, const std::string& why) {
  const nlohmann::ordered_json line = {{"input", {{"path", path}}}, {"error", why}};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/** \brief Width and height that an image says it has; 0 where it says none. */
std::pair<std::uint64_t, std::uint64_t> sizeOf(const std::string& path) {
  ImageHeader header;
  std::string why;
  if (!readImageHeader(readFile(path), header, &why))
    return {0, 0};
  return {header.width, header.height};
}

} // namespace

std::vector<std::string> filesOf(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (files.empty())
    throw Failure("no file is named like '" + pattern +
                  "'; give a pattern such as 'left_*.png', in quotes.");
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return strverscmp(a.c_str(), b.c_str()) < 0;
  });
  return files;
}

int runSequence(FrontOptions front, const ModelOptions& model) {
  const Frames frames(front);
  OrderedLines lines(model.output.empty() ? "-" : model.output, 1);
  std::optional<StereoPipeline> pipeline;
  bool all = true, followed = false;
  std::pair<std::uint64_t, std::uint64_t> first;
  for (std::size_t i = 0; i < frames.size() && lines.failure().empty(); ++i) {
    frames.choose(i, front);
    const std::string& name = front.left.empty() ? front.depth : front.left;
    const auto attempt = [&] {
      const auto size = sizeOf(name);
      if (i == 0)
        first = size;
      else if (size != first && size.first > 0)
        throw Failure("the frame has " + std::to_string(size.first) + " x " +
                      std::to_string(size.second) + " px, the first one " +
                      std::to_string(first.first) + " x " +
                      std::to_string(first.second) +
                      "; give frames of one camera and one size.");
      const StereoView view = runFront(front, model.roi, pipeline);
      const StereoModel made = makeStereoModel(front, view, model);
      for (const std::string& sentence : made.result.report.notes)
        note(sentence, name);
      return toJson(made.result.file, -1);
    };
    std::string line, why;
    for (bool again = true; again && line.empty(); again = followed, followed = false) {
      if (pipeline && !why.empty())
        pipeline->reset(); // perhaps the scene is another one
      try {
        line = attempt();
      } catch (const std::exception& error) {
        why = sentenceOf(error);
      }
    }
    followed = !line.empty();
    if (line.empty()) {
      all = false;
      std::cerr << "pcl_sq_stereo: " + printable(name + ": " + why) + "\n";
      line = errorLine(name, why);
    }
    lines.put(i, line);
  }
  lines.flush();
  if (!lines.failure().empty())
    throw Failure(lines.failure() + ".");
  return all ? DONE : FAILED;
}

} // namespace pcl_sq::app
