// SPDX-License-Identifier: BSD-3-Clause
#include "files/gripper_file.h"

#include "command_line/app.h"
#include "command_line/did_you_mean.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "report/text.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace pcl_sq::app {

namespace {

const std::map<std::string, double Gripper::*>& sizesByName() {
  static const std::map<std::string, double Gripper::*> SIZES = {
      {"min_opening", &Gripper::min_opening},
      {"max_opening", &Gripper::max_opening},
      {"finger_length", &Gripper::finger_length},
      {"finger_width", &Gripper::finger_width},
      {"finger_thickness", &Gripper::finger_thickness},
      {"pad_length", &Gripper::pad_length},
      {"palm_width", &Gripper::palm_width},
      {"palm_depth", &Gripper::palm_depth},
      {"palm_height", &Gripper::palm_height}};
  return SIZES;
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::vector<CLI::ConfigItem> itemsOf(const std::string& text, const std::string& path) {
  // far longer than ten lines is no gripper
  constexpr std::size_t LONGEST = 1 << 16;
  std::istringstream stream(text);
  try {
    if (text.size() <= LONGEST)
      return CLI::ConfigTOML().from_config(stream);
  } catch (const std::exception&) {
    // said below, in our words
  }
  throw UsageError("'" + path + "' is no TOML file of lines name = value");
}

} // namespace

Gripper gripperFromToml(const std::string& text,
                        const std::string& path,
                        std::string& missing) {
  Gripper gripper;
  gripper.name = path;
  const auto refuse = [&path](const std::string& what) {
    throw UsageError("'" + path + "': " + what);
  };
  std::vector<std::string> known = {"fingers", "name"};
  for (const auto& size : sizesByName())
    known.push_back(size.first);
  std::set<std::string> given;
  for (const CLI::ConfigItem& item : itemsOf(text, path)) {
    if (item.name == "++" || item.name == "--") // a section begins or ends
      continue;
    const auto size = sizesByName().find(item.name);
    if (!given.insert(item.name).second)
      refuse(item.name + " is given twice");
    if (item.name == "name" && item.inputs.size() == 1) {
      gripper.name = item.inputs[0];
      continue;
    }
    if (size == sizesByName().end() && item.name != "fingers")
      refuse(app::quoted(item.name) + " is no size of a gripper" +
             didYouMean(item.name, known));
    double number = 0.0;
    if (item.inputs.size() != 1 || !parseNumber(item.inputs[0], number))
      refuse(item.name + " is not a number");
    if (item.name == "fingers") {
      if (number != 2.0 && number != 3.0)
        refuse("fingers must be 2 or 3");
      gripper.fingers = static_cast<int>(number);
      continue;
    }
    // hands of millimetres are some tens wide, of metres never
    if (number > 2.0 && number <= 2000.0)
      refuse(item.name + " = " + item.inputs[0] +
             " looks like millimetres; sizes are "
             "in metres: write " +
             item.name + " = " + std::to_string(number / 1000.0));
    gripper.*size->second = number;
  }
  std::string why;
  if (!gripper.isValid(&why))
    refuse(why);
  std::vector<std::string> left_out;
  for (const auto& [name, member] : sizesByName())
    if (given.count(name) == 0 && name != "min_opening")
      left_out.push_back(name);
  missing = joined(left_out);
  return gripper;
}

Gripper readGripper(const std::string& preset_or_path) {
  Gripper gripper;
  if (Gripper::preset(preset_or_path, gripper))
    return gripper;
  if (extensionOf(preset_or_path) == ".toml") {
    std::string missing;
    gripper = gripperFromToml(readFile(preset_or_path), preset_or_path, missing);
    if (!missing.empty())
      note("'" + preset_or_path + "' leaves out " + missing + "; they are those of " +
           Gripper().name);
    return gripper;
  }
  const std::vector<std::string> names = Gripper::presetNames();
  throw UsageError("there is no gripper " + app::quoted(preset_or_path) +
                   "; name one of " + joined(names) +
                   ", or a .toml file with the sizes" +
                   didYouMean(preset_or_path, names));
}

} // namespace pcl_sq::app
