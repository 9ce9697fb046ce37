// SPDX-License-Identifier: BSD-3-Clause
// What the programs write, where, and what they leave alone.
#include "bottle_view.h"
#include "program.h"
#include "small_disk.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>
#include <unistd.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief An option of a program that names a file. */
struct Writer {
  std::string option, ending, magic; ///< \a magic: how the file starts
  bool streams = true;               ///< whether standard output gets this format
};

/** \brief A program, what it reads, and everything that it writes. */
struct Case {
  std::string program;
  std::vector<std::string> arguments;
  std::vector<Writer> writers;

  /** \brief A run that writes to one place. */
  ProgramRun run(const Writer& writer,
                 const std::string& path,
                 const std::string& before = "") const {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {writer.option, path});
    return runProgram(program, all, before);
  }
};

const std::string PNG = "\x89PNG";

class Output : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new Folder();
    ModelFile file;
    file.model = bottle();
    const std::string model = folder_->write("bottle.json", toJson(file));
    std::ostringstream text;
    text << visiblePoints(bottle(), 500, 0.0005).transpose() << "\n";
    const std::string cloud = folder_->write("bottle.xyz", text.str());
    cases_ = {{"pcl_sq_fit",
               {cloud, "--decomposition", "none"},
               {{"-o", ".json", "{"}, {"--grasp-points", ".pcd", "# .PCD"}}},
              {"pcl_sq_grasp",
               {model, "--table", "0,0,1,0.15", "--count", "1"},
               {{"-o", ".json", "{"}}},
              {"pcl_sq_evaluate", {model, "--cloud", cloud}, {{"-o", ".json", "{"}}}};
    if (isBuilt("pcl_sq_snapshot"))
      addPictures(model);
    if (isBuilt("pcl_sq_stereo"))
      addStereo();
  }
  static bool isBuilt(const std::string& program) {
    return std::filesystem::exists(PCL_SQ_BIN_DIR "/" + program);
  }
  static void addPictures(const std::string& model) {
    for (const Writer& more : {Writer{"--mesh", ".ply", "ply\n"},
                               {"--mesh", ".obj", "#", false},
                               {"--mesh", ".stl", "binary STL", false},
                               {"--mesh", ".vtp", "<?xml", false},
                               {"--snapshot", ".png", PNG}})
      cases_[0].writers.push_back(more);
    cases_[1].writers.push_back({"--snapshot", ".png", PNG});
    cases_.push_back(
        {"pcl_sq_snapshot", {model, "--size", "64x48"}, {{"-o", ".png", PNG}}});
  }
  static void addStereo() {
    const ProgramRun run = runProgram(
        "pcl_sq_render", {"can", "--rig", "small", "--out", *folder_ / "can", "-q"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string scene = *folder_ / "can/";
    cases_.push_back({"pcl_sq_stereo",
                      {scene + "left.png",
                       scene + "right.png",
                       "--calib",
                       scene + "calib.yml",
                       "--mask",
                       scene + "mask.png",
                       "--preset",
                       "paper"},
                      {{"-o", ".json", "{"},
                       {"--cloud", ".pcd", "# .PCD"},
                       {"--object-cloud", ".ply", "ply\n", false},
                       {"--disparity", ".pfm", "Pf", false},
                       {"--panel", ".png", PNG},
                       {"--write-mask", ".png", PNG},
                       {"--histogram", ".png", PNG}}});
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
    cases_.clear();
  }
  /** \brief Does something with every writer of every program. */
  template <typename Action>
  static void forEachWriter(const Action& action) {
    for (const Case& program : cases_)
      for (const Writer& writer : program.writers) {
        SCOPED_TRACE(program.program + " " + writer.option + " " + writer.ending);
        action(program, writer);
      }
  }
  /** \brief Failed with one sentence that holds a word. */
  static void expectFailure(const ProgramRun& run, const std::string& word) {
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.sentences(), 1) << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  }

  static Folder* folder_;
  static std::vector<Case> cases_;
};
Folder* Output::folder_ = nullptr;
std::vector<Case> Output::cases_;

} // namespace

TEST_F(Output, LinksPermissionsAndTheNameOfTheFileAreKept) {
  forEachWriter([](const Case& program, const Writer& writer) {
    const Folder folder;
    const std::string target = folder.write("target" + writer.ending, "old");
    const std::string link = folder / ("link" + writer.ending);
    chmod(target.c_str(), 0640);
    ASSERT_EQ(symlink(target.c_str(), link.c_str()), 0);
    const ProgramRun run = program.run(writer, link);
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string line = "wrote " + link + "\n";
    EXPECT_NE((run.out + run.err).find(line), std::string::npos) << run.out << run.err;
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(slurp(target).substr(0, writer.magic.size()), writer.magic);
    struct stat status = {};
    ASSERT_EQ(stat(target.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, mode_t(0640));
    EXPECT_EQ(folder.files(), 2u); // the link counts
  });
}

TEST_F(Output, StandardOutputHoldsTheFileAlone) {
  forEachWriter([](const Case& program, const Writer& writer) {
    if (!writer.streams)
      return;
    const ProgramRun run = program.run(writer, "-");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out.substr(0, writer.magic.size()), writer.magic);
    EXPECT_EQ(run.err.find("wrote"), std::string::npos) << run.err;
    if (writer.ending == ".json") {
      EXPECT_TRUE(nlohmann::json::accept(run.out)) << run.out;
    }
  });
}

TEST_F(Output, PipesAreWrittenInto) {
  forEachWriter([](const Case& program, const Writer& writer) {
    const Folder folder;
    const std::string pipe = folder / ("pipe" + writer.ending);
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const ProgramRun run = program.run(
        writer, pipe, "timeout 60 cat '" + pipe + "' > '" + (folder / "got") + "' &");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    for (int i = 0; i < 100 && slurp(folder / "got").empty(); ++i)
      usleep(20000); // cat is still at it
    EXPECT_EQ(slurp(folder / "got").substr(0, writer.magic.size()), writer.magic);
  });
}

TEST_F(Output, AFullDeviceIsAFailure) {
  forEachWriter([](const Case& program, const Writer& writer) {
    const Folder folder;
    const std::string link = folder / ("full" + writer.ending);
    ASSERT_EQ(symlink("/dev/full", link.c_str()), 0);
    expectFailure(program.run(writer, link), "the disk is full");
    EXPECT_TRUE(std::filesystem::is_symlink(link));
  });
}

TEST_F(Output, ReadOnlyFilesAndFoldersAreRefusedBeforeTheWork) {
  forEachWriter([](const Case& program, const Writer& writer) {
    const Folder folder;
    const std::string file = folder.write("file" + writer.ending, "precious");
    chmod(file.c_str(), 0444);
    ProgramRun run = program.run(writer, file);
    expectFailure(run, "read-only");
    EXPECT_TRUE(run.out.empty()) << run.out;
    EXPECT_EQ(slurp(file), "precious");
    std::filesystem::create_directory(folder / "locked");
    chmod((folder / "locked").c_str(), 0555);
    run = program.run(writer, folder / ("locked/file" + writer.ending));
    expectFailure(run, "not writable");
    EXPECT_TRUE(run.out.empty()) << run.out;
    chmod((folder / "locked").c_str(), 0755);
  });
}

TEST_F(Output, FilesStayWhenARunFails) {
  for (const Case& program : cases_) {
    const Folder folder;
    const std::string file =
        folder.write("file" + program.writers.front().ending, "precious");
    Case broken = program;
    broken.arguments.front() = folder / "missing.json";
    EXPECT_EQ(broken.run(program.writers.front(), file).code, 1) << program.program;
    EXPECT_EQ(slurp(file), "precious") << program.program;
    EXPECT_EQ(folder.files(), 1u) << program.program;
  }
}

TEST_F(Output, AFullDiskLeavesWhatWasThere) {
  const SmallDisk disk;
  if (!disk.ok())
    GTEST_SKIP() << "only root may have a disk of its own";
  disk.fill();
  const std::size_t files = disk.folder().files();
  for (const Case& program : cases_) {
    const Writer& writer = program.writers.front();
    expectFailure(program.run(writer, disk.folder() / ("file" + writer.ending)),
                  "the disk is full");
    EXPECT_EQ(disk.folder().files(), files) << program.program;
  }
}

TEST_F(Output, TwoOptionsMayNotNameOneFileNorAnInput) {
  const Folder folder;
  const Case& fit = cases_.front();
  const std::string file = folder / "file.json";
  std::vector<std::string> arguments = fit.arguments;
  arguments.insert(arguments.end(), {"-o", file, "--grasp-points"});
  for (const std::string& same : {file, folder / "./file.json"}) {
    std::vector<std::string> all = arguments;
    all.push_back(same);
    const ProgramRun run = runProgram("pcl_sq_fit", all);
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(run.sentences(), 1) << run.err;
  }
  EXPECT_EQ(folder.files(), 0u);
  const std::string before = slurp(fit.arguments[0]);
  EXPECT_EQ(fit.run(fit.writers.front(), fit.arguments[0]).code, 2);
  EXPECT_EQ(slurp(fit.arguments[0]), before);
}

TEST_F(Output, StandardOutputThatTakesNothingIsAFailureOfEveryProgram) {
  const auto fails = [](const std::string& command) {
    const Folder folder;
    const std::string err = folder / "err";
    const int status =
        std::system(("'" PCL_SQ_BIN_DIR "'/" + command + " 2>'" + err + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << command << slurp(err);
    EXPECT_NE(slurp(err).find("standard output"), std::string::npos) << slurp(err);
  };
  for (const Case& program : cases_)
    for (const char* option : {"--help", "--version"})
      fails(program.program + " " + option + " >/dev/full");
  fails("pcl_sq_fit --version >&-");
  fails("pcl_sq_fit '" + cases_[0].arguments[0] + "' >/dev/full");
  fails("pcl_sq_fit '" + cases_[0].arguments[0] + "' -o - >/dev/full");
  fails("pcl_sq_fit '" + cases_[0].arguments[0] + "' --jsonl >/dev/full");
  // the reader of a pipe that has gone: its end is closed before the program writes
  const std::string gone = "bash -c \"set -o pipefail; { sleep 0.5; '" PCL_SQ_BIN_DIR
                           "/pcl_sq_fit' --help 2>&3; } 3>&2 | true\" 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(gone.c_str())), 1);
}

TEST_F(Output, QuietProgramsSayNothing) {
  const Folder folder;
  Case fit = cases_.front();
  fit.arguments.push_back("-q");
  const ProgramRun run = fit.run(fit.writers.front(), folder / "m.json");
  EXPECT_EQ(run.out + run.err, "");
}

TEST_F(Output, ModelsAreReadFromStandardInput) {
  for (const Case& program : cases_)
    if (program.arguments.front() == *folder_ / "bottle.json") {
      std::vector<std::string> arguments = program.arguments;
      arguments.front() = "-";
      arguments.insert(arguments.end(), {"-o", "-"});
      const ProgramRun run =
          runProgram(program.program, arguments, "", *folder_ / "bottle.json");
      EXPECT_EQ(run.code, 0) << program.program << run.err;
    }
}
