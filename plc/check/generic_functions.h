// SPDX-License-Identifier: Apache-2.0
// Functions of the user with inputs of types such as ANY_NUM: each combination of types they are called with is a
// function of its own.

#pragma once

#include <map>
#include <string>

#include "plc/check/context.h"

namespace indurop::plc {

// Whether one of its inputs has such a type.
[[nodiscard]] bool is_generic(const ast::Pou& tree) noexcept;
// "ANY_NUM" of a declaration; "" of other types.
[[nodiscard]] std::string generic_name(const ast::TypeSpec& type);
// Whether the generic type has values of this one.
[[nodiscard]] bool generic_takes(const std::string& generic, const Type& type) noexcept;
// The function for these types, by the names of the generic ones; declared where it is new. Null with an error.
[[nodiscard]] Pou* function_for(Context& context, const ast::Pou& tree, const std::map<std::string, const Type*>& types,
                                const Place& at);
// Those that nobody calls were not looked at.
void warn_about_uncalled(Context& context);

}  // namespace indurop::plc
