// SPDX-License-Identifier: BSD-3-Clause
#include "quality/convex_hull.h"

#include <Eigen/Eigenvalues>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cstdio>

namespace pcl_sq::detail {

namespace {

/** \brief Whether the points do not lie in a hyperplane. */
bool spans(const Eigen::MatrixXd& points) {
  const Eigen::MatrixXd centred = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> scatter(
      centred * centred.transpose(), Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& values = scatter.eigenvalues(); // ascending
  return values[0] > 1e-12 * values[values.size() - 1];
}

} // namespace

bool convexHull(const Eigen::MatrixXd& points,
                std::vector<HullFacet>& facets,
                double* volume,
                std::vector<std::vector<int>>* corners) {
  const int dimension = int(points.rows());
  if (points.cols() <= dimension || !points.allFinite() || !spans(points))
    return false;
  Eigen::MatrixXd copy = points; // Qhull takes a pointer that is not const
  // QJ: symmetric grasps have many wrenches in one facet; joggled by 1e-8 of the size
  // they stay simplices
  char command[] = "qhull QJ Pp";
  FILE* const quiet =
      std::fopen("/dev/null", "w"); // Qhull insists on a file for errors
  qhT hull;
  qh_zero(&hull, quiet);
  const int failed = qh_new_qhull(&hull,
                                  dimension,
                                  int(points.cols()),
                                  copy.data(),
                                  False,
                                  command,
                                  nullptr,
                                  quiet);
  if (!failed) {
    facets.clear();
    if (corners)
      corners->clear();
    qhT* const qh = &hull; // Qhull's macros want this name
    facetT* facet;
    FORALLfacets {
      if (facet->upperdelaunay)
        continue;
      facets.push_back(
          {Eigen::Map<const Eigen::VectorXd>(facet->normal, dimension), facet->offset});
      if (corners) {
        corners->emplace_back();
        vertexT *vertex, **vertexp;
        FOREACHvertex_(facet->vertices) corners->back().push_back(
            qh_pointid(qh, vertex->point));
      }
    }
    if (volume) {
      qh_getarea(qh, qh->facet_list);
      *volume = qh->totvol;
    }
  }
  int current = 0, total = 0;
  qh_freeqhull(&hull, !qh_ALL);
  qh_memfreeshort(&hull, &current, &total);
  if (quiet)
    std::fclose(quiet);
  return !failed;
}

} // namespace pcl_sq::detail
