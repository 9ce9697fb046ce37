// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_reprojector.h"

#include "stereo/disparity_noise.h"
#include "stereo/matching.h"
#include "stereo/refine_disparity.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <cfloat>
#include <chrono>
#include <cmath>
#include <limits>

namespace pcl_sq {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double SIGMAS = 3.0; ///< beyond which two disparities differ

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

[[noreturn]] void raise(const std::string& what) {
  throw Exception("[pcl_sq::StereoReprojector::compute] " + what);
}

void checkType(const cv::Mat& image, const char* name) {
  if (image.empty())
    raise(std::string("the ") + name + " image is empty; give two images.");
  if (image.depth() != CV_8U ||
      (image.channels() != 1 && image.channels() != 3 && image.channels() != 4))
    raise(std::string("the ") + name + " image must be 8-bit grey or colour.");
}

cv::Mat toColor(const cv::Mat& image) {
  if (image.channels() == 3)
    return image;
  cv::Mat color;
  cv::cvtColor(
      image, color, image.channels() == 4 ? cv::COLOR_BGRA2BGR : cv::COLOR_GRAY2BGR);
  return color;
}

double finiteShare(const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
  std::size_t finite = 0;
  for (const pcl::PointXYZRGB& p : cloud)
    finite += std::isfinite(p.z) ? 1 : 0;
  return cloud.empty()
             ? 0.0
             : static_cast<double>(finite) / static_cast<double>(cloud.size());
}

/** \brief Organized cloud of the depths z(v, u) [m]; not positive or NaN = missing. */
template <typename Depth>
pcl::PointCloud<pcl::PointXYZRGB>::Ptr makeCloud(const cv::Size& size,
                                                 const cv::Mat& color,
                                                 const CameraIntrinsics& intrinsics,
                                                 const Depth& depth) {
  constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZRGB>);
  cloud->resize(static_cast<std::size_t>(size.area()));
  cloud->width = static_cast<std::uint32_t>(size.width);
  cloud->height = static_cast<std::uint32_t>(size.height);
  cloud->is_dense = false;
  for (int v = 0; v < size.height; ++v) {
    pcl::PointXYZRGB* row = cloud->data() + static_cast<std::size_t>(v) * cloud->width;
    for (int u = 0; u < size.width; ++u) {
      pcl::PointXYZRGB& p = row[u];
      if (!color.empty()) {
        const auto& c = color.at<cv::Vec3b>(v, u);
        p.b = c[0];
        p.g = c[1];
        p.r = c[2];
      }
      const double z = depth(v, u);
      if (std::isfinite(z) && z > 0.0)
        p.getVector3fMap() = intrinsics.backProject(u, v, z).cast<float>();
      else
        p.x = p.y = p.z = NOTHING;
    }
  }
  return cloud;
}

/** \brief Depths that are searched when none are asked for: a third of the image's
 * width is the largest disparity that leaves enough of the scene in both images. */
detail::DisparityRange
searchLimits(const StereoOptions& options, const StereoIntrinsics& k, int width) {
  const double high = options.min_depth > 0.0 ? k.disparity(options.min_depth)
                                              : width / 3.0 - std::min(0.0, k.doffs);
  const double low = options.max_depth > 0.0 ? k.disparity(options.max_depth)
                                             : std::max(-width / 3.0, -k.doffs);
  // a match lies in the other image, so no disparity is larger than the width
  const double largest = width - 1;
  if (low > largest)
    raise("the farthest depth of " + std::to_string(options.max_depth) +
          " m is nearer than this pair can see; give more than " +
          std::to_string(k.depth(largest)) + " m.");
  if (high < -largest)
    raise("the nearest depth of " + std::to_string(options.min_depth) +
          " m is beyond what this pair can see; give less, or check the calibration.");
  return detail::rangeOf(std::max(low, -largest), std::min(high, largest));
}

} // namespace

void StereoReprojector::setOptions(const StereoOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::StereoReprojector::setOptions] %s; the old options are kept.\n",
              why.c_str());
}

cv::Mat StereoReprojector::computeDisparity(const cv::Mat& left,
                                            const cv::Mat& right,
                                            const StereoIntrinsics& intrinsics) const {
  const cv::Mat grey_left = detail::toGrey(left);
  const cv::Mat grey_right = detail::toGrey(right);
  detail::DisparityRange range = searchLimits(options_, intrinsics, left.cols);
  if (options_.min_depth == 0.0 || options_.max_depth == 0.0)
    range = detail::findRange(grey_left, grey_right, range);
  cv::Mat disparity;
  double share = 0.0;
  if (range.count > 0) {
    disparity = detail::matchPair(grey_left, grey_right, left, range, options_);
    if (options_.refine)
      detail::refineDisparity(grey_left, grey_right, disparity);
    // d + doffs = 0 is infinitely far; less than the matcher's step cannot be told from
    // it
    disparity.setTo(std::numeric_limits<float>::quiet_NaN(),
                    disparity < detail::DISPARITY_STEP - intrinsics.doffs);
    share = static_cast<double>(cv::countNonZero(disparity > -FLT_MAX)) /
            static_cast<double>(disparity.total());
  }
  // The vote costs two more matchings, so it is asked only when there is doubt: little
  // matches, or nearly everything on the far side of where the optical axes cross.
  const double negative = disparity.empty()
                              ? 0.0
                              : static_cast<double>(cv::countNonZero(disparity < 0.0)) /
                                    std::max(1.0, share * double(left.total()));
  const bool doubt = share < 0.4 || (options_.max_depth == 0.0 && negative > 0.9);
  if (options_.check_order && doubt && imagesSeemSwapped(left, right))
    raise("the images match only the other way round; exchange left and right (or, if "
          "all is really beyond the crossing of the axes, give the depth range).");
  if (share < 0.005)
    raise("nothing matches: the images have no texture, or the depth range or the "
          "calibration is wrong; check them.");
  return disparity;
}

StereoResult StereoReprojector::rectified(const cv::Mat& left, const cv::Mat& right) {
  checkType(left, "left");
  checkType(right, "right");
  StereoResult result;
  const auto start = Clock::now();
  calibration_.rectify(left, right, result.left, result.right);
  result.left = toColor(result.left);
  result.intrinsics = calibration_.getIntrinsics();
  result.timings_ms.emplace_back("rectify", millisecondsSince(start));
  return result;
}

StereoResult StereoReprojector::compute(const cv::Mat& left, const cv::Mat& right) {
  StereoResult result = rectified(left, right);
  try {
    match(result);
  } catch (const Exception&) {
    checkOrder(left, right);
    throw;
  }
  return result;
}

void StereoReprojector::checkOrder(const cv::Mat& left, const cv::Mat& right) {
  if (!options_.check_order || calibration_.isRectified())
    return;
  // exchanged raw images do not even lie on the same lines; try the other maps
  cv::Mat other_left, other_right;
  calibration_.rectify(right, left, other_left, other_right);
  if (detail::voteOnOrder(other_left, other_right).given > 0.2)
    raise("the images match only the other way round; exchange left and right.");
}

void StereoReprojector::match(StereoResult& result) const {
  auto start = Clock::now();
  try {
    result.disparity = computeDisparity(result.left, result.right, result.intrinsics);
  } catch (const cv::Exception&) {
    raise("images of " + std::to_string(result.left.cols) + " x " +
          std::to_string(result.left.rows) +
          " px cannot be matched with these settings; give larger images or a smaller "
          "block.");
  }
  result.timings_ms.emplace_back("match", millisecondsSince(start));
  start = Clock::now();
  const detail::DisparityNoise noise = detail::measureNoise(
      detail::toGrey(result.left), detail::toGrey(result.right), result.disparity);
  result.disparity_sigma = noise.sigma;
  result.correlation = noise.correlation;
  // what cannot be told from infinitely far has no depth
  const cv::Mat least = SIGMAS * noise.sigma - result.intrinsics.doffs;
  result.disparity.setTo(std::numeric_limits<float>::quiet_NaN(),
                         result.disparity < least);
  result.timings_ms.emplace_back("noise", millisecondsSince(start));
  start = Clock::now();
  result.cloud = reprojectDisparity(result.disparity, result.left, result.intrinsics);
  result.coverage = finiteShare(*result.cloud);
  result.timings_ms.emplace_back("reproject", millisecondsSince(start));
}

pcl::PointCloud<pcl::PointXYZRGB>::Ptr
reprojectDisparity(const cv::Mat& disparity,
                   const cv::Mat& color,
                   const StereoIntrinsics& intrinsics) {
  if (disparity.type() != CV_32F)
    raise("the disparity must be one channel of 32-bit floats.");
  if (!color.empty() && color.size() != disparity.size())
    raise("the colour image and the disparity differ in size; give two of one size.");
  return makeCloud(
      disparity.size(),
      color.empty() ? color : toColor(color),
      intrinsics,
      [&](int v, int u) { return intrinsics.depth(disparity.at<float>(v, u)); });
}

StereoResult reprojectDepth(const cv::Mat& depth,
                            double unit,
                            const CameraIntrinsics& intrinsics,
                            const cv::Mat& color) {
  std::string why;
  if (depth.empty() || (depth.type() != CV_16U && depth.type() != CV_32F))
    raise("the depth image must be one channel of 16-bit integers or 32-bit floats.");
  if (!color.empty() && color.size() != depth.size())
    raise("the colour image and the depth image differ in size; register them first.");
  if (!(unit > 0.0) || !std::isfinite(unit))
    raise("the unit of depth must be a positive number of metres.");
  StereoResult result;
  static_cast<CameraIntrinsics&>(result.intrinsics) = intrinsics;
  result.intrinsics.width = depth.cols;
  result.intrinsics.height = depth.rows;
  const CameraIntrinsics& camera = result.intrinsics;
  if (!camera.isValid(&why))
    raise(why + "; correct the intrinsics.");
  const auto start = Clock::now();
  if (!color.empty())
    result.left = toColor(color);
  const bool integers = depth.type() == CV_16U;
  result.cloud = makeCloud(depth.size(), result.left, camera, [&](int v, int u) {
    return unit * (integers ? static_cast<double>(depth.at<std::uint16_t>(v, u))
                            : static_cast<double>(depth.at<float>(v, u)));
  });
  result.coverage = finiteShare(*result.cloud);
  result.timings_ms.emplace_back("reproject", millisecondsSince(start));
  return result;
}

bool imagesSeemSwapped(const cv::Mat& left, const cv::Mat& right) {
  return detail::voteOnOrder(left, right).exchangedWins();
}

} // namespace pcl_sq
