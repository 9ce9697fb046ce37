// SPDX-License-Identifier: BSD-3-Clause
#include "input/missing_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>

namespace pcl_sq::app {

namespace {

constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();

/** \brief Points that share a coordinate to the last digit are no measurements from a
 * handful on. */
constexpr std::size_t MANY = 3;

/** \brief How many times the size of all else a shared value lies away from all else:
 * a real wall so far behind would be seen as a few points with noise. */
constexpr double FAR = 4.0;

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

template <typename Predicate>
std::size_t drop(Shape& shape, Predicate isMissing) {
  std::size_t count = 0;
  for (Eigen::Vector3d& p : shape.points)
    if (isMissing(p)) {
      p.setConstant(NAN_VALUE);
      ++count;
    }
  return count;
}

/** \brief Ends of an axis: the outermost value, how many points share it, and the next
 * one inside. */
struct End {
  double outermost = -std::numeric_limits<double>::infinity();
  double next = -std::numeric_limits<double>::infinity();
  std::size_t sharing = 0;

  void add(double value) {
    if (value > outermost) {
      next = outermost;
      outermost = value;
      sharing = 1;
    } else if (value == outermost)
      ++sharing;
    else if (value > next)
      next = value;
  }
};

/** \brief One far shared value, of any axis and side. \return a sentence, or nothing */
std::string dropFarValue(Shape& shape) {
  End ends[3][2];
  for (const Eigen::Vector3d& p : shape.points)
    if (!std::isnan(p.x()))
      for (int axis = 0; axis < 3; ++axis) {
        ends[axis][0].add(p[axis]);
        ends[axis][1].add(-p[axis]);
      }
  for (const int axis : {2, 1, 0}) // depth first: the usual one
    for (const int side : {0, 1}) {
      const End& end = ends[axis][side];
      if (end.sharing < MANY || !std::isfinite(end.next))
        continue;
      const double value = side == 0 ? end.outermost : -end.outermost;
      Eigen::AlignedBox3d rest;
      std::size_t others = 0;
      for (const Eigen::Vector3d& p : shape.points)
        if (!std::isnan(p.x()) && p[axis] != value) {
          rest.extend(p);
          ++others;
        }
      if (others < MANY || !(end.outermost - end.next > FAR * rest.diagonal().norm()))
        continue;
      const std::size_t count =
          drop(shape, [&](const Eigen::Vector3d& p) { return p[axis] == value; });
      return std::to_string(count) + " points with " + static_cast<char>('x' + axis) +
             " = " + numberText(value) + " taken as missing";
    }
  return {};
}

/** \brief Points with the same coordinates to the last bit have the same one. */
std::uint64_t placeOf(const Eigen::Vector3d& p) {
  std::uint64_t mixed = 0;
  for (const double coordinate : p) {
    const double value = coordinate + 0.0; // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    mixed = (mixed ^ bits) * 0x9e3779b97f4a7c15U; // as splitmix64
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
    mixed ^= mixed >> 27U;
  }
  return mixed;
}

/** \brief Places that hold far more points than any others do.
 *
 * Measurements meet to the last bit where a sensor's steps are coarse, and all of them
 * do in a cloud that was joined with itself. How often, the other places tell: 19 of 20
 * hold no more than so many. A real place holds several times that only where points
 * are much denser than elsewhere; a marker holds as many as were not measured. \return
 * sorted */
std::vector<std::uint64_t> crowdedPlaces(const Shape& shape) {
  constexpr std::size_t HANDFUL = 8, FEWEST_PLACES = 10;
  std::vector<std::uint64_t> places;
  places.reserve(shape.points.size());
  for (const Eigen::Vector3d& p : shape.points)
    if (!std::isnan(p.x()))
      places.push_back(placeOf(p));
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> counts;
  const auto eachPlace = [&places](auto&& use) {
    for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
      while (end < places.size() && places[end] == places[first])
        ++end;
      use(places[first], end - first);
    }
  };
  eachPlace([&](std::uint64_t, std::size_t count) { counts.push_back(count); });
  if (counts.size() <= FEWEST_PLACES)
    return {};
  const auto usual = counts.begin() + std::ptrdiff_t((counts.size() - 1) * 19 / 20);
  std::nth_element(counts.begin(), usual, counts.end());
  const std::size_t most = HANDFUL * *usual;
  std::vector<std::uint64_t> crowded;
  eachPlace([&](std::uint64_t place, std::size_t count) {
    if (count > most)
      crowded.push_back(place);
  });
  return crowded;
}

/** \brief Markers that lie near or within the cloud. \return a sentence for each */
std::vector<std::string> dropCrowdedPlaces(Shape& shape) {
  std::vector<std::string> notes;
  for (const std::uint64_t place : crowdedPlaces(shape)) {
    Eigen::Vector3d marker = Eigen::Vector3d::Zero();
    const std::size_t count = drop(shape, [&](const Eigen::Vector3d& p) {
      const bool here = !std::isnan(p.x()) && placeOf(p) == place;
      if (here)
        marker = p;
      return here;
    });
    notes.push_back(std::to_string(count) + " points at " + numberText(marker.x()) +
                    " " + numberText(marker.y()) + " " + numberText(marker.z()) +
                    " taken as missing");
  }
  return notes;
}

/** \brief Far values, of all axes and sides. \return a sentence for each */
std::vector<std::string> dropFarValues(Shape& shape) {
  std::vector<std::string> notes;
  for (int round = 0; round < 6; ++round) { // a value for each axis and side at most
    const std::string note = dropFarValue(shape);
    if (note.empty())
      break;
    notes.push_back(note);
  }
  return notes;
}

} // namespace

std::vector<std::string> dropMissingPoints(Shape& shape) {
  std::vector<std::string> notes;
  std::size_t unmarked = 0, zeros = 0;
  for (const Eigen::Vector3d& p : shape.points) {
    unmarked += !p.allFinite();
    zeros += (p.array() == 0.0).all();
  }
  drop(shape, [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  const bool organized = shape.height > 1;
  if (unmarked > 0 && !organized) // of an image they are as usual as they are harmless
    notes.push_back(std::to_string(unmarked) +
                    " points without finite numbers left out");
  if (zeros > 1 || (organized && zeros > 0)) {
    drop(shape, [](const Eigen::Vector3d& p) { return (p.array() == 0.0).all(); });
    if (!organized || zeros < shape.points.size())
      notes.push_back(std::to_string(zeros) + " points at 0 0 0 taken as missing");
  }
  const auto tell = [&notes](const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
    return !more.empty();
  };
  tell(dropFarValues(shape));
  if (tell(dropCrowdedPlaces(shape))) // they made all else look large
    tell(dropFarValues(shape));
  return notes;
}

} // namespace pcl_sq::app
