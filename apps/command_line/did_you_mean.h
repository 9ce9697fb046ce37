// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Fewest letters inserted, left out, replaced or exchanged with their neighbour
 * that turn one word into the other. */
std::size_t editDistance(const std::string& a, const std::string& b);

/** \brief The name that was probably meant, empty if none is like it. */
std::string closestName(const std::string& word, const std::vector<std::string>& names);

/** \brief "; did you mean '--remove-plane'?", or nothing where no name is like it. */
std::string didYouMean(const std::string& word, const std::vector<std::string>& names);

} // namespace pcl_sq::app
