// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq's templates are compiled where they are used, for any point type; for the most
// common ones the longer of them are compiled into the library, too.
// Their base classes are PCL's, whose bodies are compiled into PCL's library for PCL's
// own point types alone. For another type, as PCL's tutorial "Adding your own custom
// PointT type" has it, this line comes before the first include of PCL or pcl_sq:
//
//   #define PCL_NO_PRECOMPILE
//
// Without it the linker would miss "pcl::PCLBase<MyPoint>::PCLBase()"; the check below
// says so while the file is compiled.
#pragma once

#include "pcl_sq/exports.h"

#include <type_traits>

namespace pcl {
struct PointXYZ;
struct PointXYZI;
struct PointXYZL;
struct PointXYZRGBA;
struct PointXYZRGB;
struct PointXYZRGBL;
struct PointXYZLAB;
struct PointXYZHSV;
struct InterestPoint;
struct PointNormal;
struct PointXYZRGBNormal;
struct PointXYZINormal;
struct PointXYZLNormal;
struct PointWithRange;
struct PointWithViewpoint;
struct PointWithScale;
struct PointSurfel;
struct PointDEM;
} // namespace pcl

namespace pcl_sq {
namespace detail {

template <typename PointT, typename... Types>
constexpr bool IS_ONE_OF = (std::is_same<PointT, Types>::value || ...);

/** \brief Whether PCL's bodies are in its library, or in the file being compiled. */
#if defined(PCL_NO_PRECOMPILE) || defined(PCL_PCL_IMPL_BASE_HPP_)
template <typename PointT>
constexpr bool HAS_BODY = true;
#else
template <typename PointT>
constexpr bool HAS_BODY = IS_ONE_OF<PointT,
                                    pcl::PointXYZ,
                                    pcl::PointXYZI,
                                    pcl::PointXYZL,
                                    pcl::PointXYZRGBA,
                                    pcl::PointXYZRGB,
                                    pcl::PointXYZRGBL,
                                    pcl::PointXYZLAB,
                                    pcl::PointXYZHSV,
                                    pcl::InterestPoint,
                                    pcl::PointNormal,
                                    pcl::PointXYZRGBNormal,
                                    pcl::PointXYZINormal,
                                    pcl::PointXYZLNormal,
                                    pcl::PointWithRange,
                                    pcl::PointWithViewpoint,
                                    pcl::PointWithScale,
                                    pcl::PointSurfel,
                                    pcl::PointDEM>;
#endif

} // namespace detail
} // namespace pcl_sq

/** \brief Stops the compiler with a sentence where the linker would with a riddle. */
#define PCL_SQ_CHECK_POINT_TYPE(PointT)                                                \
  static_assert(pcl_sq::detail::HAS_BODY<PointT>,                                      \
                "PCL's library has no code for this point type: write #define "        \
                "PCL_NO_PRECOMPILE before the first #include of PCL or pcl_sq")

/** \brief A class template for the most common point types, whose code is in the
 * library as well: its users' files compile faster. \a declaration is "template class",
 * or "extern template class PCL_SQ_EXPORTS" where users see it. */
#define PCL_SQ_INSTANTIATE(declaration, Element)                                       \
  declaration pcl_sq::Element<pcl::PointXYZ>;                                          \
  declaration pcl_sq::Element<pcl::PointXYZI>;                                         \
  declaration pcl_sq::Element<pcl::PointXYZRGB>;                                       \
  declaration pcl_sq::Element<pcl::PointXYZRGBA>;                                      \
  declaration pcl_sq::Element<pcl::PointNormal>;                                       \
  declaration pcl_sq::Element<pcl::PointXYZRGBNormal>;
