// SPDX-License-Identifier: Apache-2.0
// Variables outside of POUs: VAR_GLOBAL, located ones, and the shared variables of .glb files.

#pragma once

#include <string>
#include <string_view>

#include "plc/check/context.h"

namespace indurop::plc {

// Declares a variable of VAR_GLOBAL.
void declare_global(Context& context, ast::Variable& variable);
// The variable at an address; declared now if no declaration names the address.
Global& located_global(Context& context, const ast::DirectAddress& address, const Place& at);
// The same for a declaration `name AT %IX0.0 : type`.
Global& declare_located(Context& context, ast::Variable& variable, const Type& type);
// The same for `name AT %I* : type`; null with an error where that is not possible.
Global* declare_placeless(Context& context, ast::Variable& variable, const Type& type);
// The shared variable of a .glb file with the full name, "knu::Robot::tick" in any case; null if there is none.
Global* foreign_global(Context& context, std::string_view full_name);
// The one shared variable of the .glb files with this name behind its namespaces; null if there is none or several.
[[nodiscard]] Global* only_foreign_global(Context& context, std::string_view name);
// What VAR_EXTERNAL names: a global of the project, or a shared variable by its last name. Null with an error.
Global* external_global(Context& context, const ast::Variable& variable, const Type& type);

// Whether shared variables of .glb files lie in it, or deeper.
[[nodiscard]] bool is_namespace(const Program& program, std::string_view path);
// "PLC_ROBOT.I0" for I0, if there is exactly one; else "".
[[nodiscard]] std::string suggest_shared(const Program& program, std::string_view name);

}  // namespace indurop::plc
