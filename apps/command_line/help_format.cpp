// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/help_format.h"

#include "command_line/option_lists.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace pcl_sq::app {

namespace {

constexpr std::size_t WIDTH = 79, COLUMN = 27; ///< of a line, of where the text begins

struct Group {
  const char* title;
  OptionList options;
};

/** \brief The groups in their order, with the options of all programs. */
const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"Input",
       {"--calib",    "--calib-unit", "--depth",   "--depth-unit", "--depth-scale",
        "--cloud",    "--unit",       "--samples", "--truth",      "--mesh",
        "--pose",     "--symmetry",   "--mesh-up", "--mesh-unit",  "--list",
        "--manifest", "--shard",      "--board",   "--square",     "--model",
        "--baseline"}},
      {"Object",
       {"--roi",
        "--box",
        "--mask",
        "--labels",
        "--min-pixels",
        "--object",
        "--remove-plane",
        "--segment",
        "--click",
        "--color",
        "--border-filter"}},
      {"View and frame",
       {"--intrinsics", "--viewpoint", "--table", "--up", "--complete", "--one-sided"}},
      {"Matching", MATCHING_OPTIONS},
      {"Fit", {"--preset", "--decomposition", "--parts", "--max-parts", "--taper"}},
      {"Paper's chain", PAPER_OPTIONS},
      {"Scene",
       {"--rig",
        "--distance",
        "--offset",
        "--yaw",
        "--pitch",
        "--contrast",
        "--noise",
        "--supersampling",
        "--seed",
        "--distortion"}},
      {"Picture",
       {"--size",
        "--view",
        "--turntable",
        "--opacity",
        "--context",
        "--point-size",
        "--title",
        "--caption"}},
      {"Grasps",
       {"--grasps",
        "--count",
        "--gripper",
        "--friction",
        "--clearance",
        "--min-observed"}},
      {"Output", {"--output",          "--out",          "--jsonl",
                  "--resume",          "--mesh",         "--snapshot",
                  "--export",          "--html",         "--grasp-points",
                  "--grasp-threshold", "--object-cloud", "--disparity",
                  "--panel",           "--write-mask",   "--write-labels",
                  "--histogram",       "--graspit",      "--graspit-parts",
                  "--graspit-name",    "--format",       "--rational"}},
      {"General", {"--config", "--threads", "--quiet", "--help", "--version"}}};
  return all;
}

/** \brief Whether an option that several programs have stands for their input. */
bool isInputOf(const std::string& program, const std::string& option) {
  if (option == "--mesh")
    return program == "pcl_sq_evaluate" || program == "pcl_sq_render";
  return option != "--cloud" || program != "pcl_sq_stereo";
}

/** \brief Breaks a text into lines of at most WIDTH, all but the first indented. */
std::string wrapped(const std::string& text, std::size_t indent, std::size_t at) {
  std::istringstream words(text);
  std::string word, lines;
  for (bool first = true; words >> word; first = false) {
    if (!first && at + 1 + word.size() > WIDTH) {
      lines += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!first) {
      lines += ' ';
      ++at;
    }
    lines += word;
    at += word.size();
  }
  return lines;
}

} // namespace

void groupOptions(CLI::App& cli) {
  for (CLI::Option* option : cli.get_options()) {
    if (option->get_positional() || option->get_group() != "Options")
      continue;
    const auto& names = option->get_lnames();
    for (const Group& group : groups())
      for (const char* name : group.options) {
        const bool named = !names.empty() && "--" + names.front() == std::string(name);
        if (named &&
            (std::string(group.title) != "Input" || isInputOf(cli.get_name(), name)))
          if (option->get_group() == "Options")
            option->group(group.title);
      }
    if (option->get_group() == "Options")
      option->group("Output");
  }
}

std::string HelpFormat::make_option(const CLI::Option* option, bool positional) const {
  std::string name, type = option->get_type_name(), range;
  if (const std::size_t colon = type.find(':'); colon != std::string::npos) {
    range = type.substr(colon + 1);
    type = type.substr(0, colon);
  }
  if (type == "TEXT" && range.find('|') != std::string::npos)
    type = std::exchange(range, std::string()); // the names say it all
  else if (type == "INT" || type == "UINT" || type == "FLOAT" || type == "TEXT")
    type = type == "TEXT" ? "TEXT" : "N";
  if (positional)
    name = type.empty() ? option->get_single_name() : type;
  else {
    name = option->get_snames().empty() ? "    " : "-" + option->get_snames()[0] + ", ";
    if (!option->get_lnames().empty())
      name += "--" + option->get_lnames()[0];
    if (option->get_items_expected_max() > 0)
      name += " " + type;
  }
  std::string text = option->get_description();
  const std::string standard = option->get_default_str();
  std::string limits = range;
  if (!standard.empty() && option->get_items_expected_max() > 0)
    limits += (limits.empty() ? "" : "; ") + ("default " + standard);
  if (option->get_required() && !positional)
    limits += std::string(limits.empty() ? "" : "; ") + "required";
  if (!limits.empty())
    text += " (" + limits + ")";
  std::string line = "  " + name;
  if (line.size() + 2 > COLUMN)
    line += "\n" + std::string(COLUMN, ' ');
  else
    line.resize(COLUMN, ' ');
  return line + wrapped(text, COLUMN, COLUMN) + "\n";
}

std::string
HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  std::string usage = "Usage: " + name + " [OPTIONS]";
  std::string positionals;
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional()) {
      std::string kind = option->get_type_name();
      if (kind.compare(0, 4, "TEXT") == 0)
        kind = option->get_single_name();
      usage += option->get_required() ? " " + kind : " [" + kind + "]";
      positionals += make_option(option, true);
    }
  std::string text = wrapped(app->get_description(), 0, 0) + "\n\n" + usage + "\n";
  std::vector<std::string> titles;
  for (const Group& group : groups())
    titles.emplace_back(group.title);
  for (const std::string& group : app->get_groups()) // of options that name their own
    if (!group.empty() &&
        std::find(titles.begin(), titles.end(), group) == titles.end())
      titles.insert(titles.end() - 1, group);
  for (const std::string& title : titles) {
    std::string lines = title == "Input" ? positionals : "";
    for (const CLI::Option* option : app->get_options())
      if (!option->get_positional() && option->get_group() == title)
        lines += make_option(option, false);
    if (!lines.empty())
      text += "\n" + title + ":\n" + lines;
  }
  return text + "\n" + app->get_footer() + "\n";
}

} // namespace pcl_sq::app
