// SPDX-License-Identifier: Apache-2.0
// What variables, types, fields and values are called where others see them: in the .glb, in IDL, in C++. Names that
// are taken there get another one, as glb2idl proposes it.

#pragma once

#include <string>
#include <string_view>

#include "plc/check/context.h"

namespace indurop::plc {

// Fills the shared names of all types of the project.
void name_types(Context& context);
// The name of a shared variable, without its namespace.
[[nodiscard]] std::string name_of_shared(std::string_view name);
// The namespace of a module of this name.
[[nodiscard]] std::string name_of_space(std::string_view name);

// "x" of "main::x"
[[nodiscard]] std::string_view last_name(std::string_view full) noexcept;

}  // namespace indurop::plc
