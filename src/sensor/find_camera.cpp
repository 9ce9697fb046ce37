// SPDX-License-Identifier: BSD-3-Clause
// The camera of an organized cloud in any frame. Errors of depth move points along
// their pixels' rays, so that a projection fits noisy points as well as exact ones.
#include "pcl_sq/object_view.h"

#include <Eigen/Dense>

#include <cmath>

namespace pcl_sq {

namespace {

constexpr std::size_t LOOKED_AT = 4000; ///< pixels
constexpr std::size_t FEWEST_SAMPLES = 30;
constexpr double OFF = 1.0;         ///< a pixel whose point projects farther away [px]
constexpr double MAX_SHARE = 0.05;  ///< of such pixels in a pinhole image
constexpr double MAX_SKEW = 0.02;   ///< of the image's axes, over the focal length
constexpr double MAX_ASPECT = 1.25; ///< of pixels, and its inverse
constexpr double TINY = 1e-9;       ///< second smallest singular value over the largest

struct Sample {
  Eigen::Vector2d pixel;
  Eigen::Vector3d point;
};

/** \brief Pixels spread over the image, without the pattern of a stride. */
std::vector<Sample> samplesOf(const CloudPoints& points, int width) {
  std::vector<Sample> samples;
  const auto total = static_cast<std::uint64_t>(points.cols());
  // steps of the golden ratio visit every part of the image about equally often
  const auto count = std::min<std::uint64_t>(total, 4 * LOOKED_AT);
  for (std::uint64_t k = 0; k < count && samples.size() < LOOKED_AT; ++k) {
    const double turn = 0.6180339887498949 * double(k);
    const auto c =
        count == total
            ? Eigen::Index(k)
            : Eigen::Index((turn - std::floor(turn)) * double(total)) % points.cols();
    if (points.col(c).allFinite())
      samples.push_back({{double(c % width), double(c / width)}, // NOLINT
                         points.col(c).cast<double>()});
  }
  return samples;
}

/** \brief Similarity that gives points mean 0 and deviation 1, which keeps the linear
 * equations well conditioned. */
template <int N>
Eigen::Matrix<double, N + 1, N + 1>
normaliser(const std::vector<Eigen::Matrix<double, N, 1>>& points) {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  for (const auto& p : points)
    mean += p / double(points.size());
  double square = 0.0;
  for (const auto& p : points)
    square += (p - mean).squaredNorm() / double(N * points.size());
  const double scale = 1.0 / std::sqrt(std::max(square, 1e-300));
  Eigen::Matrix<double, N + 1, N + 1> t =
      Eigen::Matrix<double, N + 1, N + 1>::Identity();
  t.template topLeftCorner<N, N>() *= scale;
  t.template topRightCorner<N, 1>() = -scale * mean;
  return t;
}

/** \brief The 3 x (N + 1) matrix that takes homogeneous sources to pixels up to scale,
 * by the direct linear transform. \return false if the sources leave it open */
template <int N>
bool solveProjection(const std::vector<Eigen::Matrix<double, N, 1>>& sources,
                     const std::vector<Eigen::Vector2d>& pixels,
                     Eigen::Matrix<double, 3, N + 1>& projection) {
  constexpr int SIZE = 3 * (N + 1);
  const auto from = normaliser<N>(sources);
  const auto to = normaliser<2>(pixels);
  Eigen::Matrix<double, SIZE, SIZE> square = Eigen::Matrix<double, SIZE, SIZE>::Zero();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Eigen::Matrix<double, N + 1, 1> s = from * sources[i].homogeneous();
    const Eigen::Vector3d p = to * pixels[i].homogeneous();
    Eigen::Matrix<double, SIZE, 2> rows = Eigen::Matrix<double, SIZE, 2>::Zero();
    for (int k = 0; k < 2; ++k) {
      rows.template block<N + 1, 1>(k * (N + 1), k) = s;
      rows.template block<N + 1, 1>(2 * (N + 1), k) = -p[k] * s;
    }
    square.template selfadjointView<Eigen::Lower>().rankUpdate(rows);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, SIZE, SIZE>> eigen(square);
  const auto& values = eigen.eigenvalues();
  if (eigen.info() != Eigen::Success || !(values[1] > TINY * TINY * values[SIZE - 1]))
    return false;
  Eigen::Matrix<double, 3, N + 1> m;
  for (int row = 0; row < 3; ++row)
    m.row(row) =
        eigen.eigenvectors().col(0).template segment<N + 1>(row * (N + 1)).transpose();
  projection = to.inverse() * m * from;
  return projection.allFinite();
}

/** \brief Splits the left 3 x 3 of a projection into intrinsics and rotation.
 * \return false if its pixels are not square, as no camera's are */
bool decompose(Eigen::Matrix3d m, PinholeCamera& camera) {
  if (!(std::abs(m.determinant()) > 0.0))
    return false;
  if (m.determinant() < 0.0) // the scale's sign is open; a camera is right-handed
    m = -m;
  // m = K R with K upper triangular: rows of R from the last one up
  const double scale = m.row(2).norm();
  m /= scale;
  Eigen::Matrix3d r;
  r.row(2) = m.row(2);
  camera.cy = m.row(1).dot(r.row(2));
  const Eigen::RowVector3d y = m.row(1) - camera.cy * r.row(2);
  camera.fy = y.norm();
  r.row(1) = y / camera.fy;
  camera.cx = m.row(0).dot(r.row(2));
  const double skew = m.row(0).dot(r.row(1));
  const Eigen::RowVector3d x = m.row(0) - camera.cx * r.row(2) - skew * r.row(1);
  camera.fx = x.norm();
  r.row(0) = x / camera.fx;
  camera.rotation = r.transpose();
  return camera.isValid() && std::abs(skew) < MAX_SKEW * camera.fy &&
         camera.fx < MAX_ASPECT * camera.fy && camera.fy < MAX_ASPECT * camera.fx &&
         camera.rotation.determinant() > 0.0;
}

/** \brief Whether the points lie before the camera and project to their pixels. */
bool explains(const PinholeCamera& camera, const std::vector<Sample>& samples) {
  std::size_t off = 0;
  for (const Sample& s : samples)
    off += !(camera.depthOf(s.point) > 0.0) ||
           !((camera.project(s.point) - s.pixel).cwiseAbs().maxCoeff() <= OFF);
  return double(off) < MAX_SHARE * double(samples.size());
}

/** \brief The camera at a known place: pixels are a homography of the rays. */
bool cameraAt(const Eigen::Vector3d& place,
              const std::vector<Sample>& samples,
              PinholeCamera& camera) {
  // rays as points of a plane across their middle
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Sample& s : samples)
    middle += (s.point - place).normalized();
  if (!(middle.norm() > 1e-6))
    return false;
  Eigen::Matrix3d turn;
  turn.row(2) = middle.normalized().transpose();
  turn.row(0) = Eigen::Vector3d(turn.row(2)).unitOrthogonal().transpose();
  turn.row(1) = turn.row(2).cross(turn.row(0));
  std::vector<Eigen::Vector2d> rays, pixels;
  for (const Sample& s : samples) {
    const Eigen::Vector3d d = turn * (s.point - place);
    if (!(d.z() > 0.0))
      return false;
    rays.push_back(d.head<2>() / d.z());
    pixels.push_back(s.pixel);
  }
  Eigen::Matrix3d projection;
  if (!solveProjection<2>(rays, pixels, projection) ||
      !decompose(projection * turn, camera))
    return false;
  camera.center = place;
  return explains(camera, samples);
}

/** \brief The camera where nothing is known of it. */
bool cameraAnywhere(const std::vector<Sample>& samples, PinholeCamera& camera) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const Sample& s : samples) {
    points.push_back(s.point);
    pixels.push_back(s.pixel);
  }
  Eigen::Matrix<double, 3, 4> projection;
  if (!solveProjection<3>(points, pixels, projection))
    return false;
  const Eigen::Matrix3d m = projection.leftCols<3>();
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(m);
  if (!lu.isInvertible() || !decompose(m, camera))
    return false;
  camera.center = lu.solve(-projection.col(3));
  return camera.isValid() && explains(camera, samples);
}

} // namespace

bool findCamera(const CloudPoints& points,
                int width,
                int height,
                const std::optional<Eigen::Vector3d>& viewpoint,
                PinholeCamera& camera) {
  if (findIntrinsics(points, width, height, camera))
    return true;
  const std::vector<Sample> samples = samplesOf(points, width);
  if (samples.size() < FEWEST_SAMPLES)
    return false;
  camera = {};
  return (viewpoint && cameraAt(*viewpoint, samples, camera)) ||
         cameraAnywhere(samples, camera) ||
         cameraAt(Eigen::Vector3d::Zero(), samples, camera);
}

} // namespace pcl_sq
