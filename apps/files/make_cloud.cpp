// SPDX-License-Identifier: BSD-3-Clause
// From a file's numbers to a cloud: metres, surfaces sampled, what is missing left out.
#include "command_line/app.h"
#include "files/cloud_io.h"
#include "input/missing_points.h"
#include "input/sample_surface.h"
#include "input/shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace pcl_sq::app {

namespace {

/** \brief Middle and half size of most of the points; a few strays do not count. */
void findMiddle(const std::vector<Eigen::Vector3d>& points,
                Eigen::Vector3d& middle,
                double& half_size) {
  constexpr std::size_t LOOKED_AT = 10000;
  const std::size_t step = points.size() / LOOKED_AT + 1;
  half_size = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); i += step)
      if (!std::isnan(points[i].x()))
        values.push_back(points[i][axis]);
    if (values.empty())
      return middle.setZero(), void();
    std::sort(values.begin(), values.end());
    const double low = values[values.size() / 20];
    const double high = values[values.size() - 1 - values.size() / 20];
    middle[axis] = 0.5 * (low + high);
    half_size = std::max(half_size, 0.5 * (high - low));
  }
}

/** \brief Whole metres to take off before single precision.
 *
 * A float has 24 bits. A cloud that lies 128 times its half size away has lost seven of
 * them, and what is left is less than sensors resolve of their range (16 bits). */
Eigen::Vector3d findOffset(const std::vector<Eigen::Vector3d>& points) {
  constexpr double BITS_LOST = 128.0;
  Eigen::Vector3d middle;
  double half_size;
  findMiddle(points, middle, half_size);
  for (double& m : middle)
    m = std::abs(m) > BITS_LOST * half_size ? std::round(m) : 0.0;
  return middle;
}

/** \brief Whether a writer rounded the coordinates of a far cloud to floats: then its
 * points stand on steps that are no smaller than a hundredth of the thing.
 * \return a sentence, or nothing */
std::string coarseFloats(const std::vector<Eigen::Vector3d>& points) {
  constexpr double COARSE = 0.01;
  constexpr double FAR = 1e4; // nearer ones stand so close only where there is no thing
  Eigen::Vector3d middle;
  double half_size;
  findMiddle(points, middle, half_size);
  const double far = middle.cwiseAbs().maxCoeff();
  if (!(far >= FAR) || !std::isfinite(far))
    return {};
  const double step = std::ldexp(1.0, std::ilogb(far) - 23); // a float has 24 bits
  if (!(step >= COARSE * half_size))
    return {};
  const auto isFloat = [](double value) {
    return !std::isfinite(value) ||
           static_cast<double>(static_cast<float>(value)) == value;
  };
  for (const Eigen::Vector3d& p : points)
    if (!std::all_of(p.begin(), p.end(), isFloat))
      return {};
  char text[200];
  std::snprintf(text,
                sizeof(text),
                "its coordinates of about %.7g are in single precision, which resolves "
                "them to %.2g only; export them as doubles, or shifted to zero",
                far,
                step);
  return text;
}

/** \brief Scales to metres: a unit that the file names is the one it has. */
void toMetres(Shape& shape, CloudOptions options, LoadedCloud& loaded) {
  if (!shape.unit.empty() && shape.unit != options.unit) {
    if (!options.unit.empty())
      throw Failure("its header says that the unit is " + shape.unit + ", but --unit " +
                    options.unit +
                    " is given; leave --unit out, or correct the header");
    options.unit = shape.unit;
    if (shape.unit != "m")
      loaded.notes.push_back("the unit is " + shape.unit +
                             ", as the file's header says");
  }
  const double scale = options.scale();
  if (scale != 1.0)
    for (Eigen::Vector3d& p : shape.points)
      p *= scale;
  shape.origin *= scale;
}

void copyPoints(const Shape& shape, LoadedCloud& loaded) {
  auto& cloud = *loaded.cloud;
  cloud.resize(shape.points.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& p = cloud[i];
    p.getVector3fMap() = (shape.points[i] - loaded.offset).cast<float>();
    if (p.getVector3fMap().allFinite())
      ++loaded.finite_points;
    else
      p.x = p.y = p.z = std::numeric_limits<float>::quiet_NaN();
    if (loaded.has_color)
      p.rgba = 0xff000000U | shape.colors[i];
  }
  if (shape.height > 1) {
    cloud.width = shape.width;
    cloud.height = shape.height;
  }
  cloud.is_dense = loaded.finite_points == cloud.size();
}

void sampleFaces(Shape& shape, const CloudOptions& options, LoadedCloud& loaded) {
  for (const auto& triangle : shape.triangles)
    for (const std::uint32_t corner : triangle)
      if (!(shape.points[corner].array().abs() <= 1e9).all()) // NaN neither
        throw Failure("its vertex " + std::to_string(corner + 1) +
                      " has a coordinate that is no length in metres");
  std::vector<Eigen::Vector3d> points = sampleSurface(shape, options.samples);
  if (points.empty())
    throw Failure("its faces have no area");
  loaded.notes.push_back(std::to_string(shape.faces) + " faces sampled with " +
                         std::to_string(points.size()) + " points");
  shape = Shape();
  shape.points = std::move(points);
}

} // namespace

LoadedCloud makeCloud(Shape shape, const CloudOptions& options) {
  LoadedCloud loaded;
  loaded.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGBA>>();
  if (shape.points.empty())
    throw Failure("it holds no points");
  loaded.notes = shape.notes;
  if (std::string coarse = coarseFloats(shape.points); !coarse.empty())
    loaded.notes.push_back(std::move(coarse));
  toMetres(shape, options, loaded);
  if (!shape.triangles.empty())
    sampleFaces(shape, options, loaded);
  else
    for (const std::string& note : dropMissingPoints(shape))
      loaded.notes.push_back(note);
  loaded.has_color = !shape.colors.empty();
  loaded.offset = findOffset(shape.points);
  copyPoints(shape, loaded);
  if (loaded.finite_points == 0)
    throw Failure("all of its points are missing: not finite, or 0 0 0");
  auto& cloud = *loaded.cloud;
  // a place of 0 0 0 in a far cloud is the default: nobody knows where the sensor was
  if (!shape.origin.isZero())
    cloud.sensor_origin_.head<3>() = (shape.origin - loaded.offset).cast<float>();
  cloud.sensor_orientation_ = shape.orientation.cast<float>();
  return loaded;
}

} // namespace pcl_sq::app
