// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_line.h"

#include "command_line/app.h"

#include "pcl_sq/stage_timer.h"

#include <nlohmann/json.hpp>

namespace pcl_sq::app {

ModelLine makeModelLine(const std::string& path, const ModelOptions& options) {
  ModelLine result;
  try {
    std::vector<std::pair<std::string, double>> timings;
    StageTimer timer(timings, {});
    const LoadedCloud input =
        timer.run("load", [&] { return readCloud(path, options.cloud); });
    const ModelResult made = makeModel(input, path, options, timings.back().second);
    result.notes = made.report.notes;
    result.line = toJson(made.file, -1);
  } catch (const std::exception& error) {
    result.failure = sentenceOf(error);
    const nlohmann::ordered_json line = {{"input", {{"path", path}}},
                                         {"error", result.failure}};
    result.line = line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return result;
}

} // namespace pcl_sq::app
