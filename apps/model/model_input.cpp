// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_input.h"

#include "command_line/app.h"
#include "report/text.h"

#include "pcl_sq/file_io.h"

#include <algorithm>

namespace pcl_sq::app {

ModelFile thingOnTable(const SceneFile& scene, std::size_t index) {
  ModelFile file = scene.objects[index].file;
  if (!file.table)
    file.table = scene.table;
  return file;
}

ModelInput readModelInput(const std::string& path, std::size_t object) {
  ModelInput input;
  std::string text, why;
  const bool scene = pcl_sq::readFile(path, text) && isScene(text);
  if (!(scene ? loadScene(path, input.scene, &why) : loadModel(path, input.file, &why)))
    throw Failure(why + ".");
  const std::size_t things = input.scene.objects.size();
  if (object > 0 && !scene)
    throw UsageError("--object has no effect here: it goes with a scene of "
                     "pcl_sq_scene.");
  if (object > things)
    throw UsageError("--object " + std::to_string(object) + ": the scene has " +
                     std::to_string(things) + " only.");
  if (things > 0 && (object > 0 || things == 1))
    input.file = thingOnTable(input.scene, std::max<std::size_t>(object, 1) - 1);
  else if (scene) {
    input.file.model = input.scene.all();
    input.file.table = input.scene.table;
    input.file.frame = input.scene.frame;
    input.file.input_path = input.scene.input_path;
    if (things > 0) // all were seen from one place, with one way up
      input.file.extra_json = input.scene.objects.front().file.extra_json;
  }
  if (input.file.model.empty())
    throw Failure("'" + printable(path) + "' holds no " +
                  (scene ? "thing" : "superquadric") + "; give another file.");
  return input;
}

} // namespace pcl_sq::app
