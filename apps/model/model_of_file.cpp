// SPDX-License-Identifier: BSD-3-Clause
// What a file's unit and its place on Earth have to do with its model.
#include "command_line/app.h"
#include "model/model_json.h"
#include "options/offset.h"
#include "report/size_doubt.h"

namespace pcl_sq::app {

ModelResult makeModel(const LoadedCloud& input,
                      const std::string& input_path,
                      const ModelOptions& options,
                      double load_ms) {
  ModelResult result;
  try {
    result = makeNearModel(input, input_path, moved(options, -input.offset), load_ms);
  } catch (const Failure& failure) {
    const std::string doubt = sizeDoubt("the cloud", sizeOf(input), options.cloud);
    if (doubt.empty())
      throw;
    std::string sentence = failure.what();
    if (!sentence.empty() && sentence.back() == '.')
      sentence.pop_back();
    throw Failure(sentence + "; " + doubt + ".");
  }
  const RoiBox& box = result.report.region;
  const std::string doubt =
      sizeDoubt("the object", (box.max - box.min).maxCoeff(), options.cloud);
  if (!doubt.empty())
    result.report.notes.push_back(doubt);
  result = moved(std::move(result), input.offset);
  result.file.options_json = optionsToJson(options);
  result.file.extra_json = reportToJson(result);
  return result;
}

} // namespace pcl_sq::app
