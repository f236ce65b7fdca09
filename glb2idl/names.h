// SPDX-License-Identifier: Apache-2.0
// Checks which names a .glb may declare. A name must be valid in IDL (of any vendor), in the C that idlc makes of it
// and in C++, also in a module with `using namespace` and the usual system headers.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace indurop::glb2idl {

enum class NameRole { Namespace, Type, Variable, Constant, Enumerator, Function, Field, Parameter };

// Returns why `name` cannot be declared ("is a keyword of C++"), or nullopt. `global`: outside of all namespaces.
[[nodiscard]] std::optional<std::string> objection(std::string_view name, NameRole role, bool global);

// Returns a similar valid name.
[[nodiscard]] std::string proposal(std::string_view name, NameRole role, bool global);

// Returns true for a macro of the headers that modules include: the preprocessor would replace it in any C++ name.
[[nodiscard]] bool is_system_macro(std::string_view name);

}  // namespace indurop::glb2idl
