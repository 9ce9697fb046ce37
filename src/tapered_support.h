// SPDX-License-Identifier: BSD-3-Clause
// Private. Fit of a tapered body to points, outline and table.
#pragma once

#include "support_problem.h"
#include "taper_step.h"

namespace pcl_sq::detail {

/** \brief Where a taper is tried from. */
struct TaperStart {
  ShapeCandidate from;                     ///< its model with the axis along z
  ShapeClass family = ShapeClass::GENERIC; ///< that is tapered
  /** \brief Directions in which it may move, those of the taper last. */
  Eigen::Matrix<double, 13, Eigen::Dynamic, 0, 13, 13> basis;
  int taper = 2;     ///< columns of it
  double gain = 0.0; ///< by the taper, as far as one Gauss-Newton step can tell
};

/** \brief A candidate with its axis \a k as z, and how it may move. */
TaperStart
taperStart(const SupportProblem& problem, const ShapeCandidate& candidate, int k);

/** \brief Least squares over the parameters of a tapered body. */
class TaperedSupport {
public:
  /** \param[in] points of the problem or fewer; kept by reference
   * \param[in] sigma of the points */
  TaperedSupport(const SupportProblem& problem, const UnitPoints& points, double sigma);

  /** \brief What the taper's directions add to the gain that a Gauss-Newton step
   * promises (Rao's score test). */
  double gainOf(const TaperStart& start) const;
  ShapeCandidate fit(const TaperStart& start) const;

private:
  using Basis = decltype(TaperStart::basis);
  struct Sums {
    Matrix13 jtj = Matrix13::Zero();
    Vector13 jtr = Vector13::Zero();
    double cost = 0.0;
  };

  Sums evaluate(const TaperedSuperquadric& model) const;
  /** \brief Step over the first columns of a basis. \return what it promises to gain */
  double step(const TaperedSuperquadric& s,
              const Sums& sums,
              const Basis& basis,
              int columns,
              double damping,
              Vector13& full) const;
  /** \brief The same over the noise, without damping to speak of. */
  double promised(const TaperedSuperquadric& s,
                  const Sums& sums,
                  const Basis& basis,
                  int columns) const;
  double minimise(TaperedSuperquadric& s, const Basis& basis) const;

  const SupportProblem& problem_;
  const UnitPoints& points_;
  LmOptions limits_;
  SupportCost planes_;
};

} // namespace pcl_sq::detail
