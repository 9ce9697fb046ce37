// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file_bytes.h"

#include <pcl/io/lzf.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::test {

/** \brief A small file of each format that is read, with its extension. */
inline std::vector<std::pair<std::string, std::string>> smallClouds() {
  const std::string pcd =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb _ label\nSIZE 4 4 4 4 1 2\nTYPE F F "
      "F "
      "F U U\nCOUNT 1 1 1 1 3 1\nWIDTH 4\nHEIGHT 2\nVIEWPOINT 0 0 1 1 0 0 0\nPOINTS "
      "8\nDATA ";
  std::string lines, points, columns[3];
  for (int i = 0; i < 8; ++i) {
    const float v[] = {0.1f * float(i), 0.01f * float(i * i), 1.0f};
    for (const float value : v) {
      lines += std::to_string(value) + " ";
      points += bytesOf(value);
    }
    lines += "1.6e-38 0 0 0 17\n";
    points += bytesOf(1.6e-38f) + "abc" + bytesOf(std::uint16_t(17));
    for (int axis = 0; axis < 3; ++axis)
      columns[axis] += bytesOf(1.0f);
  }
  const std::string unpacked = columns[0] + columns[1] + columns[2];
  std::string packed(200, '\0');
  packed.resize(pcl::lzfCompress(unpacked.data(),
                                 static_cast<unsigned>(unpacked.size()),
                                 packed.data(),
                                 static_cast<unsigned>(packed.size())));
  const std::string compressed =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 8\nHEIGHT "
      "1\nPOINTS 8\nDATA binary_compressed\n" +
      bytesOf(static_cast<std::uint32_t>(packed.size())) +
      bytesOf(static_cast<std::uint32_t>(unpacked.size())) + packed;

  const std::string ply_elements =
      "comment c\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 3\nproperty "
      "double x\nproperty short y\nproperty float z\nproperty uchar red\nproperty "
      "uchar "
      "green\nproperty uchar blue\nproperty list uchar int views\nelement face "
      "1\nproperty list uchar int vertex_indices\n";
  const std::string grid = "element range_grid 4\nproperty list uchar int v\n";
  const std::string camera =
      "element camera 1\nproperty float view_px\nproperty float "
      "x_axisx\nproperty int viewportx\nproperty int viewporty\n";
  const std::string ply = "ply\nformat ascii 1.0\n" + ply_elements + camera +
                          "end_header\n1 2 3\n1 2 3 0\n4 5 6 7 8 9 2 0 1\n-1 2 4 0 0 0 "
                          "1 0\n3 0 1 2\n0 1 3 1\n";
  const std::string grid_ply = "ply\nformat ascii 1.0\n" + ply_elements + grid +
                               "end_header\n1 2 3 1 2 3 0\n4 5 6 7 8 9 0\n-1 2 4 0 0 0 "
                               "0\n0\n1 0\n0\n1 1\n1 2\n";
  std::string big =
      "ply\nformat binary_big_endian 1.0\n" + ply_elements + "end_header\n";
  std::string plain =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty "
      "float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 3; ++i) {
    const float z = i == 1 ? 1.0f : 2.0f;
    big += bytesOf(double(i), true) + bytesOf(std::int16_t(i * i), true) +
           bytesOf(z, true) + "abc\1" + bytesOf(7, true);
    plain += bytesOf(float(i)) + bytesOf(float(i * i)) + bytesOf(z);
  }
  big += "\3" + bytesOf(0, true) + bytesOf(1, true) + bytesOf(2, true);

  std::string stl = std::string(80, ' ') + bytesOf(1U) + std::string(12, '\0');
  for (int i = 0; i < 9; ++i)
    stl += bytesOf(float(i * i));
  stl += "ab";
  return {
      {pcd + "ascii\n" + lines, ".pcd"},
      {pcd + "binary\n" + points, ".pcd"},
      {compressed, ".pcd"},
      {ply, ".ply"},
      {grid_ply, ".ply"},
      {big, ".ply"},
      {plain, ".ply"},
      {"v 0 0 0 1 0 1\nv 1 0 0 1 0 1\nv 0 1 0 1 0 1\nf 1/2/3 2//4 -1\n", ".obj"},
      {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex "
       "0 1e-1 0\nendloop\nendfacet\nendsolid\n",
       ".stl"},
      {stl, ".stl"},
      {"//X;Y;Z;Rf;Gf;Bf\n3\n1;2;3;0;1;.5\n4;5;6;0;0;0\n0;1;2;1;1;1\n", ".asc"},
      {"1 2 3 255 0 1\n0.5\t.1 7 2 3 4\nnan nan nan 0 0 0\n", ".xyz"},
      {"z,y,id,x\n1.5,2,a,3\n4,5,b,6e3\n7,,c,9\n", ".csv"}};
}

} // namespace pcl_sq::test
