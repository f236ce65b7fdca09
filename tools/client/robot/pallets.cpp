// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/pallets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/base/word_values.h"
#include "tools/client/text/suggest.h"

namespace indurop::tools {
namespace {

using Place = std::array<double, 3>;
constexpr std::size_t kMostPlaces = 2000;
constexpr std::string_view kForm =
    "POINT, then axis, number and mm for each direction, then the variable that counts: "
    "CORNER y 3 40 x 2 60 PALLET::parts";

// Places along one axis of the frame.
struct Direction {
  std::size_t axis = 0;
  std::size_t count = 0;
  double pitch = 0;  // mm
};

// Returns the axes of a frame in that of the base, from roll, pitch and yaw.
std::array<Place, 3> axes_of(const Place& orientation) {
  constexpr double kRadians = std::numbers::pi / 180;
  const auto [sr, cr] = std::pair(std::sin(orientation[0] * kRadians), std::cos(orientation[0] * kRadians));
  const auto [sp, cp] = std::pair(std::sin(orientation[1] * kRadians), std::cos(orientation[1] * kRadians));
  const auto [sy, cy] = std::pair(std::sin(orientation[2] * kRadians), std::cos(orientation[2] * kRadians));
  return {{{cy * cp, sy * cp, -sp},
           {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
           {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}}};
}

std::optional<Direction> direction_in(const std::string& axis, const std::string& count, const std::string& pitch) {
  constexpr std::string_view kAxes = "xyz";
  const std::size_t found = axis.size() == 1 ? kAxes.find(axis[0]) : std::string_view::npos;
  const auto many = base::number_in(count);
  const auto far = base::number_in(pitch);
  const bool sane = found != std::string_view::npos && many && far && *many >= 1 && *many <= kMostPlaces &&
                    *many == std::floor(*many) && *far != 0;
  return sane ? std::optional(Direction{found, static_cast<std::size_t>(*many), *far}) : std::nullopt;
}

void add_places(const Place& first, const std::vector<Direction>& directions, Pallet& to) {
  const std::array<Place, 3> axes = axes_of(to.orientation);
  to.places = {first};
  for (const Direction& one : directions) {
    const std::size_t row = to.places.size();
    to.size[one.axis] = one.count > 1 ? std::abs(one.pitch) : to.size[one.axis];
    for (std::size_t i = row; i < row * one.count; ++i) {
      const std::size_t steps = i / row;
      const double way = one.pitch * static_cast<double>(steps);
      Place place = to.places[i % row];
      for (std::size_t k = 0; k < place.size(); ++k) {
        place[k] += way * axes[one.axis][k];
      }
      to.places.push_back(place);
    }
  }
}

std::string no_such_point(const std::string& name, const robot::ListedBodies& bodies) {
  std::vector<std::string> known;
  for (const robot::ListedFrame& frame : bodies.work_frames) {
    for (const auto& point : frame.points) {
      known.push_back(point.name);
    }
  }
  return fmt::format("there is no point '{}' in a work frame (POINT {} = POSE ... IN f).{}", name, name,
                     did_you_mean(name, known));
}

Result<Pallet, std::string> pallet_in(const std::string& text, const robot::ListedBodies& bodies) {
  std::vector<std::string> words;
  std::istringstream all(text);
  for (std::string word; all >> word;) {
    words.push_back(std::move(word));
  }
  constexpr std::size_t kEach = 3;  // words of a direction
  if (words.size() < kEach + 2 || (words.size() - 2) % kEach != 0 || words.size() > 3 * kEach + 2) {
    return fmt::format("'{}' is no pallet; write {}", text, kForm);
  }
  std::vector<Direction> directions;
  std::size_t places = 1;
  for (std::size_t i = 1; i + kEach < words.size(); i += kEach) {
    const auto one = direction_in(words[i], words[i + 1], words[i + 2]);
    if (!one) {
      return fmt::format("'{} {} {}' is no direction; write {}", words[i], words[i + 1], words[i + 2], kForm);
    }
    directions.push_back(*one);
    places *= one->count;
  }
  if (places > kMostPlaces) {
    return fmt::format("'{}' has {} places; at most {} are shown", words[0], places, kMostPlaces);
  }
  for (const robot::ListedFrame& frame : bodies.work_frames) {
    const auto point =
        std::find_if(frame.points.begin(), frame.points.end(), [&](const auto& one) { return one.name == words[0]; });
    if (point != frame.points.end()) {
      Pallet found{words[0], frame.name, {}, frame.orientation, {}, words.back()};
      add_places(point->position, directions, found);
      return found;
    }
  }
  return no_such_point(words[0], bodies);
}

}  // namespace

Result<std::vector<Pallet>, std::string> pallets_in(const std::string& text, const robot::ListedBodies& bodies) {
  std::vector<Pallet> out;
  std::istringstream all(text);
  for (std::string one; std::getline(all, one, ';');) {
    if (one.find_first_not_of(" \t\r\n") == std::string::npos) {
      continue;
    }
    auto found = pallet_in(one, bodies);
    if (!found) {
      return found.error();
    }
    out.push_back(std::move(found).value());
  }
  return out;
}

}  // namespace indurop::tools
