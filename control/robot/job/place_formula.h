// SPDX-License-Identifier: Apache-2.0
// A place that a job computes, "camera : POSE x, y, 0 RPY 0, 0, a", in the order of a stack machine (postfix).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "control/robot/job/formula.h"

namespace indurop::robot {

enum class PlaceOp : std::uint8_t {
  Pose,     // index: the first one of six formulas, mm and degrees
  Named,    // index: point or frame of the book
  Here,     // where the robot is
  World,    // the world as seen from the workpiece, if axes move that
  Found,    // where UNTIL ended a motion
  Inverse,  // of the last one
  Joined,   // the last one, given in the one before
  In        // the one before, given in the last one, whose axes count for offsets
};

struct PlacePart {
  PlaceOp op = PlaceOp::Pose;
  bool is_frame = false;
  int index = -1;
};

// A point or frame that is declared with this name comes first.
inline constexpr std::string_view kWorld = "WORLD";

struct PlaceFormula {
  static constexpr int kMaxPlaces = 8;  // on the stack

  std::size_t first = 0;  // of its parts in the book
  std::size_t count = 0;
  unsigned column = 0;  // in its line
  Reads reads{};
};

}  // namespace indurop::robot
