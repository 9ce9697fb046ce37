// SPDX-License-Identifier: BSD-3-Clause
// Clouds that pcl_sq_fit is given, and how it refuses.
#pragma once

#include "bottle_view.h"
#include "program.h"

#include <sstream>
#include <string>
#include <vector>

namespace pcl_sq::test {

/** \brief The bottle as an ASCII PCD. */
inline std::string bottlePcd(std::size_t points = 4000) {
  const Eigen::Matrix3Xd cloud = visiblePoints(bottle(), points, 0.0005);
  std::ostringstream text;
  const std::string n = std::to_string(cloud.cols());
  text << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << n
       << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << n << "\nDATA ascii\n"
       << cloud.transpose() << "\n";
  return text.str();
}

/** \brief Points as an ASCII PCD. */
inline std::string pcdOf(const std::vector<Eigen::Vector3f>& points) {
  std::ostringstream text;
  text << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
       << points.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << points.size() << "\nDATA ascii\n";
  for (const Eigen::Vector3f& p : points)
    text << p.x() << " " << p.y() << " " << p.z() << "\n";
  return text.str();
}

/** \brief The program refuses and leaves nothing behind. */
inline void
expectRefusal(const Folder& folder, std::vector<std::string> arguments, int code = 1) {
  arguments.insert(arguments.end(), {"-o", folder / "model.json"});
  expectRefusal("pcl_sq_fit", arguments, code, "", &folder);
}

} // namespace pcl_sq::test
