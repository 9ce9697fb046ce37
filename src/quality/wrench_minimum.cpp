// SPDX-License-Identifier: BSD-3-Clause
// Every wrench s of the cones bounds the support function from below by s . w, with
// equality where s is extreme. A bundle of such wrenches is a polyhedral model of it;
// its minimum near the current direction is the next one.
#include "quality/wrench_minimum.h"

#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int MAX_STEPS = 150;
constexpr std::size_t MAX_BUNDLE = 16;
constexpr int SWEEPS = 40; ///< of the small dual problem

/** \brief Weights in the simplex that minimise t/2 |sum l_j p_j|^2 - sum l_j c_j, by
 * moving weight between the worst and the best pair. */
Eigen::VectorXd dualWeights(const Eigen::Matrix<double, 6, Eigen::Dynamic>& p,
                            const Eigen::VectorXd& c,
                            double t) {
  Eigen::Index best;
  c.maxCoeff(&best);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(c.size());
  weights[best] = 1.0;
  Wrench sum = p.col(best);
  for (int sweep = 0; sweep < SWEEPS; ++sweep) {
    const Eigen::VectorXd slope = t * (p.transpose() * sum) - c;
    Eigen::Index to, from = -1;
    slope.minCoeff(&to);
    for (Eigen::Index j = 0; j < slope.size(); ++j)
      if (weights[j] > 0.0 && (from < 0 || slope[j] > slope[from]))
        from = j;
    const Wrench move = p.col(to) - p.col(from);
    const double gain = slope[from] - slope[to];
    if (gain <= 1e-12)
      break;
    const double curvature = t * move.squaredNorm();
    const double by =
        std::min(weights[from], curvature > 0.0 ? gain / curvature : weights[from]);
    weights[to] += by;
    weights[from] -= by;
    sum += by * move;
  }
  return weights;
}

} // namespace

Wrench Cone::farthest(const Wrench& d) const {
  // d . w = g . f + torque (d_t . n) with g = d_f + d_t x r
  const Eigen::Vector3d turning = d.tail<3>();
  const Eigen::Vector3d g = d.head<3>() + turning.cross(r);
  const Eigen::Vector3d across = g - n * n.dot(g);
  const double spin = turning.dot(n);
  const double length = std::sqrt(friction * friction * across.squaredNorm() +
                                  torsion * torsion * spin * spin);
  if (!(length > 1e-300))
    return wrench(Eigen::Vector3d::Zero(), 0.0);
  return wrench(friction * friction / length * across,
                torsion * torsion / length * spin);
}

double support(const std::vector<Cone>& cones, const Wrench& d) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Cone& cone : cones)
    largest = std::max(largest, cone.farthest(d).dot(d));
  return largest;
}

double minimumFrom(const std::vector<Cone>& cones, const Wrench& start) {
  Wrench w = start.normalized();
  double value = support(cones, w), t = 0.3;
  std::vector<Wrench> bundle;
  for (int step = 0; step < MAX_STEPS && t > 1e-10; ++step) {
    for (const Cone& cone : cones)
      bundle.push_back(cone.farthest(w));
    if (bundle.size() > MAX_BUNDLE)
      bundle.erase(bundle.begin(), bundle.end() - MAX_BUNDLE);
    Eigen::Matrix<double, 6, Eigen::Dynamic> p(6, Eigen::Index(bundle.size()));
    Eigen::VectorXd c(Eigen::Index(bundle.size()));
    for (std::size_t j = 0; j < bundle.size(); ++j) {
      c[Eigen::Index(j)] = bundle[j].dot(w);
      p.col(Eigen::Index(j)) = bundle[j] - c[Eigen::Index(j)] * w; // along the sphere
    }
    const Wrench move = -t * (p * dualWeights(p, c, t));
    if (move.norm() < 1e-9)
      break;
    const Wrench next = (w + move).normalized();
    const double trial = support(cones, next);
    if (trial < value - 1e-13) {
      w = next;
      value = trial;
      t = std::min(1.6 * t, 10.0);
    } else {
      for (const Cone& cone : cones) // what the model did not know
        bundle.push_back(cone.farthest(next));
      t *= 0.5;
    }
  }
  return value;
}

} // namespace pcl_sq::detail
