// SPDX-License-Identifier: Apache-2.0
// Covers a surface and its interior with a few solids. The surface is cut where solids extend too far beyond it, each
// time where that saves most.

#pragma once

#include <span>
#include <vector>

#include "tools/solids/fit.h"

namespace indurop::solids {

struct Closeness {
  double within = 0.02;  // m that the solids may extend beyond the surface
  int most = 4;          // maximum number of solids, 1 or more; takes precedence
};

// Positions and sizes are rounded as in a file. Every point of the surface, and of the volume of a closed surface, is
// in one of the solids. `frames`: preferred directions, one or more.
std::vector<Solid> solids_around(const Surface& surface, const Closeness& closeness, std::span<const Mat3> frames);

}  // namespace indurop::solids
