// SPDX-License-Identifier: Apache-2.0
// Finds jobs that unconditionally call themselves, directly or through others: they never end.

#pragma once

#include <vector>

#include "control/robot/job/job.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// Returns warnings, one for each job of such a cycle, at its call.
std::vector<base::Diagnostic> check_calls(const JobBook& book);

}  // namespace indurop::robot
