// SPDX-License-Identifier: Apache-2.0
// Variables outside of POUs: VAR_GLOBAL and the shared variables of .glb files.

#pragma once

#include <string>
#include <string_view>

#include "control/plc/check/context.h"

namespace indurop::plc {

// Declares a variable of VAR_GLOBAL.
void declare_global(Context& context, ast::Variable& variable);
// The same where the type is known and its address needs no check; null after an error.
Global* declare_variable(Context& context, ast::Variable& variable, const Type& type);
// Adds a variable to those of the program, by its name.
Global& add_global(Program& program, Global global);
// Returns the name of a variable outside of the program: its own, unless that is taken there.
[[nodiscard]] std::string free_shared_name(const Program& program, const std::string& name);
// Returns the shared variable of a .glb file with the full name, "knu::Robot::tick" in any case; null if there is none.
Global* foreign_global(Context& context, std::string_view full_name);
// Returns the only shared variable of the .glb files with this name after its namespaces; null if there is none or more
// than one.
[[nodiscard]] Global* only_foreign_global(Context& context, std::string_view name);
// Returns the variable that VAR_EXTERNAL names: a global of the project, or a shared variable by its last name. Null
// after an error.
Global* external_global(Context& context, const ast::Variable& variable, const Type& type);

// Returns whether the namespace contains shared variables of .glb files, directly or deeper.
[[nodiscard]] bool is_namespace(const Program& program, std::string_view path);
// Returns "PLC_ROBOT.I0" for I0 if there is exactly one such variable; otherwise "".
[[nodiscard]] std::string suggest_shared(const Program& program, std::string_view name);

}  // namespace indurop::plc
