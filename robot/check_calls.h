// SPDX-License-Identifier: Apache-2.0
// Jobs that call themselves, at once or by way of others, whatever happens: they never end.

#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "robot/job.h"

namespace indurop::robot {

// Warnings, one for each job of such a circle, at its call.
std::vector<base::Diagnostic> check_calls(const JobBook& book);

}  // namespace indurop::robot
