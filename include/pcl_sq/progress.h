// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

#include <functional>
#include <string>

namespace pcl_sq {

/** \brief Is told what long work is at: the stage's name, as in the timings, and the
 * share of it that is done, 0 when it begins to 1. Called from any thread, but never
 * from two at a time; it should return at once. */
using ProgressCallback = std::function<void(const std::string& stage, double share)>;

} // namespace pcl_sq
