// SPDX-License-Identifier: BSD-3-Clause
// Options that belong together, for the help's groups and for the rules.
#pragma once

#include <vector>

namespace pcl_sq::app {

using OptionList = std::vector<const char*>;

/** \brief Options that only the paper's chain has: naming one asks for that chain. */
inline const OptionList PAPER_OPTIONS = {"--fit",
                                         "--cost",
                                         "--axis-assignment",
                                         "--extents",
                                         "--pca",
                                         "--center",
                                         "--voxel-percent",
                                         "--voxel-size",
                                         "--divisions",
                                         "--run",
                                         "--exclusive"};

/** \brief How the images of a pair are matched. */
inline const OptionList MATCHING_OPTIONS = {"--matcher",
                                            "--block-size",
                                            "--min-depth",
                                            "--max-depth",
                                            "--uniqueness",
                                            "--left-right",
                                            "--refine",
                                            "--wls"};

} // namespace pcl_sq::app
