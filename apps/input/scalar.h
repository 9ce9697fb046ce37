// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_sq::app {

/** \brief Types of numbers in binary files. */
enum class Scalar { I8, U8, I16, U16, I32, U32, I64, U64, F32, F64 };

/** \brief Bytes of a number. */
std::size_t sizeOf(Scalar type);

/** \brief Numbers that lie \a stride bytes apart, as doubles \a out_stride apart.
 * \param[in] swap whether the file's order of bytes is the other one */
void decodeColumn(const char* first,
                  std::size_t stride,
                  std::size_t count,
                  Scalar type,
                  bool swap,
                  double* out,
                  std::size_t out_stride);

/** \brief One number. */
inline double decode(const char* bytes, Scalar type, bool swap) {
  double value = 0.0;
  decodeColumn(bytes, 0, 1, type, swap, &value, 0);
  return value;
}

} // namespace pcl_sq::app
