// SPDX-License-Identifier: BSD-3-Clause
// Every option of every program: found through --help, given rubbish, given where it
// has no effect, misspelt.
#include "command_line/option_rules.h"
#include "program.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

using namespace pcl_sq::test;
using pcl_sq::app::OptionRule;

namespace {

struct Option {
  std::string name, type; ///< type is empty for a flag
};

/** \brief The options that a program's --help tells of. */
std::vector<Option> optionsOf(const std::string& program) {
  const ProgramRun run = runProgram(program, {"--help"});
  EXPECT_EQ(run.code, 0) << run.err;
  std::vector<Option> options;
  const std::regex line("\n {2}(?:-., |    )(--[a-z-]+)(?: ([^ \n]+))?(?= *\n|  )");
  for (std::sregex_iterator i(run.out.begin(), run.out.end(), line), end; i != end; ++i)
    options.push_back({(*i)[1], (*i)[2]});
  EXPECT_GT(options.size(), 5u) << run.out;
  return options;
}

/** \brief Arguments with which a program would begin its work. */
std::vector<std::string> enough(const std::string& program) {
  if (program == "pcl_sq_fit" || program == "pcl_sq_grasp")
    return {"absent.pcd"};
  if (program == "pcl_sq_snapshot")
    return {"absent.json", "-o", "picture.png"};
  if (program == "pcl_sq_evaluate")
    return {"absent.json"};
  if (program == "pcl_sq_render")
    return {"box", "-o", "/nowhere/folder"};
  if (program == "pcl_sq_scene")
    return {"absent.pcd"};
  if (program == "pcl_sq_calibrate")
    return {"a.png", "b.png", "--square", "0.02", "-o", "/nowhere/c.yml"};
  return {"left.png", "right.png", "--calib", "absent.yml"};
}

/** \brief A value that the option takes. */
std::string valueFor(const std::string& option, const std::string& type) {
  if (const auto bar = type.find('|'); bar != std::string::npos && type != "NAME|FILE")
    return option == "--segment" ? "color" : type.substr(0, bar);
  if (type == "NAME|FILE")
    return "wsg_50";
  if (type == "FILE" || type == "DIR" || type == "TEXT" || type == "POSE")
    return "name.png";
  const auto commas = std::size_t(std::count(type.begin(), type.end(), ','));
  std::string value = option == "--block-size" ? "5"
                      : option == "--samples"  ? "5000"
                                               : "1";
  for (std::size_t i = 0; i < commas; ++i)
    value += ",1";
  return value;
}

class Program : public testing::TestWithParam<std::string> {};

ProgramRun runWith(const std::string& program, std::vector<std::string> more) {
  std::vector<std::string> arguments = enough(program);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return runProgram(program, arguments);
}

void expectSentence(const ProgramRun& run,
                    const std::string& about,
                    const std::string& line) {
  EXPECT_EQ(run.code, 2) << line << "\n" << run.err;
  EXPECT_EQ(run.sentences(), 1) << line << "\n" << run.err;
  EXPECT_NE(run.err.find(about), std::string::npos) << line << "\n" << run.err;
  EXPECT_LT(run.err.size(), 240u) << line << "\n" << run.err;
  for (const char* internal : {"::", "std", "INI", "Could not convert", "what()"})
    EXPECT_EQ(run.err.find(internal), std::string::npos) << run.err;
}

} // namespace

TEST_P(Program, HelpHasGroupsAndFitsATerminal) {
  const ProgramRun run = runProgram(GetParam(), {"--help"});
  std::istringstream lines(run.out);
  std::string line;
  bool examples = false;
  while (std::getline(lines, line)) {
    examples = examples || line == "Examples:";
    if (!examples) { // a command line is not broken
      EXPECT_LE(line.size(), 80u) << line;
    }
  }
  EXPECT_TRUE(examples);
  for (const char* group :
       {"\nInput:\n", "\nOutput:\n", "\nGeneral:\n", "  -h, --help"})
    EXPECT_NE(run.out.find(group), std::string::npos) << group;
  EXPECT_EQ(run.out.find("\nOptions:\n"), std::string::npos);
}

TEST_P(Program, MisspeltOptionsAreToldWhichWasMeant) {
  for (const Option& option : optionsOf(GetParam())) {
    const std::string misspelt = option.name + "x";
    const ProgramRun run = runWith(GetParam(), {misspelt});
    expectSentence(run, "'" + misspelt + "'", misspelt);
    EXPECT_NE(run.err.find("did you mean '--"), std::string::npos) << run.err;
  }
}

TEST_P(Program, NumbersThatAreNoneAreRefusedByName) {
  std::size_t next = 0;
  for (const Option& option : optionsOf(GetParam())) {
    const bool numeric =
        option.type == "N" || option.type == "M" || option.type == "PX" ||
        option.type == "SIZES" ||
        std::regex_match(option.type, std::regex("[A-Z0-9]+(,[A-Z0-9]+)+"));
    if (!numeric)
      continue;
    const std::string good = valueFor(option.name, option.type);
    const std::vector<const char*> bad = {"x", "nan", "inf", "1e400", "3abc", "0x1p3"};
    std::string value = good;
    value.replace(0, value.find(','), bad[next++ % bad.size()]);
    expectSentence(runWith(GetParam(), {option.name + "=" + value}),
                   option.name,
                   option.name + "=" + value);
    if (good.find(',') != std::string::npos)
      expectSentence(runWith(GetParam(), {option.name, "1"}), option.name, option.name);
  }
}

TEST_P(Program, ValuesAtTheEndOfTheLineAreMissed) {
  for (const Option& option : optionsOf(GetParam()))
    if (!option.type.empty())
      expectSentence(
          runWith(GetParam(), {option.name}), option.name.substr(2), option.name);
}

TEST_P(Program, ChoicesThatAreNoneAreToldTheNames) {
  for (const Option& option : optionsOf(GetParam())) {
    if (option.type.find('|') == std::string::npos || option.type == "NAME|FILE" ||
        option.name == "--up")
      continue;
    const std::string first = option.type.substr(0, option.type.find('|'));
    expectSentence(runWith(GetParam(), {option.name, "nonsense"}), first, option.name);
  }
}

TEST_P(Program, OptionsMayStandBeforeTheFiles) {
  for (const Option& option : optionsOf(GetParam())) {
    std::vector<std::string> more = {option.name};
    if (!option.type.empty())
      more.push_back(valueFor(option.name, option.type));
    const ProgramRun behind = runWith(GetParam(), more);
    const std::vector<std::string> files = enough(GetParam());
    more.insert(more.end(), files.begin(), files.end());
    const ProgramRun before = runProgram(GetParam(), more);
    EXPECT_EQ(before.code, behind.code) << option.name;
    EXPECT_EQ(before.err, behind.err) << option.name;
  }
}

TEST_P(Program, AnEmptyNameIsNoFile) {
  for (const Option& option : optionsOf(GetParam()))
    if (option.type == "FILE" || option.type == "DIR")
      expectSentence(runWith(GetParam(), {option.name, ""}), "empty name", option.name);
}

TEST_P(Program, OptionsWithoutEffectAreRefused) {
  // every rule that forbids something in a plain command line
  std::set<std::string> refused;
  for (const Option& option : optionsOf(GetParam())) {
    std::vector<std::string> more = {option.name};
    if (!option.type.empty())
      more.push_back(valueFor(option.name, option.type));
    const ProgramRun run = runWith(GetParam(), more);
    if (run.err.find("has no effect") != std::string::npos) {
      // a depth image makes the line's own calibration needless
      const std::string named = option.name == "--depth" ? "--calib" : option.name;
      expectSentence(run, named + " has no effect here: ", option.name);
      refused.insert(option.name);
    }
  }
  const std::string program = GetParam();
  if (program == "pcl_sq_fit") {
    EXPECT_EQ(refused,
              (std::set<std::string>{"--gripper",
                                     "--friction",
                                     "--clearance",
                                     "--min-observed",
                                     "--grasp-threshold",
                                     "--samples"}));
  } else if (program == "pcl_sq_evaluate") {
    EXPECT_EQ(refused, (std::set<std::string>{"--pose", "--symmetry", "--samples"}));
  }
}

/** \brief The programs that were built. */
std::vector<std::string> builtPrograms() {
  return {"pcl_sq_fit",
          "pcl_sq_grasp",
#ifdef PCL_SQ_TEST_SNAPSHOT
          "pcl_sq_snapshot",
#endif
#ifdef PCL_SQ_TEST_STEREO
          "pcl_sq_stereo",
          "pcl_sq_scene",
          "pcl_sq_render",
          "pcl_sq_calibrate",
#endif
          "pcl_sq_evaluate"};
}

INSTANTIATE_TEST_SUITE_P(All,
                         Program,
                         testing::ValuesIn(builtPrograms()),
                         [](const auto& program) { return program.param; });

TEST(OptionRules, HoldForOptionsThatExist) {
  std::set<std::string> known;
  for (const std::string& program : builtPrograms())
    for (const Option& option : optionsOf(program))
      known.insert(option.name);
#if defined PCL_SQ_TEST_SNAPSHOT && defined PCL_SQ_TEST_STEREO
  for (const OptionRule& rule : pcl_sq::app::optionRules())
    for (const char* option : rule.options)
      EXPECT_EQ(known.count(option), 1u) << option;
#endif
}

TEST(OptionRules, RefuseWhatTheOtherOptionsMakeNeedless) {
  const auto refuses = [](const std::string& program,
                          const std::string& option,
                          const std::vector<std::string>& arguments) {
    std::string line = program;
    for (const std::string& argument : arguments)
      line += " " + argument;
    const ProgramRun run = runProgram(program, arguments);
    expectSentence(run, option + " has no effect here: ", line);
  };
  const std::string fit = "pcl_sq_fit", c = "absent.pcd";
  refuses(fit, "--cost", {c, "--preset", "best", "--cost", "solina"});
  refuses(fit, "--run", {c, "--decomposition", "none", "--run", "min"});
  refuses(fit, "--cost", {c, "--fit", "full", "--cost", "solina"});
  refuses(fit, "--parts", {c, "--parts", "2", "--preset", "paper"});
  refuses(fit, "--max-parts", {c, "--parts", "2", "--max-parts", "3"});
  refuses(fit, "--decomposition", {c, "--preset", "paper", "--decomposition", "parts"});
  refuses(fit, "--voxel-size", {c, "--voxel-size", "0.01", "--divisions", "4,4,4"});
  const Folder folder;
  const std::string mask = folder.write("mask.png", "no picture");
  refuses(fit, "--roi", {c, "--mask", mask, "--roi", "1,2,3,4"});
  refuses("pcl_sq_grasp", "--roi", {"absent.json", "--roi", "1,2,3,4"});
  refuses("pcl_sq_grasp", "--cloud", {c, "--cloud", "other.pcd"});
  refuses("pcl_sq_grasp", "--unit", {"absent.json", "--unit", "mm"});
  refuses(fit, "--samples", {c, "--samples", "200"});
#ifdef PCL_SQ_TEST_STEREO
  refuses("pcl_sq_stereo", "--matcher", {"--depth", "d.png", "--matcher", "sgbm"});
  refuses("pcl_sq_stereo",
          "--click",
          {"l.png", "r.png", "--roi", "1,1,9,9", "--click", "3,3"});
  refuses("pcl_sq_stereo", "--depth-scale", {"l.png", "r.png", "--depth-scale", "0.1"});
#endif
}

TEST(OptionRules, AConfigFileIsReadAlike) {
  const Folder folder;
  const auto with = [&folder](const std::string& text) {
    return runProgram("pcl_sq_fit",
                      {"absent.pcd", "--config", folder.write("fit.toml", text)});
  };
  expectSentence(
      with("decompositon = \"none\"\n"), "'--decomposition'", "typing error");
  expectSentence(with("[fit]\nparts = 1\n"), "'[fit]'", "a section");
  expectSentence(with("help = true\n"), "command line", "what ends a program");
  expectSentence(with("parts = 1.5\n"), "--parts wants a whole number", "not whole");
  expectSentence(with("friction = 0.5\n"), "--friction has no effect", "no grasps");
  EXPECT_EQ(with("exclusive = false\nparts = 2\n").code, 1)
      << "switched off is not given";
}
