// SPDX-License-Identifier: BSD-3-Clause
// Fits the XYZ files of the command line and prints one JSON line each: the form in
// which the comparison takes every fitter's results. The time is the processor time of
// the fit alone, of one thread; the median of three runs.
#include "pcl_sq/fit_superquadric.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

double processorTime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

std::vector<double> readNumbers(const char* path) {
  std::vector<double> numbers;
  std::FILE* file = std::fopen(path, "r");
  if (!file)
    return numbers;
  double value;
  while (std::fscanf(file, "%lf", &value) == 1)
    numbers.push_back(value);
  std::fclose(file);
  return numbers;
}

} // namespace

int main(int argc, char** argv) {
  for (int a = 1; a < argc; ++a) {
    const std::vector<double> numbers = readNumbers(argv[a]);
    const Eigen::Map<const Eigen::Matrix3Xd> points(
        numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
    pcl_sq::FitSummary s;
    std::array<double, 3> seconds;
    for (double& time : seconds) {
      const double begin = processorTime();
      s = pcl_sq::fitSuperquadric(points);
      time = processorTime() - begin;
    }
    std::sort(seconds.begin(), seconds.end());
    if (!s.ok()) {
      std::printf("{\"file\": \"%s\", \"fail\": true}\n", argv[a]);
      continue;
    }
    const auto& m = s.model;
    const auto& r = m.rotation;
    std::printf("{\"file\": \"%s\", \"a1\": %.9g, \"a2\": %.9g, \"a3\": %.9g, \"e1\": "
                "%.9g, \"e2\": %.9g, \"R\": [%.12g, %.12g, %.12g, %.12g, %.12g, %.12g, "
                "%.12g, %.12g, %.12g], \"t\": [%.12g, %.12g, %.12g], \"cpu\": %.6g}\n",
                argv[a],
                m.semi_axes[0],
                m.semi_axes[1],
                m.semi_axes[2],
                m.epsilon1,
                m.epsilon2,
                r(0, 0),
                r(0, 1),
                r(0, 2),
                r(1, 0),
                r(1, 1),
                r(1, 2),
                r(2, 0),
                r(2, 1),
                r(2, 2),
                m.center[0],
                m.center[1],
                m.center[2],
                seconds[1]);
  }
  return EXIT_SUCCESS;
}
