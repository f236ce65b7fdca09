// SPDX-License-Identifier: Apache-2.0
// Built-in types: fixed-width names and the C combinations such as "unsigned long int".

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/schema.h"

namespace indurop::glb2idl {

// A word that may begin or continue a built-in type, "void" included.
[[nodiscard]] bool is_type_word(std::string_view word) noexcept;

// int8_t, uint16 and so on: complete types in one word.
[[nodiscard]] std::optional<schema::Base> fixed_type(std::string_view word) noexcept;

// The type of several C words in any order; nullopt for combinations C does not have or that are no numbers here.
[[nodiscard]] std::optional<schema::Base> combined_type(std::span<const std::string_view> words) noexcept;

// What to write instead of a well-known type name of other languages; empty if unknown.
[[nodiscard]] std::string_view substitute_for(std::string_view word) noexcept;

// All names a misspelt type may have meant.
[[nodiscard]] const std::vector<std::string>& type_names();

}  // namespace indurop::glb2idl
