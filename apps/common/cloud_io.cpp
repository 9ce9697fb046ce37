// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_io.h"

#include "app.h"
#include "files.h"
#include "header_check.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace pcl_sq::app {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZRGBA>;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Failure("cannot read '" + path + "': " + what + ".");
}

bool hasField(const pcl::PCLPointCloud2& blob, const std::string& name) {
  for (const auto& field : blob.fields)
    if (field.name == name)
      return true;
  return false;
}

/** \brief Text with three numbers in front of each line, or behind a leading "v". */
Cloud::Ptr parseText(const std::string& path, bool wavefront) {
  std::istringstream lines(readInput(path));
  auto cloud = pcl::make_shared<Cloud>();
  std::string line;
  std::size_t number = 0;
  while (std::getline(lines, line)) {
    ++number;
    const char* at = line.c_str();
    if (wavefront) {
      if (line.size() < 2 || line[0] != 'v' || (line[1] != ' ' && line[1] != '\t'))
        continue;
      ++at;
    } else if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#')
      continue;
    pcl::PointXYZRGBA p;
    for (float& value : p.data) {
      if (&value == &p.data[3])
        break;
      char* end = nullptr;
      value = std::strtof(at, &end);
      if (end == at)
        fail(path, "line " + std::to_string(number) + " does not hold three numbers");
      at = *end == ',' || *end == ';' ? end + 1 : end;
    }
    cloud->push_back(p);
  }
  return cloud;
}

void readBlob(const std::string& path, LoadedCloud& loaded, bool ply) {
  const std::string wrong = ply ? checkPlyHeader(path) : checkPcdHeader(path);
  if (!wrong.empty())
    fail(path, wrong);
  pcl::PCLPointCloud2 blob;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  int version = 0;
  const int status =
      ply ? pcl::PLYReader().read(path, blob, origin, orientation, version)
          : pcl::PCDReader().read(path, blob, origin, orientation, version);
  if (status < 0)
    fail(path, "its contents do not match its header");
  for (const char* axis : {"x", "y", "z"})
    if (!hasField(blob, axis))
      fail(path, std::string("it has no field '") + axis + "'");
  loaded.has_color = hasField(blob, "rgb") || hasField(blob, "rgba");
  if (loaded.has_color)
    pcl::fromPCLPointCloud2(blob, *loaded.cloud);
  else {
    pcl::PointCloud<pcl::PointXYZ> plain;
    pcl::fromPCLPointCloud2(blob, plain);
    blob = {};
    pcl::copyPointCloud(plain, *loaded.cloud);
  }
  loaded.cloud->sensor_origin_ = origin;
  loaded.cloud->sensor_orientation_ = orientation;
}

} // namespace

LoadedCloud loadCloud(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    fail(path, "the file does not exist");
  if (std::filesystem::is_directory(path, error))
    fail(path, "it is a folder");
  LoadedCloud loaded;
  loaded.cloud = pcl::make_shared<Cloud>();
  const std::string extension = extensionOf(path);
  try {
    if (extension == ".pcd" || extension == ".ply")
      readBlob(path, loaded, extension == ".ply");
    else if (extension == ".obj")
      loaded.cloud = parseText(path, true);
    else if (extension == ".xyz" || extension == ".txt")
      loaded.cloud = parseText(path, false);
    else
      fail(path, "its extension is none of .pcd, .ply, .obj, .xyz and .txt");
  } catch (const Failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    fail(path, e.what());
  }
  const bool organized = loaded.cloud->isOrganized();
  for (auto& p : *loaded.cloud) {
    // depth cameras mark missing pixels as NaN or as the origin; both become NaN
    const bool missing = !std::isfinite(p.x) || !std::isfinite(p.y) ||
                         !std::isfinite(p.z) ||
                         (organized && p.x == 0 && p.y == 0 && p.z == 0);
    if (missing)
      p.x = p.y = p.z = std::numeric_limits<float>::quiet_NaN();
    else
      ++loaded.finite_points;
  }
  loaded.cloud->is_dense = loaded.finite_points == loaded.cloud->size();
  if (loaded.cloud->empty())
    fail(path, "it holds no points");
  if (loaded.finite_points == 0)
    fail(path, "all of its points are NaN or infinite");
  return loaded;
}

} // namespace pcl_sq::app
