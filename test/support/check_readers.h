// SPDX-License-Identifier: BSD-3-Clause
// What must hold for any bytes that are given for a cloud or a mesh.
#pragma once

#include "command_line/app.h"
#include "files/cloud_io.h"
#include "input/shape.h"
#include "scene/mesh_reader.h"

#include <cmath>
#include <string>

namespace pcl_sq::test {

/** \brief What is wrong with a reader's result; empty if nothing is. A Failure is
 * right, if it says something. */
template <typename Read>
std::string complaintOf(Read read) {
  try {
    return read();
  } catch (const app::Failure& failure) {
    return *failure.what() == '\0' ? "refused without a word" : "";
  } catch (const std::exception& error) {
    return std::string("an exception that is no Failure: ") + error.what();
  }
}

/** \brief Reads bytes as a cloud. */
inline std::string complaintOfCloud(std::string_view bytes,
                                    const std::string& extension) {
  return complaintOf([&]() -> std::string {
    app::Shape shape = app::readShape(bytes, extension);
    const std::size_t count = shape.points.size();
    if (!shape.colors.empty() && shape.colors.size() != count)
      return "colours of some points";
    if (shape.height > 1 && std::size_t(shape.width) * shape.height != count)
      return "an image of another size";
    app::CloudOptions options;
    options.samples = 100;
    const app::LoadedCloud loaded = app::makeCloud(std::move(shape), options);
    std::size_t finite = 0;
    for (const auto& p : *loaded.cloud) {
      const bool good = p.getVector3fMap().allFinite();
      if (!good && !std::isnan(p.x))
        return "a point that is neither finite nor marked";
      finite += good;
    }
    if (finite != loaded.finite_points || finite == 0)
      return "a wrong number of finite points";
    return loaded.offset.allFinite() ? "" : "an offset that is not finite";
  });
}

/** \brief Reads bytes as a mesh. */
inline std::string complaintOfMesh(std::string_view bytes,
                                   const std::string& extension) {
  return complaintOf([&]() -> std::string {
    const TriangleMesh mesh = app::makeMesh(app::readShape(bytes, extension));
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= mesh.vertices.size())
          return "a corner that does not exist";
    for (const Eigen::Vector3d& v : mesh.vertices)
      if (!v.allFinite())
        return "a vertex that is not finite";
    return mesh.triangles.empty() ? "a mesh without triangles" : "";
  });
}

} // namespace pcl_sq::test
