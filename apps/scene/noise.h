// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace pcl_sq::app {

/** \brief Mixes bits (Steele, Lea & Flood 2014, SplitMix64's finaliser): the same
 * numbers on every machine and for any order of evaluation. */
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/** \brief Uniform number in [0, 1) of a key. */
inline double uniformOf(std::uint64_t key) {
  return static_cast<double>(mixBits(key) >> 11) * 0x1.0p-53;
}

/** \brief Standard normal number of a key (Box & Muller 1958). */
double normalOf(std::uint64_t key);

/** \brief Solid texture in about [-1, 1]: sum of smoothed lattice noises.
 * \param[in] p place [m] \param[in] coarse, fine largest and smallest wavelength [m]
 * \param[in] footprint size of what the pixel sees [m]; waves below twice that fade
 * out, so that far surfaces do not flicker between the two images */
double solidNoise(const Eigen::Vector3d& p,
                  double coarse,
                  double fine,
                  double footprint,
                  std::uint64_t seed);

} // namespace pcl_sq::app
