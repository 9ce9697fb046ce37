// SPDX-License-Identifier: BSD-3-Clause
#include "input/scalar.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace pcl_sq::app {

namespace {

template <typename T, bool SWAP>
void decodeAs(const char* at,
              std::size_t stride,
              std::size_t count,
              double* out,
              std::size_t out_stride) {
  for (std::size_t i = 0; i < count; ++i, at += stride, out += out_stride) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, at, sizeof(T)); // a file's numbers are not aligned
    if constexpr (SWAP)
      std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    *out = static_cast<double>(value);
  }
}

template <bool SWAP>
void decodeIn(const char* first,
              std::size_t stride,
              std::size_t count,
              Scalar type,
              double* out,
              std::size_t step) {
  switch (type) {
  case Scalar::I8:
    return decodeAs<std::int8_t, SWAP>(first, stride, count, out, step);
  case Scalar::U8:
    return decodeAs<std::uint8_t, SWAP>(first, stride, count, out, step);
  case Scalar::I16:
    return decodeAs<std::int16_t, SWAP>(first, stride, count, out, step);
  case Scalar::U16:
    return decodeAs<std::uint16_t, SWAP>(first, stride, count, out, step);
  case Scalar::I32:
    return decodeAs<std::int32_t, SWAP>(first, stride, count, out, step);
  case Scalar::U32:
    return decodeAs<std::uint32_t, SWAP>(first, stride, count, out, step);
  case Scalar::I64:
    return decodeAs<std::int64_t, SWAP>(first, stride, count, out, step);
  case Scalar::U64:
    return decodeAs<std::uint64_t, SWAP>(first, stride, count, out, step);
  case Scalar::F32:
    return decodeAs<float, SWAP>(first, stride, count, out, step);
  case Scalar::F64:
    return decodeAs<double, SWAP>(first, stride, count, out, step);
  }
}

} // namespace

std::size_t sizeOf(Scalar type) {
  switch (type) {
  case Scalar::I8:
  case Scalar::U8:
    return 1;
  case Scalar::I16:
  case Scalar::U16:
    return 2;
  case Scalar::I32:
  case Scalar::U32:
  case Scalar::F32:
    return 4;
  default:
    return 8;
  }
}

void decodeColumn(const char* first,
                  std::size_t stride,
                  std::size_t count,
                  Scalar type,
                  bool swap,
                  double* out,
                  std::size_t out_stride) {
  if (swap)
    decodeIn<true>(first, stride, count, type, out, out_stride);
  else
    decodeIn<false>(first, stride, count, type, out, out_stride);
}

} // namespace pcl_sq::app
