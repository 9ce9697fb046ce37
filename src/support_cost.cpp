// SPDX-License-Identifier: BSD-3-Clause
#include "support_cost.h"

#include "support_rows.h"

namespace pcl_sq::detail {

void SupportCost::operator()(const Superquadric& body, NormalEquations& e) const {
  const auto row = [&body](const Eigen::Vector3d& normal) {
    SupportRow<11> r;
    r.derivatives = body.supportJacobian(normal, r.reach);
    r.reach += normal.dot(body.center);
    return r;
  };
  const auto reach = [&body](const Eigen::Vector3d& normal) {
    return normal.dot(body.center) + body.support(normal);
  };
  addSupportCost<11>(*this, row, reach, e);
}

} // namespace pcl_sq::detail
