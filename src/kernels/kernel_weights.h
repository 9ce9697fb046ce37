// SPDX-License-Identifier: BSD-3-Clause
// Private. Rows of residuals and derivatives, weighted by the mixture and summed up.
#pragma once

#include "kernel_rows.h"

namespace {

/** \brief Share and cost of a squared residual in the mixture. */
struct Weight {
  Float share, cost;
};

template <bool ROBUST>
inline Weight weight(Float square, Float s, Float c, Float inverse_s, Float log_full) {
  if (!ROBUST)
    return {all(1.0F), square};
  const Float e = exp(-s * square);
  const Float total = e + c;
  return {e * inverse(total), (log_full - log(total)) * inverse_s};
}

/** \brief Adds the products of one block's rows, kept as sums per lane.
 * \param[in] end of the block's points; zero up to the next whole vector */
template <int R>
inline void
addProducts(const float (&rows)[R][BLOCK], std::size_t end, float (*lanes)[LANES]) {
  static_assert(R % 3 == 0, "tiles of three rows");
  for (int i = 0; i < R; i += 3)
    for (int j = i; j < R; j += 3) {
      Float s[9];
      for (int k = 0; k < 9; ++k)
        s[k] = load(lanes[k]);
      for (std::size_t p = 0; p < end; p += LANES) {
        const Float a0 = load(rows[i] + p), a1 = load(rows[i + 1] + p),
                    a2 = load(rows[i + 2] + p);
        const Float b0 = load(rows[j] + p), b1 = load(rows[j + 1] + p),
                    b2 = load(rows[j + 2] + p);
        s[0] += a0 * b0;
        s[1] += a0 * b1;
        s[2] += a0 * b2;
        s[3] += a1 * b0;
        s[4] += a1 * b1;
        s[5] += a1 * b2;
        s[6] += a2 * b0;
        s[7] += a2 * b1;
        s[8] += a2 * b2;
      }
      for (int k = 0; k < 9; ++k)
        store(lanes[k], s[k]);
      lanes += 9;
    }
}

/** \brief Products of that many rows: the tiles of the upper triangle. */
constexpr int productsOf(int rows) {
  return 9 * (rows / 3) * (rows / 3 + 1) / 2;
}

/** \brief Moves the lanes' sums into double precision and clears them. */
template <int R>
inline void flush(float (&lanes)[productsOf(R)][LANES], double (&products)[R][R]) {
  int tile = 0;
  for (int i = 0; i < R; i += 3)
    for (int j = i; j < R; j += 3, ++tile)
      for (int k = 0; k < 9; ++k) {
        float* s = lanes[9 * tile + k];
        products[i + k / 3][j + k % 3] += static_cast<double>(sum(load(s)));
        store(s, Float{});
      }
}

/** \brief Sums over all points, from the rows of one block after the other.
 * \tparam RESIDUAL the residuals' row; those before it are the derivatives */
template <int R, int RESIDUAL, bool ROBUST, bool DERIVATIVES>
class WeightedSums {
public:
  WeightedSums(const Mixture& m, SumsOf<R>& out)
      : s_(all(m.inverse_two_sigma_squared)), c_(all(m.outlier)),
        inverse_s_(all(1.0F / m.inverse_two_sigma_squared)),
        log_full_(log(all(1.0F) + c_)), out_(out) {
    __builtin_memset(&out, 0, sizeof(out));
  }

  /** \brief The points from \a begin on. */
  void add(const Points& points,
           std::size_t begin,
           std::size_t size,
           float (&rows)[R][BLOCK]) {
    constexpr std::size_t FLUSH = 16; // blocks whose sums stay in single precision
    const Float index = laneIndex();
    Float cost{}, share{};
    const Float valid_count = all(static_cast<float>(size));
    for (std::size_t p = 0; p < size; p += LANES) {
      const Float valid = select(
          index + all(static_cast<float>(p)) < valid_count, all(1.0F), all(0.0F));
      const Float q = points.precision ? load(points.precision + begin + p) : all(1.0F);
      const Float r = load(rows[RESIDUAL] + p);
      const Weight w = weight<ROBUST>(q * r * r, s_, c_, inverse_s_, log_full_);
      cost += valid * w.cost;
      share += valid * w.share;
      if (DERIVATIVES) {
        const Float root = sqrt(valid * w.share * q);
        for (int i = 0; i <= RESIDUAL; ++i)
          store(rows[i] + p, root * load(rows[i] + p));
        for (int i = RESIDUAL + 1; i < R; ++i)
          store(rows[i] + p, Float{});
      }
    }
    out_.cost += static_cast<double>(sum(cost));
    out_.share += static_cast<double>(sum(share));
    if (DERIVATIVES) {
      addProducts(rows, size, lanes_);
      if (++blocks_ % FLUSH == 0)
        flush(lanes_, out_.products);
    }
  }
  /** \brief After the last block. */
  void end() {
    if (DERIVATIVES)
      flush(lanes_, out_.products);
  }

private:
  alignas(64) float lanes_[productsOf(R)][LANES] = {};
  const Float s_, c_, inverse_s_, log_full_;
  SumsOf<R>& out_;
  std::size_t blocks_ = 0;
};

} // namespace
