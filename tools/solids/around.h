// SPDX-License-Identifier: Apache-2.0
// Few solids around a surface and what is inside of it. It is cut where they reach too far beyond it, each time where
// that saves most.

#pragma once

#include <span>
#include <vector>

#include "tools/solids/fit.h"

namespace indurop::solids {

struct Closeness {
  double within = 0.02;  // m that the solids may reach beyond the surface
  int most = 4;          // but not more solids than that, 1 or more
};

// With places and sizes as a file has them. Every point of the surface, and of what a closed surface encloses, is in
// one of them. `frames`: directions that are preferred, one or more.
std::vector<Solid> solids_around(const Surface& surface, const Closeness& closeness, std::span<const Mat3> frames);

}  // namespace indurop::solids
