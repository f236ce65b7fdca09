// SPDX-License-Identifier: Apache-2.0
// Expressions of numbers only: their values are known when a job is read, so what is wrong with them is an error of its
// line, and not of the moment at which it is executed.

#pragma once

#include <optional>

#include "control/robot/job/formula.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

// Returns the value; none: the expression reads something, or has no value.
[[nodiscard]] std::optional<double> constant_of(const Formula& formula);
// Adds an error of the line at `at` if the expression is one of numbers and has no value.
void check_constant(const Formula& formula, const JobToken& at, JobLine& line);

}  // namespace indurop::robot
