// SPDX-License-Identifier: BSD-3-Clause
// Which reader? The contents say it, the extension only where they do not.
#include "command_line/app.h"
#include "input/lines.h"
#include "input/shape.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

bool startsWith(std::string_view bytes, std::string_view start) {
  return bytes.substr(0, start.size()) == start;
}

/** \brief Files that are often taken for point clouds. */
void refuseOtherFormats(std::string_view bytes) {
  const struct {
    std::string_view start;
    const char* name;
  } formats[] = {
      {"\xff\xfe", "UTF-16 text; save it as UTF-8"},
      {"\xfe\xff", "UTF-16 text; save it as UTF-8"},
      {"LASF", "a LAS or LAZ file; convert it to PCD, PLY or text"},
      {"ASTM-E57", "an E57 file; convert it to PCD, PLY or text"},
      {"\x89PNG", "a PNG image; pcl_sq_stereo reads images"},
      {"\xff\xd8\xff", "a JPEG image; pcl_sq_stereo reads images"},
      {"PK\x03\x04", "a zip archive; unpack it"},
      {"\x1f\x8b", "packed by gzip; unpack it"},
      {"BZh", "packed by bzip2; unpack it"},
      {"\xfd"
       "7zXZ",
       "packed by xz; unpack it"},
      {"\x28\xb5\x2f\xfd", "packed by zstd; unpack it"},
      {"\x93NUMPY",
       "an array of NumPy; pcl_sq.estimate() of the Python module takes it, or save it "
       "by numpy.savetxt"},
      {"\x89HDF", "an HDF5 file; convert it to PCD, PLY or text"},
      {"MATLAB", "a MATLAB file; save the points as text"},
      {"SQLite", "a database, perhaps a ROS 2 bag; save one cloud of it as PCD"},
      {"\x89MCAP", "a ROS 2 bag; save one cloud of it as PCD"},
      {"%PDF", "a PDF; give a point cloud"},
      {"#ROSBAG", "a ROS bag; convert it with pcl_ros bag_to_pcd"},
      {"glTF", "a glTF file; convert it to PLY, OBJ or STL"},
      {"# vtk DataFile", "a VTK file; convert it to PLY, OBJ or STL"},
      {"Kaydara FBX", "an FBX file; convert it to PLY, OBJ or STL"},
      {"ISO-10303", "a STEP file; convert it to PLY, OBJ or STL"},
      {"#VRML", "a VRML file; convert it to PLY, OBJ or STL"},
      {"<", "an XML file, such as .vtp, .dae or .x3d; convert it to PLY, OBJ or STL"},
      {"%YAML", "a YAML file; give a point cloud"},
      {"P5", "a PGM image; pcl_sq_stereo reads images"},
      {"P6", "a PPM image; pcl_sq_stereo reads images"},
      {"II*", "a TIFF image; pcl_sq_stereo reads images"},
      {"\xd4\xc3\xb2\xa1", "a network capture; save one cloud of it as PCD"},
      {"\x0a\x0d\x0d\x0a", "a network capture; save one cloud of it as PCD"},
      {"OFF", "an OFF file; convert it to PLY, OBJ or STL"}};
  for (const auto& format : formats)
    if (startsWith(bytes, format.start))
      throw Failure(std::string("it is ") + format.name);
}

/** \brief JSON is often a model where its cloud is meant. */
void refuseJson(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || bytes[first] != '{')
    return;
  if (bytes.find("\"pcl_sq/") != std::string_view::npos)
    throw Failure("it is a result of pcl_sq, a model, scene or grasps, without points; "
                  "give the cloud that it was made of");
  throw Failure("it is JSON, such as glTF; convert it to PCD, PLY, OBJ, STL or text");
}

/** \brief First word of the first line that is neither empty nor a comment. */
std::string firstWord(std::string_view bytes) {
  Lines lines(bytes);
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view word = takeWord(line);
    if (!word.empty() && word[0] != '#' && word.substr(0, 2) != "//")
      return lowered(word.substr(0, 16));
  }
  return {};
}

bool isText(std::string_view bytes) {
  constexpr std::size_t LOOKED_AT = 1000;
  return std::none_of(bytes.begin(),
                      bytes.begin() + std::ptrdiff_t(std::min(bytes.size(), LOOKED_AT)),
                      [](char c) {
                        const auto byte = static_cast<unsigned char>(c);
                        return byte < 0x20 && !(byte >= '\t' && byte <= '\r');
                      });
}

} // namespace

Shape readShape(std::string_view bytes, const std::string& extension) {
  if (startsWith(bytes, "\xef\xbb\xbf")) // a byte-order mark
    bytes.remove_prefix(3);
  if (bytes.empty())
    throw Failure("it is empty");
  const std::string word = firstWord(bytes.substr(0, 100000));
  const auto starts = [&word](std::initializer_list<const char*> words) {
    return std::any_of(
        words.begin(), words.end(), [&](const char* w) { return word == w; });
  };
  if (isBinaryStl(bytes))
    return readStl(bytes);
  if (word == "ply")
    return readPly(bytes);
  if (startsWith(bytes, "# .PCD") || starts({"version", "fields", "columns"}))
    return readPcd(bytes);
  if (word == "solid")
    return readStl(bytes);
  if (starts({"v", "vn", "vt", "vp", "f", "g", "o", "s", "mtllib", "usemtl"}))
    return readObj(bytes);
  refuseOtherFormats(bytes);
  refuseJson(bytes);
  if (extension == ".ply")
    return readPly(bytes);
  if (extension == ".pcd")
    return readPcd(bytes);
  if (extension == ".stl")
    return readStl(bytes);
  if (extension == ".obj")
    return readObj(bytes);
  if (!isText(bytes))
    throw Failure(
        "it is neither PCD, PLY, OBJ, STL nor text with three numbers a line");
  return readText(bytes);
}

} // namespace pcl_sq::app
