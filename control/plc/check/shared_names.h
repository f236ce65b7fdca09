// SPDX-License-Identifier: Apache-2.0
// Names of variables, types, fields and values outside the program: in the .glb, in IDL, in C++. Names that are
// reserved there are replaced as glb2idl proposes.

#pragma once

#include <string>
#include <string_view>

#include "control/plc/check/context.h"

namespace indurop::plc {

// Sets the shared names of all types of the project.
void name_types(Context& context);
// Returns the name of a shared variable, without its namespace.
[[nodiscard]] std::string name_of_shared(std::string_view name);
// Returns the namespace of a module of this name.
[[nodiscard]] std::string name_of_space(std::string_view name);

// Returns "x" of "main::x".
[[nodiscard]] std::string_view last_name(std::string_view full) noexcept;

}  // namespace indurop::plc
