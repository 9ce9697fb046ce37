// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/pipeline/outline_edges.h"

#include "pcl_sq/object_view.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl_sq::detail {
namespace {

// a rectangle drawn onto a surface is cut off on all four sides; one side may happen to
// be the surface's edge, a thing has more
constexpr double PIECE = 0.75;
// of the outline: less tells of one side only
constexpr double ENOUGH = 0.25;
constexpr int RIM = 3;         // half a matching window, which blurs steps [px]
constexpr int PATCH = 2;       // half the side of what is looked at [px]
constexpr int INSIDE = 6;      // its middle, from the outline, clear of the rim [px]
constexpr int OUTSIDE = 8;     // and of a step that matching has widened [px]
constexpr int LOOKED_AT = 300; // pixels of the outline: shares are known to 3 %
constexpr int MAX_POINTS = 3000;
constexpr int MAX_PLANES = 3; // wall, table, and a front
constexpr double SIGMAS = 3.0;
// [px] that the images themselves must tell: where they do not, the matcher's price of
// a step by a whole pixel lets the object's surface go on over what has no texture
constexpr double MATCHED = 1.0 / SIGMAS;

float medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Place = Eigen::Vector3d; ///< column, row, disparity [px]

/** \brief Whether a pixel was matched by what the images show of it. */
bool isMatched(const StereoResult& stereo, int v, int u) {
  return std::isfinite(stereo.disparity.at<float>(v, u)) &&
         double(stereo.disparity_sigma.at<float>(v, u)) <= MATCHED;
}

std::vector<Place> placesWithin(const StereoResult& stereo, const cv::Mat& inner) {
  const int count = cv::countNonZero(inner);
  const int step =
      std::max(1, static_cast<int>(std::sqrt(double(count) / double(MAX_POINTS))));
  std::vector<Place> places;
  for (int v = 0; v < inner.rows; v += step)
    for (int u = 0; u < inner.cols; u += step)
      if (inner.at<std::uint8_t>(v, u) != 0 && isMatched(stereo, v, u))
        places.emplace_back(u, v, stereo.disparity.at<float>(v, u));
  return places;
}

/** \brief The object's planes, the largest first, with normals towards larger
 * disparities: what is above one is nearer. */
std::vector<TableModel> planesOf(std::vector<Place> rest, double noise) {
  const Place nearest(0.0, 0.0, 1e9);
  std::vector<TableModel> planes;
  TableModel plane;
  for (int k = 0; k < MAX_PLANES && findPlane(rest, nearest, SIGMAS * noise, plane);
       ++k) {
    plane.noise = std::max(plane.noise, noise);
    planes.push_back(plane);
    rest.erase(std::remove_if(rest.begin(),
                              rest.end(),
                              [&](const Place& p) {
                                return std::abs(plane.height(p)) <=
                                       SIGMAS * plane.noise;
                              }),
               rest.end());
  }
  return planes;
}

/** \brief The median disparity of a patch's pixels that are the object's, or not. */
std::optional<Place> lookAt(const StereoResult& stereo,
                            const cv::Mat& mask,
                            const cv::Point& middle,
                            bool of_object) {
  std::vector<float> found;
  const cv::Rect patch =
      cv::Rect(middle.x - PATCH, middle.y - PATCH, 2 * PATCH + 1, 2 * PATCH + 1) &
      cv::Rect({}, mask.size());
  for (int v = patch.y; v < patch.br().y; ++v)
    for (int u = patch.x; u < patch.br().x; ++u)
      if ((mask.at<std::uint8_t>(v, u) != 0) == of_object && isMatched(stereo, v, u))
        found.push_back(stereo.disparity.at<float>(v, u));
  if (found.size() < std::size_t(2 * PATCH + 1)) // a line's worth
    return std::nullopt;
  return Place(middle.x, middle.y, medianOf(found));
}

enum class Beyond { HIDDEN, OTHER, SAME }; // OTHER: also what was not matched

Beyond beyond(const std::vector<TableModel>& planes,
              const std::optional<Place>& inside,
              const std::optional<Place>& outside) {
  if (!inside || !outside)
    return Beyond::OTHER;
  bool on_plane = false, hidden = true;
  for (const TableModel& plane : planes) {
    const double tolerance = SIGMAS * plane.noise;
    if (std::abs(plane.height(*inside)) > tolerance)
      continue;
    on_plane = true;
    if (std::abs(plane.height(*outside)) <= tolerance)
      return Beyond::SAME;
    hidden = hidden && plane.height(*outside) > 0.0;
  }
  return on_plane && hidden ? Beyond::HIDDEN : Beyond::OTHER;
}

} // namespace

bool OutlineEdges::isPiece() const {
  return own >= ENOUGH && goes_on >= PIECE;
}

OutlineEdges outlineEdges(const StereoResult& stereo, const cv::Mat& mask) {
  OutlineEdges edges;
  if (stereo.disparity.empty() || stereo.disparity_sigma.empty() ||
      mask.size() != stereo.disparity.size())
    return edges;
  cv::Mat inner, body, smooth, right, down;
  cv::erode(mask, inner, cv::Mat::ones(2 * RIM + 1, 2 * RIM + 1, CV_8U));
  cv::erode(mask, body, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  mask.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, RIM);
  cv::Sobel(smooth, right, CV_32F, 1, 0);
  cv::Sobel(smooth, down, CV_32F, 0, 1);
  std::vector<cv::Point> outline;
  for (int v = RIM; v < mask.rows - RIM; ++v)
    for (int u = RIM; u < mask.cols - RIM; ++u)
      if (mask.at<std::uint8_t>(v, u) != 0 && body.at<std::uint8_t>(v, u) == 0)
        outline.emplace_back(u, v);
  const std::vector<Place> places = placesWithin(stereo, inner);
  if (outline.empty() || places.empty())
    return edges;
  std::vector<float> sigmas;
  for (const Place& p : places)
    sigmas.push_back(stereo.disparity_sigma.at<float>(int(p.y()), int(p.x())));
  const std::vector<TableModel> planes = planesOf(places, double(medianOf(sigmas)));
  const std::size_t step = std::max<std::size_t>(1, outline.size() / LOOKED_AT);
  int all = 0, own = 0, same = 0;
  for (std::size_t i = 0; i < outline.size(); i += step) {
    const cv::Point2f inwards(right.at<float>(outline[i]), down.at<float>(outline[i]));
    const double length = std::hypot(inwards.x, inwards.y);
    ++all;
    if (!(length > 0.0))
      continue;
    const cv::Point2d unit(inwards.x / length, inwards.y / length);
    const cv::Point2d here = outline[i];
    const Beyond what =
        beyond(planes,
               lookAt(stereo, mask, cv::Point(here + INSIDE * unit), true),
               lookAt(stereo, mask, cv::Point(here - OUTSIDE * unit), false));
    own += what != Beyond::HIDDEN;
    same += what == Beyond::SAME;
  }
  edges.own = double(own) / double(all);
  edges.goes_on = own > 0 ? double(same) / double(own) : 0.0;
  return edges;
}

} // namespace pcl_sq::detail
