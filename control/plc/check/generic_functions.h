// SPDX-License-Identifier: Apache-2.0
// Functions of the user with inputs of types such as ANY_NUM: for each combination of argument types a separate
// function is made.

#pragma once

#include <map>
#include <string>

#include "control/plc/check/context.h"

namespace indurop::plc {

// Returns whether one of its inputs has such a type.
[[nodiscard]] bool is_generic(const ast::Pou& tree) noexcept;
// Returns "ANY_NUM" for a declaration with that type; "" for other types.
[[nodiscard]] std::string generic_name(const ast::TypeSpec& type);
// Returns whether the generic type includes this one.
[[nodiscard]] bool generic_takes(const std::string& generic, const Type& type) noexcept;
// Returns the function for these types, by the names of the generic ones; declares it if it is new. Null after an
// error.
[[nodiscard]] Pou* function_for(Context& context, const ast::Pou& tree, const std::map<std::string, const Type*>& types,
                                const Place& at);
// Warns about generic functions that are never called, because these were not checked.
void warn_about_uncalled(Context& context);

}  // namespace indurop::plc
