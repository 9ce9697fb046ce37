// SPDX-License-Identifier: BSD-3-Clause
#include "util/cloud_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t LINKS = 8;
constexpr double LONGEST = 2.0;    ///< link, over the middle distance to the last one
constexpr double PERSISTENT = 3.0; ///< length of a limb, over the same

/** \brief One connected set of points on the way down. */
struct Branch {
  Segment open;        ///< points since the last junction
  double birth = 0.0;  ///< height at which those begin
  bool forked = false; ///< whether limbs have met in it
};

/** \brief Sets that are joined, each with a representative. */
class Joined {
public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int of(int i) {
    while (parent_[std::size_t(i)] != i) {
      int& up = parent_[std::size_t(i)];
      up = parent_[std::size_t(up)];
      i = up;
    }
    return i;
  }
  void join(int from, int to) { parent_[std::size_t(from)] = to; }

private:
  std::vector<int> parent_;
};

} // namespace

CloudGraph::CloudGraph(const Eigen::Matrix3Xd& points)
    : points_(points), links_(static_cast<std::size_t>(points.cols())) {
  const auto n = static_cast<std::size_t>(points.cols());
  int axis;
  (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff(&axis);
  // in order along the longest side, only points nearby in it need a look
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return points(axis, a) != points(axis, b) ? points(axis, a) < points(axis, b)
                                              : a < b;
  });
  using Near = std::pair<double, int>;
  std::vector<std::array<Near, LINKS>> nearest(n);
  std::vector<double> last(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int self = order[i];
    auto& found = nearest[std::size_t(self)];
    found.fill({1e300, -1});
    const auto look = [&](int other) {
      const Eigen::Vector3d d = points.col(other) - points.col(self);
      if (d[axis] * d[axis] > found.back().first)
        return false;
      const Near near(d.squaredNorm(), other);
      const auto place = std::upper_bound(found.begin(), found.end(), near);
      if (place != found.end()) {
        std::copy_backward(place, found.end() - 1, found.end());
        *place = near;
      }
      return true;
    };
    for (std::size_t k = i; k > 0 && look(order[k - 1]); --k) {
    }
    for (std::size_t k = i + 1; k < n && look(order[k]); ++k) {
    }
    last[std::size_t(self)] = found.back().first;
  }
  std::nth_element(last.begin(), last.begin() + std::ptrdiff_t(n / 2), last.end());
  reach_ = std::sqrt(last[n / 2]);
  for (std::size_t i = 0; i < n; ++i)
    for (const auto& [square, other] : nearest[i])
      if (other >= 0 && square < LONGEST * LONGEST * reach_ * reach_) {
        links_[i].push_back(other);
        links_[std::size_t(other)].push_back(int(i));
      }
}

std::vector<Segment> CloudGraph::components(const Segment& some) const {
  std::vector<bool> waiting(links_.size(), false);
  for (const int i : some)
    waiting[std::size_t(i)] = true;
  std::vector<Segment> found;
  for (const int first : some) {
    if (!waiting[std::size_t(first)])
      continue;
    waiting[std::size_t(first)] = false;
    Segment component = {first};
    for (std::size_t k = 0; k < component.size(); ++k)
      for (const int next : links_[std::size_t(component[k])])
        if (waiting[std::size_t(next)]) {
          waiting[std::size_t(next)] = false;
          component.push_back(next);
        }
    found.push_back(std::move(component));
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size();
  });
  return found;
}

bool CloudGraph::touch(const Segment& a, const Segment& b) const {
  std::vector<bool> in_b(links_.size(), false);
  for (const int i : b)
    in_b[std::size_t(i)] = true;
  return std::any_of(a.begin(), a.end(), [&](int i) {
    const auto& links = links_[std::size_t(i)];
    return std::any_of(
        links.begin(), links.end(), [&](int k) { return bool(in_b[std::size_t(k)]); });
  });
}

std::vector<double> CloudGraph::wayFromMiddle(const Segment& some) const {
  std::vector<double> way(links_.size(), 1e300);
  std::vector<bool> own(links_.size(), false);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int i : some) {
    own[std::size_t(i)] = true;
    middle += points_.col(i) / double(some.size());
  }
  const int start = *std::min_element(some.begin(), some.end(), [&](int a, int b) {
    return (points_.col(a) - middle).squaredNorm() <
           (points_.col(b) - middle).squaredNorm();
  });
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  way[std::size_t(start)] = 0.0;
  next.emplace(0.0, start);
  while (!next.empty()) {
    const auto [length, i] = next.top();
    next.pop();
    if (length > way[std::size_t(i)])
      continue;
    for (const int k : links_[std::size_t(i)]) {
      const double far = length + (points_.col(k) - points_.col(i)).norm();
      if (own[std::size_t(k)] && far < way[std::size_t(k)]) {
        way[std::size_t(k)] = far;
        next.emplace(far, k);
      }
    }
  }
  for (double& w : way) // what does not hang together with the middle
    if (w > 1e299)
      w = 0.0;
  return way;
}

std::vector<Segment> CloudGraph::branches(const Segment& some,
                                          const std::vector<double>& height,
                                          std::size_t fewest) const {
  Segment order = some;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const double ha = height[std::size_t(a)], hb = height[std::size_t(b)];
    return ha != hb ? ha > hb : a < b;
  });
  Joined joined(links_.size());
  std::vector<bool> passed(links_.size(), false);
  std::vector<Branch> branch(links_.size());
  std::vector<Segment> closed;
  const double least = PERSISTENT * reach_;
  for (const int v : order) {
    const double level = height[std::size_t(v)];
    passed[std::size_t(v)] = true;
    std::vector<int> meeting;
    for (const int k : links_[std::size_t(v)])
      if (passed[std::size_t(k)] && k != v) {
        const int root = joined.of(k);
        if (std::find(meeting.begin(), meeting.end(), root) == meeting.end())
          meeting.push_back(root);
      }
    if (meeting.empty()) {
      branch[std::size_t(v)].birth = level;
      branch[std::size_t(v)].open = {v};
      continue;
    }
    const auto isLimb = [&](int root) {
      const Branch& b = branch[std::size_t(root)];
      return b.birth - level >= least && b.open.size() >= fewest;
    };
    std::sort(meeting.begin(), meeting.end(), [&](int a, int b) {
      const Branch &x = branch[std::size_t(a)], &y = branch[std::size_t(b)];
      return x.open.size() != y.open.size() ? x.open.size() > y.open.size() : a < b;
    });
    const auto counts = [&](int root) {
      return isLimb(root) || branch[std::size_t(root)].forked;
    };
    const auto limbs = std::count_if(meeting.begin(), meeting.end(), counts);
    Branch next;
    next.birth = limbs > 1 ? level : -1e300;
    for (const int root : meeting) {
      Branch& b = branch[std::size_t(root)];
      next.forked = next.forked || b.forked || limbs > 1;
      if (limbs == 0 || (limbs == 1 && counts(root)))
        next.birth = std::max(next.birth, b.birth);
      if (limbs > 1 && isLimb(root))
        closed.push_back(std::move(b.open));
      else
        next.open.insert(next.open.end(), b.open.begin(), b.open.end());
    }
    for (const int root : meeting)
      branch[std::size_t(root)] = {};
    next.open.push_back(v);
    const int root = meeting.front();
    for (const int other : meeting)
      joined.join(other, root);
    joined.join(v, root);
    branch[std::size_t(root)] = std::move(next);
  }
  if (closed.empty())
    return {};
  for (Branch& b : branch)
    if (b.open.size() >= fewest)
      closed.push_back(std::move(b.open));
  // what is left over goes to what it hangs together with
  std::vector<int> owner(links_.size(), -2);
  for (const int i : some)
    owner[std::size_t(i)] = -1;
  std::vector<int> queue;
  for (std::size_t k = 0; k < closed.size(); ++k)
    for (const int i : closed[k]) {
      owner[std::size_t(i)] = int(k);
      queue.push_back(i);
    }
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const int next : links_[std::size_t(queue[k])])
      if (owner[std::size_t(next)] == -1) {
        owner[std::size_t(next)] = owner[std::size_t(queue[k])];
        closed[std::size_t(owner[std::size_t(next)])].push_back(next);
        queue.push_back(next);
      }
  for (const int i : some)
    if (owner[std::size_t(i)] == -1)
      closed.front().push_back(i);
  return closed;
}

std::vector<std::vector<Segment>> CloudGraph::limbs(const Segment& some,
                                                    const Eigen::Matrix3d& axes,
                                                    std::size_t fewest) const {
  std::vector<std::vector<Segment>> found;
  const auto add = [&](std::vector<Segment> segments) {
    if (segments.size() > 1)
      found.push_back(std::move(segments));
  };
  add(branches(some, wayFromMiddle(some), fewest));
  std::vector<double> height(links_.size(), 0.0);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      for (const int i : some)
        height[std::size_t(i)] = sign * axes.col(k).dot(points_.col(i));
      add(branches(some, height, fewest));
    }
  return found;
}

} // namespace pcl_sq::detail
