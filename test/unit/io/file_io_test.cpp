// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/file_io.h"

#include "folder.h"
#include "small_disk.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

mode_t permissionsOf(const std::string& path) {
  struct stat status = {};
  EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 07777;
}

std::string whyNot(const std::string& path) {
  std::string why;
  EXPECT_FALSE(isWritable(path, &why)) << path;
  std::string late;
  EXPECT_FALSE(writeFile(path, "text", &late)) << path;
  EXPECT_EQ(late, why);
  return why;
}

bool contains(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

} // namespace

TEST(WriteFile, ReplacesAFileAndKeepsItsPermissions) {
  const Folder folder;
  const std::string path = folder.write("a.json", "old and longer than the new one");
  chmod(path.c_str(), 0640);
  ASSERT_TRUE(writeFile(path, "new"));
  EXPECT_EQ(slurp(path), "new");
  EXPECT_EQ(permissionsOf(path), mode_t(0640));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteFile, NewFilesGetThePermissionsThatTheUserSet) {
  const Folder folder;
  const mode_t before = umask(027);
  ASSERT_TRUE(writeFile(folder / "new", "text"));
  umask(before);
  EXPECT_EQ(permissionsOf(folder / "new"), mode_t(0640));
}

TEST(WriteFile, LinksStayAndTheirTargetsAreReplaced) {
  const Folder folder, other;
  const std::string target = other.write("target", "old");
  ASSERT_EQ(symlink(target.c_str(), (folder / "absolute").c_str()), 0);
  ASSERT_EQ(symlink("absolute", (folder / "relative").c_str()), 0);
  ASSERT_EQ(symlink("not_yet", (folder / "dangling").c_str()), 0);
  ASSERT_EQ(symlink("circle", (folder / "circle").c_str()), 0);
  ASSERT_TRUE(writeFile(folder / "relative", "new"));
  EXPECT_EQ(slurp(target), "new");
  ASSERT_TRUE(writeFile(folder / "dangling", "text"));
  EXPECT_EQ(slurp(folder / "not_yet"), "text");
  for (const char* link : {"absolute", "relative", "dangling"})
    EXPECT_TRUE(std::filesystem::is_symlink(folder / link)) << link;
  EXPECT_EQ(other.files(), 1u);
  EXPECT_TRUE(contains(whyNot(folder / "circle"), "circle"));
}

TEST(WriteFile, PipesAreWrittenIntoAndStay) {
  const Folder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string large(300000, 'x'); // more than a pipe holds
  std::string got;
  std::thread reader([&] { got = slurp(pipe); });
  EXPECT_TRUE(isWritable(pipe));
  EXPECT_TRUE(writeFile(pipe, large));
  reader.join();
  EXPECT_EQ(got, large);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(WriteFile, OwnOpenFilesAreWrittenIntoWhereTheyStand) {
  const Folder folder;
  const std::string path = folder / "log";
  const int file = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(write(file, "before ", 7), 7);
  for (const char* place : {"/dev/fd/", "/proc/self/fd/"})
    EXPECT_TRUE(writeFile(place + std::to_string(file), "a ")) << place;
  ASSERT_EQ(write(file, "after", 5), 5);
  close(file);
  EXPECT_EQ(slurp(path), "before a a after");
  EXPECT_TRUE(contains(whyNot("/dev/fd/" + std::to_string(file)), "not open"));
}

TEST(WriteFile, DevicesThatAreFullAreFailures) {
  std::string why;
  EXPECT_TRUE(writeFile("/dev/null", "text", &why)) << why;
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_FALSE(writeFile("/dev/full", "text", &why));
  EXPECT_TRUE(contains(why, "full")) << why;
}

TEST(WriteFile, WhatIsNoPlaceForAFileIsRefusedAndSaysWhy) {
  const Folder folder;
  const std::string file = folder.write("file", "old");
  EXPECT_TRUE(contains(whyNot(""), "empty"));
  EXPECT_TRUE(contains(whyNot(folder / "."), "folder"));
  EXPECT_TRUE(contains(whyNot(folder / ""), "folder"));
  EXPECT_TRUE(contains(whyNot(folder / "no/file"), "does not exist; create it"));
  EXPECT_TRUE(contains(whyNot(file + "/file"), "no folder"));
  EXPECT_TRUE(contains(whyNot(folder / std::string(300, 'n')), "too long"));
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  const std::string name = folder / "socket";
  name.copy(address.sun_path, sizeof address.sun_path - 1);
  const int server = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(server, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_TRUE(contains(whyNot(name), "socket"));
  close(server);
}

TEST(WriteFile, WhatNobodyMayWriteIsRefusedForRootToo) {
  const Folder folder;
  const std::string file = folder.write("file", "precious");
  chmod(file.c_str(), 0444);
  EXPECT_TRUE(contains(whyNot(file), "read-only"));
  EXPECT_EQ(slurp(file), "precious");
  std::filesystem::create_directory(folder / "locked");
  chmod((folder / "locked").c_str(), 0555);
  EXPECT_TRUE(contains(whyNot(folder / "locked/file"), "not writable"));
  chmod((folder / "locked").c_str(), 0755);
}

TEST(WriteFile, LongestNamesWork) {
  const Folder folder;
  const std::string path = folder / std::string(255, 'n');
  EXPECT_TRUE(writeFile(path, "text"));
  EXPECT_EQ(slurp(path), "text");
}

TEST(WriteFile, WritersOfOneFileDoNotMix) {
  const Folder folder;
  const std::string path = folder / "file";
  constexpr int WRITERS = 8, TIMES = 50;
  std::vector<std::thread> writers;
  for (int i = 0; i < WRITERS; ++i)
    writers.emplace_back([&path, i] {
      std::string why;
      for (int k = 0; k < TIMES; ++k)
        EXPECT_TRUE(writeFile(path, std::string(20000, char('a' + i)), &why)) << why;
    });
  for (std::thread& writer : writers)
    writer.join();
  const std::string text = slurp(path);
  EXPECT_EQ(text, std::string(20000, text.at(0)));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteFile, WhatAKilledProgramLeftIsRemovedByTheNextWrite) {
  const Folder folder;
  folder.write(".file.pcl_sq0", "half of a fi");
  ASSERT_TRUE(writeFile(folder / "file", "text"));
  EXPECT_EQ(slurp(folder / "file"), "text");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(LineFile, ReplacesTheOldFileWithItsFirstLineAndGrows) {
  const Folder folder;
  const std::string path = folder.write("lines", "old\n");
  {
    LineFile lines(path);
    EXPECT_EQ(slurp(path), "old\n");
    ASSERT_TRUE(lines.append("one"));
    EXPECT_EQ(slurp(path), "one\n");
    ASSERT_TRUE(lines.append("two"));
    EXPECT_EQ(slurp(path), "one\ntwo\n");
    EXPECT_EQ(folder.files(), 1u);
  }
  EXPECT_EQ(slurp(path), "one\ntwo\n");
}

TEST(LineFile, WritesNothingWithoutALine) {
  const Folder folder;
  { const LineFile lines(folder / "lines"); }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(IsSameFile, SeesThroughSpellingsAndLinks) {
  const Folder folder;
  const std::string file = folder.write("file", "text");
  ASSERT_EQ(symlink("file", (folder / "link").c_str()), 0);
  ASSERT_EQ(link(file.c_str(), (folder / "hard").c_str()), 0);
  for (const char* other : {"file", "./file", "link", "hard"})
    EXPECT_TRUE(isSameFile(file, folder / other)) << other;
  EXPECT_TRUE(isSameFile(folder / "new", folder / "./new"));
  EXPECT_FALSE(isSameFile(folder / "new", folder / "newer"));
  EXPECT_FALSE(isSameFile(file, folder / "new"));
  EXPECT_TRUE(isSameFile("-", "/dev/stdout"));
  EXPECT_FALSE(isSameFile("/dev/null", "/dev/null"));
}

TEST(FormatOf, StreamsWithoutAnEndingHaveTheirOwn) {
  const Folder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder / "pipe.OBJ").c_str(), 0600), 0);
  EXPECT_EQ(formatOf("-", ".ply"), ".ply");
  EXPECT_EQ(formatOf("/dev/null", ".ply"), ".ply");
  EXPECT_EQ(formatOf(folder / "pipe", ".ply"), ".ply");
  EXPECT_EQ(formatOf(folder / "pipe.OBJ", ".ply"), ".obj");
  EXPECT_EQ(formatOf(folder / "mesh", ".ply"), "");
}

TEST(ReadFile, SaysWhyItCannot) {
  const Folder folder;
  std::string bytes = "left", why;
  EXPECT_FALSE(readFile(folder / "missing", bytes, &why));
  EXPECT_TRUE(contains(why, "does not exist")) << why;
  EXPECT_TRUE(bytes.empty());
  EXPECT_FALSE(readFile(folder / "", bytes, &why));
  EXPECT_TRUE(contains(why, "folder")) << why;
  const std::string all("a\0b\n", 4);
  ASSERT_TRUE(readFile(folder.write("file", all), bytes, &why)) << why;
  EXPECT_EQ(bytes, all);
}

TEST(FullDisk, KeepsTheFileThatWasThereAndNothingElse) {
  const SmallDisk disk;
  if (!disk.ok())
    GTEST_SKIP() << "only root may have a disk of its own";
  const std::string path = disk.folder().write("file", "precious");
  std::string why;
  EXPECT_FALSE(writeFile(path, std::string(2 * SmallDisk::SIZE, 'x'), &why));
  EXPECT_TRUE(contains(why, "the disk is full")) << why;
  EXPECT_EQ(slurp(path), "precious");
  EXPECT_FALSE(writeFile(disk.folder() / "new", std::string(2 * SmallDisk::SIZE, 'x')));
  EXPECT_EQ(disk.folder().files(), 1u);
  EXPECT_TRUE(writeFile(path, std::string(SmallDisk::SIZE / 2, 'y'), &why)) << why;
}

TEST(FullDisk, LinesStayWhole) {
  const SmallDisk disk;
  if (!disk.ok())
    GTEST_SKIP() << "only root may have a disk of its own";
  const std::string path = disk.folder().write("lines", "precious");
  const std::string line(9000, 'x');
  LineFile lines(path);
  std::string why, expected;
  while (lines.append(line, &why))
    expected += line + "\n";
  EXPECT_TRUE(contains(why, "the disk is full")) << why;
  EXPECT_EQ(expected.size(), SmallDisk::SIZE / 9001 * 9001);
  EXPECT_EQ(slurp(path), expected);
  EXPECT_FALSE(lines.append(line));
  ASSERT_TRUE(lines.append("short", &why)) << why;
  EXPECT_EQ(slurp(path), expected + "short\n");
}

TEST(ReadFile, RefusesWhatStandsInTheFilesPlace) {
  const Folder folder;
  const std::string pointer = folder.write(
      "a.pcd", "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 9\n");
  const std::string page =
      folder.write("b.png", "\n <!DOCTYPE HTML><title>404</title>");
  std::string bytes = "old", why;
  EXPECT_FALSE(readFile(pointer, bytes, &why));
  EXPECT_TRUE(contains(why, "git lfs pull")) << why;
  EXPECT_TRUE(bytes.empty());
  EXPECT_FALSE(readFile(page, bytes, &why));
  EXPECT_TRUE(contains(why, "download")) << why;
  // a header that says a version is none of them
  EXPECT_TRUE(readFile(folder.write("c.pcd", "VERSION .7\n"), bytes, &why));
}
