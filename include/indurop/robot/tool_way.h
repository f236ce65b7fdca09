// SPDX-License-Identifier: Apache-2.0
// Where the tool will go in a motion that has been planned, and how fast.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::robot {

inline constexpr std::size_t kWayPlaces = 24;  // maximum number of places of a motion
inline constexpr std::size_t kWaysAhead = 3;   // maximum number of motions: the present one, and those planned after it

// Places in the order in which the tool's point comes to them; between two of them it goes nearly straight, and its
// speed changes nearly uniformly. They are in the frame of the base or, if axes move the workpiece, in that of the
// workpiece. A rounded corner belongs to the motion after it. Of a weave, it is the line in its middle.
struct ToolWay {
  std::uint32_t number = 0;  // differs for each planned motion, and if that is planned again
  std::uint32_t count = 0;   // of places
  std::array<std::array<float, 3>, kWayPlaces> place{};  // mm, x y z
  std::array<float, kWayPlaces> speed{};                 // mm/s, at full override
};

}  // namespace indurop::robot
