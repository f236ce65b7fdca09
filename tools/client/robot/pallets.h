// SPDX-License-Identifier: Apache-2.0
// Pallets of a robot, for programs that show them: the property `pallets` of its module says where places are and which
// variable counts those in use. The robot itself does not read it.

#pragma once

#include <indurop/result.h>

#include <array>
#include <string>
#include <vector>

#include "control/robot/files/list_bodies.h"

namespace indurop::tools {

struct Pallet {
  std::string name;                             // of the point that is its first place
  std::string frame;                            // of that point
  std::vector<std::array<double, 3>> places{};  // mm, in the frame of the base, in the order in which they are used
  std::array<double, 3> orientation{};          // deg, roll pitch yaw of the frame
  std::array<double, 3> size{};                 // mm from one place to the next along x, y and z; 0: there is one
  std::string used;                             // variable with the number of places in use, counted from the first
};

inline constexpr const char* kPallets = "pallets";  // the property

// Reads "CORNER y 3 40 x 2 60 PALLET::parts; ...": the first place is the point CORNER, the next ones are 40 mm apart
// along y of its frame, three of them, then follows the next row along x. Returns the error of the first wrong pallet.
Result<std::vector<Pallet>, std::string> pallets_in(const std::string& text, const robot::ListedBodies& bodies);

}  // namespace indurop::tools
