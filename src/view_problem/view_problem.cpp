// SPDX-License-Identifier: BSD-3-Clause
#include "view_problem/view_problem.h"

#include "tuning/view_tuning.h"
#include "view_problem/plane_sums.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::view_problem;
using namespace tuning::shared;

std::vector<TangentPlane> toUnit(std::vector<TangentPlane> planes,
                                 const Normalisation& f) {
  for (TangentPlane& p : planes) {
    p.offset = (p.offset - p.normal.dot(f.origin)) / f.scale;
    p.normal = f.axes.transpose() * p.normal;
    p.sigma /= f.scale;
  }
  return planes;
}

/** \brief Half the smaller width of the points across a direction, a few of them left
 * out. */
double halfWidthAcross(const UnitPoints& points, const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = direction.unitOrthogonal();
  across.col(1) = direction.cross(across.col(0));
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d q = across.transpose() * points[i].cast<double>();
    mean += q;
    square += q * q.transpose();
  }
  mean /= double(points.size());
  square = square / double(points.size()) - mean * mean.transpose();
  const Eigen::Vector3f narrow =
      (across *
       Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(square).eigenvectors().col(0))
          .cast<float>();
  std::vector<float> along(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    along[i] = narrow.dot(points[i]);
  const auto cut = static_cast<std::ptrdiff_t>(along.size() / 50);
  std::nth_element(along.begin(), along.begin() + cut, along.end());
  const double low = along[std::size_t(cut)];
  std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
  return 0.5 * (double(*(along.end() - 1 - cut)) - low);
}

/** \brief Points as so many independent observations. */
double observedPoints(const UnitPoints& points, const ViewFitOptions& options) {
  const double all = double(points.size());
  return options.effective_points > 0.0 ? std::min(options.effective_points, all) : all;
}

} // namespace

bool ViewProblem::prepare(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                          const ViewEvidence& evidence,
                          const ViewFitOptions& options) {
  options_ = options;
  if (!principalFrame(points, frame_))
    return false;
  all_ = detail::toUnit(points, frame_);
  if (all_.size() < MIN_POINTS)
    return false;
  if (options.precision.size() == std::size_t(points.cols())) {
    std::vector<float> precision;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      if (points.col(i).allFinite())
        precision.push_back(options.precision[std::size_t(i)]);
    all_.setPrecision(precision);
  }
  medium_ = subset(all_, MEDIUM_POINTS);
  coarse_ = subset(medium_, COARSE_POINTS);
  cost_.silhouette = toUnit(evidence.silhouette, frame_);
  cost_.tangents = toUnit(evidence.tangents, frame_);
  cost_.limits = toUnit(evidence.limits, frame_);
  cost_.dilation_sigma = evidence.dilation_sigma / frame_.scale;
  if (evidence.viewpoint) {
    has_view_ = true;
    eye_ = frame_.toUnit(*evidence.viewpoint);
    view_ = -eye_->normalized();
    cost_.view = view_;
    cost_.half_width = halfWidthAcross(medium_, view_);
  }
  few_ = cost_;
  const auto planes = static_cast<int>(cost_.silhouette.size());
  const int stride = std::max(1, planes / FEW_PLANES);
  few_.silhouette.clear();
  for (int i = 0; i < planes; i += stride) {
    few_.silhouette.push_back(cost_.silhouette[i]);
    few_.silhouette.back().sigma /= std::sqrt(double(stride));
  }
  if (evidence.up) {
    has_up_ = true;
    up_ = (frame_.axes.transpose() * *evidence.up).normalized();
  }
  noise_ = options.noise / frame_.scale;
  if (options.max_semi_axis > 0.0)
    max_axis_ = options.max_semi_axis / frame_.scale;
  return true;
}

double ViewProblem::observations() const {
  return observedPoints(all_, options_) +
         double(cost_.silhouette.size() + cost_.tangents.size());
}

LmOptions ViewProblem::limits(double sigma) const {
  LmOptions o;
  o.residual = kernels::Residual::FOOT_POINT;
  o.min_epsilon = options_.min_epsilon;
  o.max_epsilon = options_.max_epsilon;
  o.max_axis = max_axis_;
  o.min_axis = 1e-3;
  o.cost_tolerance = 1e-5;
  o.sigma = sigma;
  o.outlier = options_.robust ? OUTLIER : 0.0;
  return o;
}

PlaneCost ViewProblem::planes(double sigma, const UnitPoints& points, bool few) const {
  PlaneCost cost = few ? few_ : cost_;
  cost.unit = unitOf(sigma, points);
  return cost;
}

double ViewProblem::unitOf(double sigma, const UnitPoints& points) const {
  return sigma * std::sqrt(double(points.size()) / observedPoints(all_, options_));
}

Trial ViewProblem::minimise(const Trial& start,
                            const UnitPoints& points,
                            kernels::Residual residual,
                            int iterations,
                            const ParameterSpace& space,
                            bool few_planes,
                            const Hopeless& hopeless) const {
  LmOptions o = limits(start.sigma);
  o.residual = residual;
  o.max_iterations = iterations;
  if (few_planes)
    o.cost_tolerance = 1e-3;
  o.space = space;
  PlaneCost cost = few_planes ? few_ : cost_;
  cost.unit = unitOf(start.sigma, points);
  const PlaneSums sums(cost);
  if (!cost.empty())
    o.contributor = std::cref(sums);
  o.hopeless = {hopeless.after, hopeless.cost * cost.unit * cost.unit};
  const LmResult r = levenbergMarquardt(points, start.model, o);
  Trial t = start;
  t.model = r.model;
  t.cost = r.equations.cost / (cost.unit * cost.unit);
  t.iterations += r.iterations;
  t.termination = r.termination;
  return t;
}

double ViewProblem::sigmaOf(const Trial& trial, const UnitPoints& points) const {
  if (noise_ > 0.0)
    return noise_;
  LmOptions o;
  o.residual = kernels::Residual::FOOT_POINT;
  o.sigma = trial.sigma;
  o.outlier = OUTLIER;
  const NormalEquations e = sumsOf<11>(points, trial.model, o);
  return std::max(1e-4, std::sqrt(e.weighted / std::max(e.share, 1.0)));
}

} // namespace pcl_sq::detail
