// SPDX-License-Identifier: Apache-2.0
// Actions of instances in charts: Valve.Open beside a step.

#pragma once

#include <string_view>

#include "plc/model/project.h"

namespace indurop::plc::lower {

// Whether a name with dots, as `pou` has it, is none of a variable but ends behind an instance of a function block of
// the project, which has no variable of that name.
[[nodiscard]] bool names_foreign_action(const Project& project, const ast::Pou& pou, std::string_view name);

}  // namespace indurop::plc::lower
