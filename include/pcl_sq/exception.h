// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <pcl/exceptions.h>

#include <string>

namespace pcl_sq {

/** \brief Something outside of the program failed: a file, a calibration, a display.
 *
 * Thrown by the stereo and visualization components and by the programs' input and
 * output, never because of a cloud's content.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS Exception : public pcl::PCLException {
public:
  /** \param[in] sentence what is wrong and what to do, `[pcl_sq::Class::method] ...` */
  explicit Exception(const std::string& sentence)
      : pcl::PCLException(sentence), sentence_(sentence) {}

  /** \brief The sentence alone; PCL's own text starts with a place that is empty. */
  const char* what() const noexcept override { return sentence_.c_str(); }

private:
  std::string sentence_;
};

} // namespace pcl_sq
