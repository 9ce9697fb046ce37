// SPDX-License-Identifier: BSD-3-Clause
// Time of planning grasps on a cup with a handle (four parts) that stands on a table.
#include "pcl_sq/grasp_planner.h"

#include <benchmark/benchmark.h>

namespace {

pcl_sq::Superquadric
part(const Eigen::Vector3d& axes, double e1, double e2, const Eigen::Vector3d& center) {
  pcl_sq::Superquadric s;
  s.semi_axes = axes;
  s.epsilon1 = e1;
  s.epsilon2 = e2;
  s.center = center;
  return s;
}

pcl_sq::MultiSuperquadric cup() {
  pcl_sq::MultiSuperquadric cup;
  cup.parts = {part({0.035, 0.035, 0.05}, 0.15, 1.0, {0.0, 0.0, 0.05}),
               part({0.006, 0.006, 0.028}, 0.3, 0.5, {0.060, 0.0, 0.05}),
               part({0.016, 0.006, 0.006}, 0.5, 0.3, {0.049, 0.0, 0.075}),
               part({0.016, 0.006, 0.006}, 0.5, 0.3, {0.049, 0.0, 0.025})};
  return cup;
}

pcl_sq::GraspScene table() {
  pcl_sq::GraspScene scene;
  scene.has_table = true;
  scene.has_viewpoint = true;
  scene.viewpoint = {0.0, -0.8, 0.5};
  return scene;
}

void planHundredGrasps(benchmark::State& state) {
  const pcl_sq::MultiSuperquadric object = cup();
  const pcl_sq::GraspScene scene = table();
  const pcl_sq::GraspPlanner planner;
  pcl_sq::GraspPlan plan;
  for (auto _ : state) {
    plan = planner.plan(object, scene);
    benchmark::DoNotOptimize(plan);
  }
  state.counters["grasps"] = double(plan.grasps.size());
  state.counters["candidates"] = double(plan.rejections.candidates);
  state.counters["poses"] = double(plan.rejections.poses);
}
BENCHMARK(planHundredGrasps)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
