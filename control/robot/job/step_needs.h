// SPDX-License-Identifier: Apache-2.0
// What a step needs before it can be run. Real-time safe.

#pragma once

#include "control/robot/job/job.h"

namespace indurop::robot {

// Returns whether a condition may end the motion of the step.
[[nodiscard]] bool has_until(const JobBook& book, const Step& step) noexcept;
// Returns whether the step reads or changes the outside world, so that all motions before it have to end first.
[[nodiscard]] bool touches_world(const JobBook& book, const Step& step) noexcept;
// The steps that it counts as: more than one if its expressions are long.
[[nodiscard]] int cost_of(const JobBook& book, const Step& step) noexcept;

}  // namespace indurop::robot
