// SPDX-License-Identifier: BSD-3-Clause
// The support function of a superquadric with a taper, a rim or a bend (M3), by slices.
#include "geometry/bend.h"
#include "geometry/taper.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int SLICES = 16;            ///< of the search, equal angles from pole to pole
constexpr int SLICE_REFINEMENTS = 24; ///< golden sections of the best two slices

/** \brief The body cut at a latitude eta, up to that of its rim: z = a3 sin^e1(eta),
 * the section scaled by cos^e1(eta) and the taper. In a direction n of the own frame,
 * h = max over eta of n_z z + cos^e1(eta) |(n_x a1 f_x, n_y a2 f_y)|_p with
 * p = 2 / (2 - e2), the dual norm of the section's |.|_(2 / e2). */
class Slices {
public:
  Slices(const Superquadric& s, const Eigen::Vector3d& local)
      : s_(s), n_(local), e2_(std::min(s.epsilon2, MAX_SECTION)), p_(2.0 / (2.0 - e2_)),
        top_(s.isCut() ? latitudeOf(s) : M_PI_2) {}

  struct Slice {
    double sine, cosine; ///< of eta
    double height;       ///< z / a3
    double scale;        ///< cos^e1(eta)
    double fx, fy;       ///< growth
    double norm;         ///< the section's reach, not scaled
    double u, v;         ///< |n_x| a1 f_x, |n_y| a2 f_y
    double reach;
  };
  Slice at(double eta) const {
    Slice c;
    const Eigen::Vector3d& a = s_.semi_axes;
    c.sine = std::sin(eta);
    c.cosine = std::max(std::cos(eta), 0.0);
    c.height = std::copysign(std::pow(std::abs(c.sine), s_.epsilon1), c.sine);
    c.scale = std::pow(c.cosine, s_.epsilon1);
    c.fx = 1.0 + s_.kx * c.height;
    c.fy = 1.0 + s_.ky * c.height;
    c.u = std::abs(n_.x()) * a.x() * c.fx;
    c.v = std::abs(n_.y()) * a.y() * c.fy;
    const double larger = std::max(c.u, c.v), smaller = std::min(c.u, c.v);
    c.norm = larger > 0.0
                 ? larger * std::pow(1.0 + std::pow(smaller / larger, p_), 1.0 / p_)
                 : 0.0;
    c.reach = n_.z() * a.z() * c.height + c.scale * c.norm;
    return c;
  }
  /** \brief The slice that reaches farthest. A tapered body need not be convex: the
   * reach may have several maxima. */
  Slice farthest() const {
    const double step = (top_ + M_PI_2) / SLICES;
    double best = -M_PI_2, most = at(best).reach;
    for (int i = 1; i <= SLICES; ++i) {
      const double eta = -M_PI_2 + i * step, reach = at(eta).reach;
      if (reach > most) {
        most = reach;
        best = eta;
      }
    }
    constexpr double GOLDEN = 0.6180339887498949;
    double low = std::max(best - step, -M_PI_2), high = std::min(best + step, top_);
    double left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
    double at_left = at(left).reach, at_right = at(right).reach;
    for (int i = 0; i < SLICE_REFINEMENTS; ++i) {
      if (at_left > at_right) {
        high = right;
        right = left;
        at_right = at_left;
        left = high - GOLDEN * (high - low);
        at_left = at(left).reach;
      } else {
        low = left;
        left = right;
        at_left = at_right;
        right = low + GOLDEN * (high - low);
        at_right = at(right).reach;
      }
    }
    const Slice refined = at(0.5 * (low + high));
    return refined.reach > most ? refined : at(best);
  }
  /** \brief Shares cos^2, sin^2 of the angle in the section at which it touches. */
  Eigen::Vector2d shares(const Slice& c) const {
    const double larger = std::max(c.u, c.v);
    if (!(larger > 0.0))
      return {0.5, 0.5};
    const double x = std::pow(c.u / larger, p_), y = std::pow(c.v / larger, p_);
    return Eigen::Vector2d(x, y) / (x + y);
  }
  /** \brief The point that touches, in the own frame. */
  Eigen::Vector3d touching(const Slice& c) const {
    const Eigen::Vector3d& a = s_.semi_axes;
    const Eigen::Vector2d share = shares(c);
    return {
        std::copysign(std::pow(share.x(), 0.5 * e2_), n_.x()) * c.scale * a.x() * c.fx,
        std::copysign(std::pow(share.y(), 0.5 * e2_), n_.y()) * c.scale * a.y() * c.fy,
        a.z() * c.height};
  }

private:
  /** \brief That of the rim. */
  static double latitudeOf(const Superquadric& s) {
    const double rim = s.rimHeight();
    return std::copysign(std::asin(std::pow(std::abs(rim), 1.0 / s.epsilon1)), rim);
  }

  const Superquadric& s_;
  Eigen::Vector3d n_;
  double e2_, p_;
  double top_; ///< latitude of the last slice
};

double logOrZero(double x) {
  return x > 0.0 ? std::log(x) : 0.0;
}

} // namespace

BodyRow supportRow(const Superquadric& s,
                   const BentSupport& slices,
                   const Eigen::Vector3d& normal,
                   Eigen::Vector3d* unbent) {
  const Eigen::Vector3d n = s.rotation.transpose() * normal;
  const BentContact c = slices.contact(n);
  if (unbent)
    *unbent = c.unbent;
  const BentFrame frame = bentFrame(s, c.unbent.z());
  // what the direction is before bending, times how far the body reaches there
  Eigen::Vector3d along = frame.axes.transpose() * n;
  along.z() *= fibre(s, c.unbent);
  along = along.cwiseProduct(c.unbent).eval();
  const double height = c.unbent.z() / s.semi_axes.z();
  const double log_sine = logOrZero(std::abs(c.sine));
  const double fx = 1.0 + s.kx * height, fy = 1.0 + s.ky * height;
  const double growth = along.x() * s.kx / fx + along.y() * s.ky / fy;
  BodyRow row;
  row.value = normal.dot(s.center) + c.reach;
  row.derivatives.head<3>() = n;
  row.derivatives.segment<3>(3) = c.at.cross(n);
  row.derivatives.segment<3>(6) = along;
  row.derivatives[9] = (along.z() + growth * height) * log_sine +
                       (along.x() + along.y()) * logOrZero(c.cosine);
  row.derivatives[10] =
      0.5 * (along.x() * logOrZero(c.shares.x()) + along.y() * logOrZero(c.shares.y()));
  row.derivatives[11] = along.x() * height / fx;
  row.derivatives[12] = along.y() * height / fy;
  return row;
}

BodyRow supportRow(const Superquadric& s,
                   const Eigen::Vector3d& normal,
                   Eigen::Vector3d* unbent) {
  const Eigen::Vector3d n = s.rotation.transpose() * normal;
  BodyRow row;
  if (s.isPlain()) { // in closed form
    row.derivatives.head<11>() = s.supportJacobian(normal, row.value);
    row.value += normal.dot(s.center);
    const Eigen::Vector3d p = s.toLocal(s.supportPoint(normal));
    const double height = p.z() / s.semi_axes.z();
    row.derivatives[11] = n.x() * p.x() * height;
    row.derivatives[12] = n.y() * p.y() * height;
    return row;
  }
  if (s.isBent())
    return supportRow(s, BentSupport(s), normal, unbent);
  const Slices slices(s, n);
  const Slices::Slice c = slices.farthest();
  const Eigen::Vector3d touching = slices.touching(c);
  const Eigen::Vector3d along = n.cwiseProduct(touching);
  const Eigen::Vector2d share = slices.shares(c);
  row.value = normal.dot(s.center) + along.sum();
  row.derivatives.head<3>() = n;
  row.derivatives.segment<3>(3) = touching.cross(n);
  row.derivatives.segment<3>(6) = along;
  // eta and the angle in the section are held; the section grows with the height
  const double log_sine = logOrZero(std::abs(c.sine));
  const double growth = along.x() * s.kx / c.fx + along.y() * s.ky / c.fy;
  row.derivatives[9] = (along.z() + growth * c.height) * log_sine +
                       (along.x() + along.y()) * logOrZero(c.cosine);
  row.derivatives[10] =
      0.5 * (along.x() * logOrZero(share.x()) + along.y() * logOrZero(share.y()));
  row.derivatives[11] = along.x() * c.height / c.fx;
  row.derivatives[12] = along.y() * c.height / c.fy;
  return row;
}

double slicedSupport(const Superquadric& s, const Eigen::Vector3d& local) {
  return s.isBent() ? BentSupport(s).contact(local).reach
                    : Slices(s, local).farthest().reach;
}

Eigen::Vector3d slicedSupportPoint(const Superquadric& s,
                                   const Eigen::Vector3d& local) {
  if (s.isBent())
    return BentSupport(s).contact(local).at;
  const Slices slices(s, local);
  return slices.touching(slices.farthest());
}

} // namespace pcl_sq::detail
