// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What an image says of itself before it is decoded. */
struct ImageHeader {
  std::uint64_t width = 0, height = 0;
  std::uint64_t least_bytes = 0; ///< of the whole file; a shorter one is cut off
};

/** \brief Reads the head of a PNG, JPEG, BMP, PNM, PFM or TIFF file. \param[out] why
 * what is wrong with it \return false if it is none of them or cut off */
bool readImageHeader(const std::string& bytes, ImageHeader& header, std::string* why);

/** \brief The colours (red, green, blue) that the numbers in a PNG's pixels stand for;
 * none where its pixels are no numbers of colours. */
std::vector<std::array<std::uint8_t, 3>> paletteOf(const std::string& bytes);

} // namespace pcl_sq::app
