// SPDX-License-Identifier: Apache-2.0
#include "surroundings.h"

#include <algorithm>
#include <cmath>

#include <indurop/indurop.h>

#include <indurop/generated.h>

namespace {

constexpr double kBeltSpeed = 250;    // mm/s
constexpr double kNextPart = 500;     // mm behind the one before
constexpr double kFingers = 1 / 0.2;  // of the way per second
constexpr double kPartWidth = 0.4;    // of the opening
constexpr double kPalletTime = 1.5;   // s
constexpr double kReach = 25;         // mm the tool may be off

bool near(const Tool& tool, double x, double y, double z) {
  return std::hypot(tool.x - x, tool.y - y, tool.z - z) < kReach;
}

}  // namespace

void Surroundings::step(double seconds, const Commands& commands, const Tool& tool) {
  move_belt(seconds, commands.conveyor);
  move_gripper(seconds, commands.close_gripper, tool);
  exchange_pallet(seconds, commands.next_pallet);
  glue(commands.open_valve, tool);
}

void Surroundings::move_belt(double seconds, bool runs) {
  if (runs) {
    belt_ = std::min(kBelt, belt_ + kBeltSpeed * seconds);
  }
}

void Surroundings::move_gripper(double seconds, bool closes, const Tool& tool) {
  const double stop = holds_ ? kPartWidth : 0;
  opening_ = closes ? std::max(stop, opening_ - kFingers * seconds) : std::min(1.0, opening_ + kFingers * seconds);
  if (closes && !holds_ && opening_ <= kPartWidth && part_at_end() &&
      near(tool, CELL::PICK_X, CELL::PICK_Y, CELL::PICK_Z)) {
    holds_ = true;
    opening_ = kPartWidth;
    belt_ -= kNextPart;
  }
  if (!closes && holds_ && opening_ > kPartWidth) {
    holds_ = false;
    if (away_ <= 0 && on_pallet_ < kPallet && near(tool, CELL::PLACE_X, CELL::PLACE_Y, CELL::PLACE_Z)) {
      ++on_pallet_;
      ++placed_;
    } else {
      ++lost_;
    }
  }
}

void Surroundings::exchange_pallet(double seconds, bool wanted) {
  if (away_ > 0) {
    away_ -= seconds;
  } else if (wanted && on_pallet_ >= kPallet) {
    on_pallet_ = 0;
    away_ = kPalletTime;
  }
}

// A dot each time the valve opens.
void Surroundings::glue(bool open, const Tool& tool) {
  if (open && !glues_) {
    const double x = std::clamp(tool.x, double{CELL::GLUE_FROM_X}, double{CELL::GLUE_TO_X});
    if (near(tool, x, CELL::GLUE_Y, CELL::GLUE_Z)) {
      ++dots_;
    } else {
      ++spilled_;
    }
  }
  glues_ = open;
}
