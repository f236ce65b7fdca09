// SPDX-License-Identifier: Apache-2.0
// The POUs that a task runs, directly or through calls.

#pragma once

#include <set>

#include "control/plc/check/program.h"

namespace indurop::plc {

[[nodiscard]] std::set<const Pou*> reached_by(const TaskPlan& task);

}  // namespace indurop::plc
