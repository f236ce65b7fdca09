// SPDX-License-Identifier: Apache-2.0
// The characters of STRING and WSTRING. During compilation both are UTF-8; a STRING counts its bytes, a WSTRING its
// UTF-16 units.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "control/plc/model/elementary.h"

namespace indurop::plc {

[[nodiscard]] std::u16string to_wide(std::string_view utf8);
[[nodiscard]] std::string to_utf8(std::u16string_view wide);
// Returns the number of characters that a STRING, or a WSTRING, needs to hold the text.
[[nodiscard]] std::size_t characters_of(std::string_view utf8, Elementary of);
// Returns the code of the only character of a text, as a CHAR or WCHAR; none if it does not have exactly one.
[[nodiscard]] std::optional<char16_t> code_of_character(std::string_view utf8, Elementary of);

}  // namespace indurop::plc
