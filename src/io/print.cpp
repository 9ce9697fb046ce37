// SPDX-License-Identifier: BSD-3-Clause
// Models as text for people.
#include "pcl_sq/multi_superquadric.h"

#include <ostream>

namespace pcl_sq {

namespace {

/** \brief (x, y, z); an Eigen format would set the stream's precision. */
struct Triple {
  const Eigen::Vector3d& v;
};

std::ostream& operator<<(std::ostream& stream, const Triple& triple) {
  return stream << '(' << triple.v.x() << ", " << triple.v.y() << ", " << triple.v.z()
                << ')';
}

} // namespace

std::ostream& operator<<(std::ostream& stream, const Superquadric& superquadric) {
  const Eigen::Vector3d x = superquadric.rotation.col(0),
                        y = superquadric.rotation.col(1),
                        z = superquadric.rotation.col(2);
  stream << "superquadric at " << Triple{superquadric.center} << " m, semi-axes "
         << Triple{superquadric.semi_axes} << " m, exponents " << superquadric.epsilon1
         << " and " << superquadric.epsilon2 << ", axes x " << Triple{x} << ", y "
         << Triple{y} << ", z " << Triple{z};
  if (superquadric.isTapered())
    stream << ", taper " << superquadric.kx << " and " << superquadric.ky;
  if (superquadric.isBent())
    stream << ", bend " << superquadric.bend << " per m towards "
           << superquadric.bend_angle << " rad";
  if (superquadric.isCut())
    stream << ", rim at " << superquadric.rim << " a3";
  if (superquadric.isHollow())
    stream << ", wall " << superquadric.wall << " m";
  return stream;
}

std::ostream& operator<<(std::ostream& stream, const MultiSuperquadric& model) {
  stream << model.size() << (model.size() == 1 ? " part" : " parts");
  for (std::size_t k = 0; k < model.size(); ++k)
    stream << "\n  " << k << ": " << model.parts[k];
  return stream;
}

} // namespace pcl_sq
