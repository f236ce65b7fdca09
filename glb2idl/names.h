// SPDX-License-Identifier: Apache-2.0
// Which names a .glb may declare. A name must survive in IDL (of any vendor), in the C that idlc makes of it and in
// C++, also in a module that says `using namespace` and includes the usual system headers.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace indurop::glb2idl {

enum class NameRole { Namespace, Type, Variable, Constant, Enumerator, Function, Field, Parameter };

// Why `name` cannot be declared ("is a keyword of C++"), or nullopt. `global`: outside of all namespaces.
[[nodiscard]] std::optional<std::string> objection(std::string_view name, NameRole role, bool global);

// A similar name without objection.
[[nodiscard]] std::string proposal(std::string_view name, NameRole role, bool global);

// A macro of the headers that modules include: no C++ name of any kind gets past the preprocessor.
[[nodiscard]] bool is_system_macro(std::string_view name);

}  // namespace indurop::glb2idl
