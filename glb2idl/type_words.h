// SPDX-License-Identifier: Apache-2.0
// Built-in types: fixed-width names and the C combinations such as "unsigned long int".

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::glb2idl {

// Returns true for a word that may begin or continue a built-in type, including "void".
[[nodiscard]] bool is_type_word(std::string_view word) noexcept;

// Returns the type for int8_t, uint16 and so on: complete types in one word.
[[nodiscard]] std::optional<schema::Base> fixed_type(std::string_view word) noexcept;

// Returns the type of several C words in any order; nullopt for combinations that C does not have or that are not
// numbers here.
[[nodiscard]] std::optional<schema::Base> combined_type(std::span<const std::string_view> words) noexcept;

// Returns the replacement for a well-known type name of other languages; empty if unknown.
[[nodiscard]] std::string_view substitute_for(std::string_view word) noexcept;

// Returns all type names, to suggest one for a misspelled type.
[[nodiscard]] const std::vector<std::string>& type_names();

}  // namespace indurop::glb2idl
