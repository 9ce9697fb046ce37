// SPDX-License-Identifier: BSD-3-Clause
#include "parts/whole_search.h"

#include "tuning/parts_tuning.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::whole_search;

/** \brief M28: the search for the description that costs least. */
class WholeSearch {
public:
  /** \param[in] price of a part, with the parameters that it brings along
   * \param[in] min_gain of the score, for one more part */
  WholeSearch(const PieceContext& context,
              int wanted,
              bool exactly,
              double min_gain,
              double price)
      : moves_(context, wanted, min_gain), wanted_(std::size_t(wanted)),
        exactly_(exactly), min_gain_(min_gain), price_(price) {}

  Description run(Part whole);

private:
  /** \brief With the price of its parts. */
  double worth(const Description& d) const {
    return d.score + min_gain_ * double(d.members.size());
  }
  /** \brief Number of parts of the best description. */
  std::size_t best() const;
  bool isPromising(std::size_t parts) const;
  bool note(Description d);

  WholeMoves moves_;
  std::size_t wanted_;
  bool exactly_;
  double min_gain_, price_;
  std::vector<Description> found_; ///< the best of each number of parts
};

/** \brief Keeps a description if it is the best of its number of parts. */
bool WholeSearch::note(Description d) {
  if (d.members.empty() || !(d.score < 1e299))
    return false;
  if (found_.size() < d.members.size() + 1)
    found_.resize(d.members.size() + 1);
  Description& known = found_[d.members.size()];
  if (!(d.score < known.score))
    return false;
  known = std::move(d);
  known.was_cut = known.was_merged = false;
  return true;
}

std::size_t WholeSearch::best() const {
  if (exactly_) // the nearest number there is
    for (std::size_t k = found_.size() - 1; k > 0; --k)
      if (!found_[k].members.empty())
        return k;
  std::size_t best = 1;
  for (std::size_t k = 2; k < found_.size(); ++k)
    if (!found_[k].members.empty() && worth(found_[k]) < worth(found_[best]))
      best = k;
  return best;
}

/** \brief Whether a description may lead to a better one than the best. */
bool WholeSearch::isPromising(std::size_t parts) const {
  if (found_[parts].members.empty())
    return false;
  const std::size_t k = best();
  return exactly_ || parts == k ||
         (parts < k ? worth(found_[parts]) < worth(found_[k]) + FAR * price_
                    : parts < k + PATIENCE);
}

Description WholeSearch::run(Part whole) {
  found_.resize(2);
  found_[1].members.push_back({std::move(whole), nullptr, false, true});
  found_[1].score = moves_.score(found_[1].members);
  bool changed = true;
  for (int sweep = 0; sweep < SWEEPS && changed; ++sweep) {
    changed = false;
    for (std::size_t k = 1; k < found_.size() && k < wanted_; ++k)
      if (isPromising(k) && !found_[k].was_cut) {
        found_[k].was_cut = true;
        for (Description& d : moves_.cutOnce(found_[k]))
          changed = note(std::move(d)) || changed;
      }
    for (std::size_t k = found_.size() - 1; k > 1; --k)
      if (isPromising(k) && !found_[k].was_merged) {
        found_[k].was_merged = true;
        changed = note(moves_.mergeOnce(found_[k])) || changed;
      }
  }
  return found_[best()];
}

} // namespace

namespace {

/** \brief Of a part, with the parameters that it brings along. */
double priceOf(const PieceContext& context, double min_gain) {
  return min_gain +
         FEWEST_PARAMETERS * std::log(1.0 + context.observed.effective_points);
}

} // namespace

bool mayBeCut(const PieceContext& context, const Part& whole, double min_gain) {
  return mostGain(context, whole) >= priceOf(context, min_gain);
}

std::vector<Piece> splitWholeCloud(const PieceContext& context,
                                   Piece whole,
                                   int wanted,
                                   bool exactly,
                                   double min_gain) {
  Part one;
  one.piece = std::move(whole);
  traceAgain(context, one);
  if (!exactly && !mayBeCut(context, one, min_gain))
    return {std::move(one.piece)};
  std::vector<Piece> pieces;
  for (Member& m :
       WholeSearch(context, wanted, exactly, min_gain, priceOf(context, min_gain))
           .run(std::move(one))
           .members)
    pieces.push_back(std::move(m.part.piece));
  return pieces;
}

void refineParts(const PieceContext& context, std::vector<Piece>& pieces) {
  Description d;
  for (Piece& piece : pieces) {
    Part part;
    part.piece = std::move(piece);
    traceAgain(context, part);
    d.members.push_back({std::move(part), nullptr});
  }
  d.score = 1e298; // that of the noise they were found by is none
  WholeMoves(context, int(pieces.size()), 0.0).askFamilies(d);
  pieces.clear();
  for (Member& m : d.members)
    pieces.push_back(std::move(m.part.piece));
}

} // namespace pcl_sq::detail
