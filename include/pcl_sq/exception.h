// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <pcl/exceptions.h>

#include <string>

namespace pcl_sq {

/** \brief The environment is not as needed: a file, a calibration, a display. Thrown by
 * the stereo and visualization components only. */
class PCL_SQ_EXPORTS Exception : public pcl::PCLException {
public:
  explicit Exception(const std::string& message) : pcl::PCLException(message) {}
};

} // namespace pcl_sq
