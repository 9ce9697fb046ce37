// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl_sq::detail {

/** \brief The text of view.html, which CMake puts into the library. */
const char* viewPage();

} // namespace pcl_sq::detail
