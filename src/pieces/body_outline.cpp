// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/body_outline.h"

#include "geometry/bend.h"
#include "geometry/open_body.h"
#include "pcl_sq/line_intersection.h"
#include "tuning/parts_tuning.h"

namespace pcl_sq::detail {

namespace {

using tuning::free_space::OUTLINE_PLANES;

/** \brief The support function of one body in many directions: what a taper, a bend or
 * a rim needs of tables is made once. */
class Supports {
public:
  explicit Supports(const Superquadric& body) : body_(body) {
    if (body.isBent())
      bent_.emplace_back(body);
    else if (body.isCut() && isRound(body))
      addRings();
  }

  /** \param[in] directions of unit length \param[out] reach beyond the centre */
  void operator()(const std::vector<Eigen::Vector3d>& directions,
                  std::vector<double>& reach) const {
    reach.resize(directions.size());
    if (!body_.isBent() && !body_.isCut()) {
      byKernels(directions, reach);
      return;
    }
    for (std::size_t i = 0; i < directions.size(); ++i)
      reach[i] = one(directions[i]);
  }

private:
  double one(const Eigen::Vector3d& direction) const {
    if (!bent_.empty())
      return bent_.front().contact(body_.rotation.transpose() * direction).reach;
    if (rings_.empty())
      return body_.support(direction);
    const double along = body_.rotation.col(2).dot(direction);
    const double across = std::sqrt(std::max(1.0 - along * along, 0.0));
    double most = -1e300;
    for (const Eigen::Vector2d& ring : rings_)
      most = std::max(most, across * ring.x() + along * ring.y());
    return most;
  }

  void byKernels(const std::vector<Eigen::Vector3d>& directions,
                 std::vector<double>& reach) const {
    using kernels::BLOCK;
    alignas(64) float x[BLOCK] = {}, y[BLOCK] = {}, z[BLOCK] = {}, none[BLOCK] = {},
                      one[BLOCK] = {}, least[BLOCK] = {};
    alignas(64) float rows[kernels::TAPERED_ROWS][BLOCK];
    const Superquadric own = atOrigin();
    for (std::size_t begin = 0; begin < directions.size(); begin += BLOCK) {
      const std::size_t size = std::min(BLOCK, directions.size() - begin);
      for (std::size_t i = 0; i < size; ++i) {
        x[i] = float(directions[begin + i].x());
        y[i] = float(directions[begin + i].y());
        z[i] = float(directions[begin + i].z());
        one[i] = 1.0F;
        least[i] = -1e30F;
      }
      kernels::kernels().taperedRows(
          {x, y, z, none, one, least, none, size}, toShape(own), rows);
      for (std::size_t i = 0; i < size; ++i)
        reach[begin + i] = unit() * double(rows[kernels::TAPERED_PARAMETERS][i]);
    }
  }

  double unit() const { return body_.semi_axes.maxCoeff(); }
  /** \brief The body about the origin, of size one, as the kernels want it. */
  Superquadric atOrigin() const {
    Superquadric own = body_;
    own.center.setZero();
    own.semi_axes /= unit();
    return own;
  }

  /** \brief Radius and height of a solid of revolution up to its rim, near enough to
   * each other for their hull to be the body's to a ten-thousandth. */
  void addRings() {
    constexpr int RINGS = 96;
    const double top = latitudeOf(body_, body_.rimHeight());
    for (int i = 0; i <= RINGS; ++i) {
      const double eta = -M_PI_2 + (top + M_PI_2) * i / RINGS;
      const double height =
          std::copysign(std::pow(std::abs(std::sin(eta)), body_.epsilon1), eta);
      const double scale = std::pow(std::max(std::cos(eta), 0.0), body_.epsilon1);
      rings_.emplace_back(body_.semi_axes.x() * (1.0 + body_.kx * height) * scale,
                          body_.semi_axes.z() * height);
    }
  }

  const Superquadric& body_;
  std::vector<BentSupport> bent_; ///< one where the body is bent
  std::vector<Eigen::Vector2d> rings_;
};

} // namespace

BodyOutline::BodyOutline(const Superquadric& body,
                         const Eigen::Vector3d& eye,
                         int planes) {
  constexpr int ROUNDS = 4;
  const Eigen::Vector3d towards = body.center - eye;
  const double distance = towards.norm();
  const double nearest = distance - body.halfSizes().norm();
  if (!(nearest > 0.0))
    return;
  const Eigen::Vector3d ahead = towards / distance, right = ahead.unitOrthogonal(),
                        down = ahead.cross(right);
  std::vector<Eigen::Vector3d> sides, normals;
  for (int k = 0; k < planes; ++k) {
    const double angle = 2.0 * M_PI * k / planes;
    sides.emplace_back(std::cos(angle) * right + std::sin(angle) * down);
  }
  normals = sides;
  const Supports supports(body);
  std::vector<double> reach, sines(sides.size());
  for (int round = 0; round < ROUNDS; ++round) {
    supports(normals, reach);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const double sine = sines[k] = std::min(reach[k] / distance, 0.9);
      normals[k] = std::sqrt(1.0 - sine * sine) * sides[k] - sine * ahead;
    }
  }
  supports(normals, reach);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const double beyond = reach[k] - sines[k] * distance;
    planes_.push_back({normals[k], std::max(beyond, 0.0) / nearest});
  }
}

RayTest::RayTest(const Superquadric& body, const Eigen::Vector3d& eye)
    : body_(body), eye_(eye), outline_(body, eye, OUTLINE_PLANES) {}

bool RayTest::hits(const Eigen::Vector3d& ray) const {
  if (outline_.misses(ray))
    return false;
  const double abreast = ray.dot(body_.center - eye_);
  if (abreast > 0.0 && body_.gauge(eye_ + abreast * ray) <= 1.0)
    return true;
  return meetsRay(body_, eye_, ray);
}

} // namespace pcl_sq::detail
