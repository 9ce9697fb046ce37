// SPDX-License-Identifier: BSD-3-Clause
// The cut of least cost through an image, of which only some pixels are open.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {

/** \brief Sum of the square differences of colours between two parts of an image. */
inline double squareDifferences(const cv::Mat& image,
                                const cv::Size& size,
                                const cv::Point& from,
                                const cv::Point& to) {
  return cv::norm(
      image(cv::Rect(from, size)), image(cv::Rect(to, size)), cv::NORM_L2SQR);
}

/** \brief What borders between neighbours of an image cost: the less, the more they
 * differ. A look-up for each difference, for there are more neighbours than those. */
class Borders {
public:
  /** \param[in] image CV_8UC3 \param[in] usual square difference
   * \param[in] together cost between two pixels of one colour
   * \param[in] least share of it that any border costs, above 0 */
  Borders(const cv::Mat& image, double usual, double together, double least)
      : image_(image) {
    const double last =
        std::min(std::ceil(-2.0 * std::log(least) * usual), 3.0 * 255.0 * 255.0);
    for (double square = 0.0; square <= last; ++square) {
      const double like = std::exp(-square / (2.0 * usual));
      beside_.push_back(together * std::max(least, like));
      diagonal_.push_back(together * std::max(least, like / std::sqrt(2.0)));
    }
  }

  double cost(const cv::Point& a, const cv::Point& b) const {
    const cv::Vec3i d =
        cv::Vec3i(image_.at<cv::Vec3b>(a)) - cv::Vec3i(image_.at<cv::Vec3b>(b));
    const std::vector<double>& costs = a.x == b.x || a.y == b.y ? beside_ : diagonal_;
    const int square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    return costs[std::min(std::size_t(square), costs.size() - 1)];
  }

private:
  cv::Mat image_;
  std::vector<double> beside_, diagonal_; ///< by the square difference
};

/** \brief The cut of least cost. \param[in] odds CV_32F \param[in] open pixels whose
 * side is looked for; the others are on that of their odds */
inline cv::Mat
minimumCut(const Borders& borders, const cv::Mat& odds, const cv::Mat& open) {
  const cv::Point beside[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
  const cv::Rect all({}, odds.size());
  cv::Mat mask = (odds > 0.0F);
  const int count = cv::countNonZero(open);
  if (count == 0)
    return mask;
  const cv::Rect inner = cv::boundingRect(open);
  const cv::Rect part = (inner - cv::Point(1, 1) + cv::Size(2, 2)) & all;
  cv::detail::GCGraph<double> graph(unsigned(count), 8 * unsigned(count));
  cv::Mat index(odds.size(), CV_32S, cv::Scalar(-1));
  for (int y = inner.y; y < inner.br().y; ++y)
    for (int x = inner.x; x < inner.br().x; ++x)
      if (open.at<std::uint8_t>(y, x) != 0) {
        const auto o = double(odds.at<float>(y, x));
        const int i = graph.addVtx();
        index.at<int>(y, x) = i;
        graph.addTermWeights(i, std::max(o, 0.0), std::max(-o, 0.0));
      }
  for (int y = part.y; y < part.br().y; ++y)
    for (int x = part.x; x < part.br().x; ++x)
      for (const cv::Point& d : beside) {
        const cv::Point a(x, y), b = a + d;
        if (!part.contains(b))
          continue;
        const int i = index.at<int>(a), k = index.at<int>(b);
        if (i < 0 && k < 0)
          continue;
        const double weight = borders.cost(a, b);
        if (i >= 0 && k >= 0)
          graph.addEdges(i, k, weight, weight);
        else { // the other pixel's side is known
          const bool object = odds.at<float>(i >= 0 ? b : a) > 0.0F;
          graph.addTermWeights(
              std::max(i, k), object ? weight : 0.0, object ? 0.0 : weight);
        }
      }
  graph.maxFlow();
  for (int y = inner.y; y < inner.br().y; ++y)
    for (int x = inner.x; x < inner.br().x; ++x)
      if (const int i = index.at<int>(y, x); i >= 0)
        mask.at<std::uint8_t>(y, x) = graph.inSourceSegment(i) ? 255 : 0;
  return mask;
}

} // namespace pcl_sq::detail
