#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles every C++ block, and configures every CMake block, of README.md, CONTRIBUTING.md
and docs/ against an installed pcl_sq:
    snippets.py SOURCE_DIR PREFIX FOLDER CMAKE_OPTION..."""
import glob
import os
import re
import shutil
import subprocess
import sys

source, prefix, folder = (os.path.abspath(p) for p in sys.argv[1:4])
options = ["-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + prefix] + sys.argv[4:]
shutil.rmtree(folder, ignore_errors=True)


def blocks(language):
    """(where it stands, text) of each fenced block in that language."""
    for path in [source + "/README.md", source + "/CONTRIBUTING.md"] + \
            sorted(glob.glob(source + "/docs/**/*.md", recursive=True)):
        text = open(path).read()
        for found in re.finditer("^```%s\n(.*?)^```" % language, text, re.S | re.M):
            yield "%s:%d" % (os.path.relpath(path, source),
                             text.count("\n", 0, found.start()) + 1), found.group(1)


def project(name, lines, files):
    """Writes, configures and builds a project."""
    path = os.path.join(folder, name)
    os.makedirs(path)
    for file, text in dict(files, **{"CMakeLists.txt": lines}).items():
        open(os.path.join(path, file), "w").write(text)
    os.symlink(source, path + "/pcl_sq")
    for command in (["cmake", "-S", path, "-B", path + "/build"] + options,
                    # a build of everything is another test's
                    ["cmake", "--build", path + "/build", "--target",
                     "help" if "FetchContent" in lines else "all"]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True)
        if done.returncode:
            sys.exit("%s\n%s" % (lines, done.stdout))


HEAD = "cmake_minimum_required(VERSION 3.16)\nproject(user LANGUAGES C CXX)\n"
cpp, cmake = list(blocks("cpp")), list(blocks("cmake"))
if not cpp or not cmake:
    sys.exit("README.md holds no C++ or no CMake any more")
listing = HEAD + """find_package(PCL 1.12 REQUIRED COMPONENTS common io)
find_package(pcl_sq REQUIRED COMPONENTS core OPTIONAL_COMPONENTS stereo visualization)
"""
for number, (where, _) in enumerate(cpp):
    listing += """# {1}
add_library(block{0} OBJECT block{0}.cpp)
target_link_libraries(block{0} PRIVATE pcl_sq::core pcl_io)
foreach(component stereo visualization)
  if(TARGET pcl_sq::${{component}})
    target_link_libraries(block{0} PRIVATE pcl_sq::${{component}})
  endif()
endforeach()
""".format(number, where)
project("cpp", listing, {"block%d.cpp" % n: text for n, (_, text) in enumerate(cpp)})
for number, (where, text) in enumerate(cmake):
    target = "" if "add_executable" in text else "add_executable(mine mine.cpp)\n"
    project("cmake%d" % number, HEAD + "# " + where + "\n" + target + text,
            {"mine.cpp": "int main() {}\n"})
print("%d blocks of C++, %d of CMake" % (len(cpp), len(cmake)))
