// SPDX-License-Identifier: Apache-2.0
// Actions of instances in charts: Valve.Open next to a step.

#pragma once

#include <string_view>

#include "control/plc/model/project.h"

namespace indurop::plc::lower {

// Returns whether a name with dots in `pou` is not a variable but an action: the last name follows an instance of a
// function block of the project that has no variable of that name.
[[nodiscard]] bool names_foreign_action(const Project& project, const ast::Pou& pou, std::string_view name);

}  // namespace indurop::plc::lower
