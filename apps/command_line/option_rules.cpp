// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/option_rules.h"

#include "command_line/app.h"
#include "files/files.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

using Line = CommandLine;

/** \brief Options that only the paper's chain has: naming one asks for that chain. */
const std::vector<const char*> PAPER_OPTIONS = {"--fit",
                                                "--cost",
                                                "--axis-assignment",
                                                "--extents",
                                                "--pca",
                                                "--center",
                                                "--voxel-percent",
                                                "--voxel-size",
                                                "--divisions",
                                                "--run",
                                                "--exclusive"};

bool isAny(const Line& line, const std::vector<const char*>& options) {
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

bool hasHint(const Line& line) {
  return isAny(line, {"--roi", "--click", "--color"});
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
  static const std::vector<OptionRule> rules = {
      // the paper's chain and the best mode
      {{},
       PAPER_OPTIONS,
       [](const Line& l) { return !l.given("--preset") || asksForPaper(l); },
       "it belongs to the paper's chain: leave out --preset best"},
      {{},
       PAPER_OPTIONS,
       [](const Line& l) { return decompositionOf(l) != "parts"; },
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
      {{},
       {"--voxel-size"},
       [](const Line& l) {
         return !isAny(l, {"--voxel-percent", "--divisions"});
       },
       "give one of --voxel-size, --voxel-percent and --divisions"},
      {{},
       {"--voxel-percent"},
       [](const Line& l) { return !l.given("--divisions"); },
       "give one of --voxel-size, --voxel-percent and --divisions"},
      {{"pcl_sq_fit", "pcl_sq_stereo"},
       {"--parts", "--max-parts"},
       [](const Line& l) { return decompositionOf(l) == "parts"; },
       "it goes with --decomposition parts and without the paper's options"},
      {{},
       {"--max-parts"},
       [](const Line& l) { return !l.given("--parts") || l.value("--parts") == "0"; },
       "it goes with --parts 0, where their number is looked for"},
      // what the object is
      {{"pcl_sq_fit"},
       {"--mask"},
       [](const Line& l) { return decompositionOf(l) == "parts"; },
       "it goes with --preset best; the paper's chain takes --roi or --box"},
      {{"pcl_sq_fit", "pcl_sq_grasp"},
       {"--roi", "--box", "--remove-plane"},
       [](const Line& l) { return !l.given("--mask"); },
       "--mask says already which pixels are the object: give one of them"},
      {{},
       {"--box"},
       [](const Line& l) { return !l.given("--roi") || !l.given("--remove-plane"); },
       "with --remove-plane, --roi says already where the thing is: give one of them"},
      {{"pcl_sq_fit"},
       {"--intrinsics"},
       [](const Line& l) { return decompositionOf(l) == "parts"; },
       "it goes with --preset best"},
      {{"pcl_sq_fit"},
       {"--complete"},
       [](const Line& l) {
         return !isAny(
             l, {"--one-sided", "--viewpoint", "--mask", "--roi", "--intrinsics"});
       },
       "a cloud from all round has no camera: leave out --one-sided, --viewpoint, "
       "--mask, --roi and --intrinsics"},
      {{"pcl_sq_fit"},
       {"--complete", "--one-sided"},
       [](const Line& l) { return decompositionOf(l) == "parts"; },
       "it goes with --preset best"},
      {{"pcl_sq_stereo"},
       {"--click"},
       [](const Line& l) { return !l.given("--roi"); },
       "give one hint: --roi, --click or --color"},
      {{"pcl_sq_stereo"},
       {"--color"},
       [](const Line& l) {
         return !isAny(l, {"--roi", "--click"});
       },
       "give one hint: --roi, --click or --color"},
      {{"pcl_sq_stereo"},
       {"--roi", "--click", "--color"},
       [](const Line& l) { return !l.given("--mask"); },
       "--mask says already which pixels are the object: give one of them"},
      {{"pcl_sq_stereo"},
       {"--segment"},
       [](const Line& l) {
         return l.value("--segment") != "color" || hasHint(l) || l.given("--mask");
       },
       "color goes with a hint: --roi, --click or --color"},
      {{"pcl_sq_stereo"},
       {"--remove-plane"},
       [](const Line& l) { return l.value("--segment") == "none"; },
       "it goes with --segment none; the outline leaves the table out already"},
      {{"pcl_sq_stereo"},
       {"--box"},
       [](const Line& l) {
         return decompositionOf(l) != "parts" || l.value("--segment") == "none";
       },
       "it goes with --preset paper or --segment none; the best mode takes the "
       "outline"},
      {{"pcl_sq_stereo"},
       {"--border-filter"},
       [](const Line& l) {
         return decompositionOf(l) != "parts" ||
                isAny(l, {"--object-cloud", "--panel"});
       },
       "it goes with --preset paper, or with --object-cloud or --panel"},
      {{"pcl_sq_stereo"},
       {"--write-mask"},
       [](const Line& l) { return l.value("--segment") != "none"; },
       "--segment none finds no outline to write"},
      // pairs and depth images
      {{"pcl_sq_stereo"},
       {"--matcher",
        "--block-size",
        "--min-depth",
        "--max-depth",
        "--uniqueness",
        "--left-right",
        "--refine",
        "--wls",
        "--calib",
        "--calib-unit",
        "--baseline",
        "--disparity"},
       [](const Line& l) { return !l.given("--depth"); },
       "it goes with a pair of images: a depth image has its depths already"},
      {{"pcl_sq_stereo"},
       {"--depth-scale"},
       [](const Line& l) { return l.given("--depth"); },
       "it goes with --depth"},
      {{"pcl_sq_stereo"},
       {"--calib-unit"},
       [](const Line& l) { return l.given("--calib"); },
       "it goes with --calib"},
      // scenes
      {{"pcl_sq_scene"},
       {"--matcher",
        "--block-size",
        "--min-depth",
        "--max-depth",
        "--uniqueness",
        "--left-right",
        "--refine",
        "--wls",
        "--calib",
        "--baseline"},
       [](const Line& l) { return l.given("right"); },
       "it goes with a pair of images"},
      {{"pcl_sq_scene"},
       {"--unit"},
       [](const Line& l) { return !l.given("right") && !l.given("--depth"); },
       "it goes with a point cloud; images have --calib-unit and --depth-scale"},
      {{"pcl_sq_scene"},
       {"--calib-unit"},
       [](const Line& l) { return l.given("--calib"); },
       "it goes with --calib"},
      {{"pcl_sq_scene"},
       {"--depth-scale"},
       [](const Line& l) { return l.given("--depth"); },
       "it goes with --depth"},
      // grasps
      {{"pcl_sq_fit"},
       {"--gripper", "--friction", "--clearance", "--min-observed"},
       [](const Line& l) { return l.given("--grasps") && l.value("--grasps") != "0"; },
       "it goes with --grasps N"},
      {{},
       {"--grasp-threshold"},
       [](const Line& l) { return l.given("--grasp-points"); },
       "it goes with --grasp-points FILE"},
      {{"pcl_sq_grasp"},
       {"--graspit-parts", "--graspit-name"},
       [](const Line& l) { return l.given("--graspit"); },
       "it goes with --graspit DIR"},
      {{"pcl_sq_grasp"},
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
      {{"pcl_sq_grasp"},
       {"--cloud"},
       [](const Line& l) { return !fitsACloud(l); },
       "it goes with a model file; the input is a cloud itself"},
      // pictures, scenes and figures
      {{"pcl_sq_snapshot"},
       {"--opacity"},
       [](const Line& l) { return l.given("model"); },
       "it goes with a model"},
      {{"pcl_sq_snapshot"},
       {"--point-size"},
       [](const Line& l) { return l.given("--cloud"); },
       "it goes with --cloud"},
      {{"pcl_sq_snapshot"},
       {"--context"},
       [](const Line& l) { return l.given("--cloud") && l.given("model"); },
       "it goes with a model and --cloud"},
      {{"pcl_sq_evaluate"},
       {"--pose", "--symmetry"},
       [](const Line& l) { return l.given("--mesh"); },
       "it goes with --mesh"},
      {{"pcl_sq_evaluate"},
       {"--mesh"},
       [](const Line& l) { return !l.given("--truth"); },
       "give one of --mesh and --truth"},
      {{"pcl_sq_evaluate"},
       {"--samples"},
       [](const Line& l) {
         return isAny(l, {"--truth", "--mesh"});
       },
       "it goes with --truth or --mesh"},
      {{"pcl_sq_render"},
       {"--mesh-up", "--mesh-unit"},
       [](const Line& l) { return l.given("--mesh"); },
       "it goes with --mesh"},
      {{"pcl_sq_render"},
       {"--mesh"},
       [](const Line& l) { return !l.given("scene"); },
       "give a scene or --mesh FILE, not both"},
      {{"pcl_sq_calibrate"},
       {"--list"},
       [](const Line& l) { return !l.given("images"); },
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
