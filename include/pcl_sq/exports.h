// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

/** \brief Marks the symbols that the shared libraries export; all others stay hidden.
 */
#if defined(_WIN32) && defined(PCL_SQ_BUILDING)
#define PCL_SQ_EXPORTS __declspec(dllexport)
#elif defined(_WIN32)
#define PCL_SQ_EXPORTS __declspec(dllimport)
#else
#define PCL_SQ_EXPORTS __attribute__((visibility("default")))
#endif
