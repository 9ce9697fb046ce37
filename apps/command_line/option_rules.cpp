// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/option_rules.h"

#include "command_line/app.h"
#include "command_line/option_lists.h"
#include "files/files.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

using Line = CommandLine;

bool isAny(const Line& line, const OptionList& options) {
  return std::any_of(options.begin(), options.end(), [&line](const char* option) {
    return line.given(option);
  });
}

/** \brief Whether three parameters are fitted, as in the paper. */
bool fitsAsPaper(const Line& line) {
  if (line.given("--fit"))
    return line.value("--fit") == "paper";
  return decompositionOf(line) == "prisms" || asksForPaper(line);
}

/** \brief Whether the model's program gets a cloud and not a model. */
bool fitsACloud(const Line& line) {
  return extensionOf(line.value("input")) != ".json";
}

/** \brief Whether an input may have faces, whose surface is sampled. */
bool mayBeMesh(const Line& line) {
  const std::vector<std::string> inputs = line.values("cloud");
  return inputs.empty() ||
         std::any_of(inputs.begin(), inputs.end(), [](const std::string& input) {
           const std::string ending = extensionOf(input);
           return input == "-" || ending == ".ply" || ending == ".obj" ||
                  ending == ".stl";
         });
}

bool inParts(const Line& line) {
  return decompositionOf(line) == "parts";
}

/** \brief Where one of the options is given. */
std::function<bool(const Line&)> with(const OptionList& options) {
  return [options](const Line& line) { return isAny(line, options); };
}

/** \brief Where none of the options is given. */
std::function<bool(const Line&)> without(const OptionList& options) {
  return [options](const Line& line) { return !isAny(line, options); };
}

} // namespace

bool CommandLine::given(const std::string& option) const {
  const CLI::Option* found = cli_.get_option_no_throw(option);
  if (found == nullptr || found->count() == 0)
    return false;
  const bool switched_off = found->get_items_expected_max() == 0 && // in a --config
                            found->get_fnames().empty() &&
                            found->results().back() == "false";
  return !switched_off;
}

std::string CommandLine::value(const std::string& option) const {
  const CLI::Option* found = cli_.get_option_no_throw(option);
  if (found == nullptr)
    return {};
  return found->count() > 0 ? found->results().back() : found->get_default_str();
}

std::vector<std::string> CommandLine::values(const std::string& option) const {
  const CLI::Option* found = cli_.get_option_no_throw(option);
  return found != nullptr ? found->results() : std::vector<std::string>();
}

bool asksForPaper(const CommandLine& line) {
  return line.given("--preset") ? line.value("--preset") == "paper"
                                : isAny(line, PAPER_OPTIONS);
}

std::string decompositionOf(const CommandLine& line) {
  if (line.given("--decomposition"))
    return line.value("--decomposition");
  return asksForPaper(line) ? "prisms" : "parts";
}

const std::vector<OptionRule>& optionRules() {
  const std::string fit = "pcl_sq_fit", stereo = "pcl_sq_stereo",
                    scene = "pcl_sq_scene", grasp = "pcl_sq_grasp",
                    snapshot = "pcl_sq_snapshot", evaluate = "pcl_sq_evaluate",
                    render = "pcl_sq_render";
  const char* const one_hint = "give one hint: --roi, --click or --color";
  const char* const mask_says =
      "--mask says already which pixels are the object: give one of them";
  const char* const one_size =
      "give one of --voxel-size, --voxel-percent and --divisions";
  static const std::vector<OptionRule> rules = {
      // the paper's chain and the best mode
      {{},
       PAPER_OPTIONS,
       [](const Line& l) { return !l.given("--preset") || asksForPaper(l); },
       "it belongs to the paper's chain: leave out --preset best"},
      {{},
       PAPER_OPTIONS,
       [](const Line& l) { return !inParts(l); },
       "it belongs to the paper's chain: leave out --decomposition parts"},
      {{},
       {"--decomposition"},
       [](const Line& l) {
         return !l.given("--preset") || l.value("--decomposition") == "none" ||
                asksForPaper(l) == (l.value("--decomposition") == "prisms");
       },
       "prisms belong to --preset paper, parts to --preset best"},
      {{},
       {"--cost", "--axis-assignment", "--extents", "--pca", "--center"},
       fitsAsPaper,
       "it goes with --fit paper"},
      {{},
       {"--voxel-percent", "--voxel-size", "--divisions", "--run", "--exclusive"},
       [](const Line& l) { return decompositionOf(l) == "prisms"; },
       "it goes with --decomposition prisms"},
      {{}, {"--voxel-size"}, without({"--voxel-percent", "--divisions"}), one_size},
      {{}, {"--voxel-percent"}, without({"--divisions"}), one_size},
      {{fit, stereo},
       {"--parts", "--max-parts"},
       inParts,
       "it goes with --decomposition parts and without the paper's options"},
      {{},
       {"--max-parts"},
       [](const Line& l) { return !l.given("--parts") || l.value("--parts") == "0"; },
       "it goes with --parts 0, where their number is looked for"},
      // what the object is
      {{fit},
       {"--mask"},
       inParts,
       "it goes with --preset best; the paper's chain takes --roi or --box"},
      {{fit, grasp},
       {"--roi", "--box", "--remove-plane"},
       without({"--mask"}),
       mask_says},
      {{},
       {"--box"},
       [](const Line& l) { return !l.given("--roi") || !l.given("--remove-plane"); },
       "with --remove-plane, --roi says already where the thing is: give one of them"},
      {{fit},
       {"--complete"},
       without({"--one-sided", "--viewpoint", "--mask", "--roi", "--intrinsics"}),
       "a cloud from all round has no camera: leave out --one-sided, --viewpoint, "
       "--mask, --roi and --intrinsics"},
      {{fit},
       {"--intrinsics", "--complete", "--one-sided"},
       inParts,
       "it goes with --preset best"},
      {{stereo}, {"--click"}, without({"--roi"}), one_hint},
      {{stereo}, {"--color"}, without({"--roi", "--click"}), one_hint},
      {{stereo}, {"--roi", "--click", "--color"}, without({"--mask"}), mask_says},
      {{stereo},
       {"--segment"},
       [](const Line& l) {
         return l.value("--segment") != "color" ||
                isAny(l, {"--roi", "--click", "--color", "--mask"});
       },
       "color goes with a hint: --roi, --click or --color"},
      {{stereo},
       {"--remove-plane"},
       [](const Line& l) { return l.value("--segment") == "none"; },
       "it goes with --segment none; the outline leaves the table out already"},
      {{stereo},
       {"--box"},
       [](const Line& l) { return !inParts(l) || l.value("--segment") == "none"; },
       "it goes with --preset paper or --segment none; the best mode takes the "
       "outline"},
      {{stereo},
       {"--border-filter"},
       [](const Line& l) {
         return !inParts(l) || isAny(l, {"--object-cloud", "--panel"});
       },
       "it goes with --preset paper, or with --object-cloud or --panel"},
      {{stereo},
       {"--write-mask"},
       [](const Line& l) { return l.value("--segment") != "none"; },
       "--segment none finds no outline to write"},
      // pairs and depth images
      {{stereo},
       MATCHING_OPTIONS,
       without({"--depth"}),
       "it goes with a pair of images: a depth image has its depths already"},
      {{stereo},
       {"--calib", "--calib-unit", "--baseline", "--disparity"},
       without({"--depth"}),
       "it goes with a pair of images: a depth image has its depths already"},
      {{scene}, MATCHING_OPTIONS, with({"right"}), "it goes with a pair of images"},
      {{scene},
       {"--calib", "--baseline"},
       with({"right"}),
       "it goes with a pair of images"},
      {{scene},
       {"--unit"},
       without({"right", "--depth"}),
       "it goes with a point cloud; images have --calib-unit and --depth-scale"},
      {{stereo, scene}, {"--depth-scale"}, with({"--depth"}), "it goes with --depth"},
      {{stereo, scene}, {"--calib-unit"}, with({"--calib"}), "it goes with --calib"},
      // grasps
      {{fit},
       {"--gripper", "--friction", "--clearance", "--min-observed"},
       [](const Line& l) { return l.given("--grasps") && l.value("--grasps") != "0"; },
       "it goes with --grasps N"},
      {{},
       {"--grasp-threshold"},
       with({"--grasp-points"}),
       "it goes with --grasp-points FILE"},
      {{grasp},
       {"--graspit-parts", "--graspit-name"},
       with({"--graspit"}),
       "it goes with --graspit DIR"},
      {{grasp},
       {"--preset",
        "--parts",
        "--max-parts",
        "--mask",
        "--intrinsics",
        "--roi",
        "--remove-plane",
        "--threads"},
       fitsACloud,
       "the input is a model already; it goes with a point cloud"},
      {{grasp},
       {"--up"},
       fitsACloud,
       "the input is a model already; give the table that it stands on (--table)"},
      {{grasp},
       {"--unit", "--samples"},
       [](const Line& l) { return fitsACloud(l) || l.given("--cloud"); },
       "the input is a model already, whose lengths are metres"},
      {{fit}, {"--samples"}, mayBeMesh, "it goes with a mesh: PLY, OBJ or STL"},
      {{snapshot}, {"--unit", "--samples"}, with({"--cloud"}), "it goes with --cloud"},
      {{grasp},
       {"--cloud"},
       [](const Line& l) { return !fitsACloud(l); },
       "it goes with a model file; the input is a cloud itself"},
      // pictures, scenes and figures
      {{snapshot}, {"--opacity", "--object"}, with({"model"}), "it goes with a model"},
      {{snapshot}, {"--point-size"}, with({"--cloud"}), "it goes with --cloud"},
      {{snapshot},
       {"--context"},
       [](const Line& l) { return l.given("--cloud") && l.given("model"); },
       "it goes with a model and --cloud"},
      {{evaluate}, {"--pose", "--symmetry"}, with({"--mesh"}), "it goes with --mesh"},
      {{evaluate}, {"--mesh"}, without({"--truth"}), "give one of --mesh and --truth"},
      {{evaluate},
       {"--samples"},
       with({"--truth", "--mesh"}),
       "it goes with --truth or --mesh"},
      {{render}, {"--mesh-up", "--mesh-unit"}, with({"--mesh"}), "it goes with --mesh"},
      {{render},
       {"--mesh"},
       without({"scene"}),
       "give a scene or --mesh FILE, not both"},
      {{"pcl_sq_calibrate"},
       {"--list"},
       without({"images"}),
       "give the images or --list, not both"}};
  return rules;
}

void checkOptionRules(const CLI::App& cli) {
  const CommandLine line(cli);
  for (const OptionRule& rule : optionRules()) {
    if (!rule.programs.empty() &&
        std::find(rule.programs.begin(), rule.programs.end(), line.program()) ==
            rule.programs.end())
      continue;
    for (const char* option : rule.options)
      if (line.given(option) && !rule.holds(line))
        throw UsageError(std::string(option) + " has no effect here: " + rule.cure +
                         ".");
  }
}

} // namespace pcl_sq::app
