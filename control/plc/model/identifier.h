// SPDX-License-Identifier: Apache-2.0
// Valid names in a PLC program, whatever it was read from.

#pragma once

#include <string>
#include <string_view>

namespace indurop::plc {

// Returns whether the word is reserved in the language and so cannot be a name.
[[nodiscard]] bool is_keyword(std::string_view word) noexcept;
// Returns whether it consists of letters, digits and '_' and does not begin with a digit. Keywords do, too.
[[nodiscard]] bool is_identifier(std::string_view text) noexcept;
// Returns why `text` cannot be a name, and what to do; "" if it can.
[[nodiscard]] std::string why_no_name(std::string_view text);

}  // namespace indurop::plc
