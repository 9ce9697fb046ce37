// SPDX-License-Identifier: BSD-3-Clause
// Memory and time of one full fit: fit_memory [POINTS] [double]. The points lie as in a
// cloud of pcl::PointXYZ (16 bytes each), or in a matrix of doubles. Prints the cloud's
// own size, by how much the process's largest resident size rises during the fit, and
// the processor time, the best of five.
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/triangle_mesh.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>

#include <sys/resource.h>

namespace {

/** \brief Noisy points of a superquadric, drawn one by one: the memory of making them
 * stays far below that of the cloud. */
template <typename Matrix>
Matrix cloud(Eigen::Index count) {
  pcl_sq::Superquadric s;
  s.center = {0.1, -0.05, 0.8};
  s.semi_axes = {0.05, 0.08, 0.11};
  s.epsilon1 = 0.4;
  s.epsilon2 = 0.9;
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  Matrix points(Matrix::RowsAtCompileTime, count);
  points.setOnes();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d direction(normal(engine), normal(engine), normal(engine));
    const Eigen::Vector3d noise(normal(engine), normal(engine), normal(engine));
    points.col(i).template head<3>() =
        (s.radialProjection(s.center + direction.cwiseProduct(s.semi_axes)) +
         0.001 * noise)
            .cast<typename Matrix::Scalar>();
  }
  return points;
}

/** \brief [MiB] */
double largestResident() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

double processorTime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <typename Matrix>
int measure(long count) {
  const Matrix points = cloud<Matrix>(count);
  // what every process needs once: tables, code
  if (!pcl_sq::fitSuperquadric(points.template topRows<3>().leftCols(100)).ok())
    return EXIT_FAILURE;
  const double before = largestResident();
  double seconds = 1e9, risen = 0.0;
  for (int run = 0; run < 5; ++run) {
    const double begin = processorTime();
    if (!pcl_sq::fitSuperquadric(points.template topRows<3>()).ok())
      return EXIT_FAILURE;
    seconds = std::min(seconds, processorTime() - begin);
    risen = largestResident() - before;
  }
  const double own =
      double(points.size()) * sizeof(typename Matrix::Scalar) / 1048576.0;
  std::printf("%ld points: cloud %.1f MiB, fit %.1f MiB more (%.2f of the cloud), "
              "%.1f ms\n",
              count,
              own,
              risen,
              risen / own,
              1e3 * seconds);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 1000000;
  if (count < 100) {
    std::fprintf(stderr, "fit_memory: at least 100 points are needed.\n");
    return 2;
  }
  return argc > 2 && std::strcmp(argv[2], "double") == 0
             ? measure<Eigen::Matrix3Xd>(count)
             : measure<Eigen::Matrix4Xf>(count);
}
