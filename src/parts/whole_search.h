// SPDX-License-Identifier: BSD-3-Clause
// Private. Parts of an object that is seen from all sides, judged together: where its
// points are and where there are none tell more than each part's own points do (M28).
#pragma once

#include "parts/union_score.h"
#include "util/cloud_graph.h"

#include <map>

namespace pcl_sq::detail {

/** \brief Parts that may take another's place, quickly fitted. */
struct Way {
  std::vector<Part> parts;
  double gain = -1e300; ///< of the score and the parts' price, by quick fits
};

/** \brief A part and the ways to cut it, once they have been looked for. */
struct Member {
  Part part;
  std::shared_ptr<const std::vector<Way>> ways;
  bool is_current = false; ///< whether the ways are those of its present points
  bool asked = false;      ///< whether all families were fitted to its points
};

/** \brief A description of the object and its score, smaller is better. */
struct Description {
  std::vector<Member> members;
  double score = 1e300;
  bool was_cut = false, was_merged = false;
};

/** \brief The moves from one description to another with more parts or fewer. */
class WholeMoves {
public:
  /** \param[in] wanted most parts of a description
   * \param[in] min_gain of the score, for one more part */
  WholeMoves(const PieceContext& context, int wanted, double min_gain);
  WholeMoves(const WholeMoves&) = delete;
  WholeMoves& operator=(const WholeMoves&) = delete;

  [[nodiscard]] double score(const std::vector<Member>& members) const;

  /** \brief The best descriptions with one of the members cut, one of each number of
   * parts. \param[in,out] d gains the ways to cut its members */
  [[nodiscard]] std::vector<Description> cutOnce(Description& d) const;

  /** \brief The best description with one part less: two neighbours made one, or one
   * left out and its points given to the others. */
  [[nodiscard]] Description mergeOnce(const Description& d);

  /** \brief Fits those members by all families that only the cheap ones were asked to
   * describe; what makes the description better is kept. */
  void askFamilies(Description& d) const;

private:
  struct Join;

  std::vector<Way> proposals(const Part& part) const;
  std::vector<Way> quickWays(const Part& part, double rest, int room) const;
  bool adapt(const Part& part, std::vector<Way>& ways) const;
  void findWays(Description& d, std::size_t k) const;
  void settle(Description& d) const;
  std::vector<Join> joinsOf(const Description& d);
  Description joined(const Description& d, const Join& join) const;

  const PieceContext& context_;
  ObjectFitOptions plain_options_;
  PieceContext plain_; ///< of quick fits: no tapers, bends
  CloudGraph graph_;
  int wanted_;
  double min_gain_;
  unsigned int threads_;
  /** \brief Two neighbours as one, by their traceNumber(). */
  std::map<std::pair<std::size_t, std::size_t>, Part> known_;
};

/** \brief Whether anything is left to explain that more than one part may pay for.
 * \param[in] min_gain of the score, for one more part */
[[nodiscard]] bool
mayBeCut(const PieceContext& context, const Part& whole, double min_gain);

/** \brief Splits an object without a camera while that pays, its parts fitted to the
 * points nearest to each.
 * \param[in] context with the noise that parts are not worth to explain
 * \param[in] whole all points, fitted
 * \param[in] wanted largest number of parts, or the number itself
 * \param[in] exactly whether \a wanted is the number
 * \param[in] min_gain of the score, for one more part */
std::vector<Piece> splitWholeCloud(const PieceContext& context,
                                   Piece whole,
                                   int wanted,
                                   bool exactly,
                                   double min_gain);

/** \brief Fits parts again, to less noise than they were found by. */
void refineParts(const PieceContext& context, std::vector<Piece>& pieces);

} // namespace pcl_sq::detail
