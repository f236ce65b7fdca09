// SPDX-License-Identifier: Apache-2.0
// Ways around obstacles as OMPL's own RRT-Connect finds them, with FCL's opinion on what is clear.

#pragma once

#include "scene.h"

namespace indurop::robot {

struct OmplWay {
  bool found = false;
  double seconds = 0;  // of the processor, that it took
};

// Searches for at most `seconds` of the processor.
OmplWay ompl_way(const Scene& scene, double seconds);

}  // namespace indurop::robot
