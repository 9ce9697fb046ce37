// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/sequence.h"

#include "command_line/app.h"
#include "model/model_json.h"
#include "report/ordered_lines.h"
#include "report/text.h"
#include "stereo/followed_frames.h"

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

} // namespace

std::vector<std::string> filesOf(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before there are threads
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
  FollowedFrames followed;
  bool all = true;
  for (std::size_t i = 0; i < frames.size() && lines.failure().empty(); ++i) {
    frames.choose(i, front);
    const std::string& name = front.left.empty() ? front.depth : front.left;
    std::string line;
    try {
      StereoView view;
      const StereoModel made = followed.next(front, model, view);
      for (const std::string& sentence : made.result.report.notes)
        note(sentence, name);
      line = toJson(made.result.file, -1);
    } catch (const std::exception& error) {
      all = false;
      const std::string why = sentenceOf(error);
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
