// SPDX-License-Identifier: Apache-2.0
// What can be a name in a PLC program, whatever it was read from.

#pragma once

#include <string>
#include <string_view>

namespace indurop::plc {

// Whether the word means something in the language and so cannot be a name.
[[nodiscard]] bool is_keyword(std::string_view word) noexcept;
// Letters, digits and '_', no digit in front. A keyword is one, too.
[[nodiscard]] bool is_identifier(std::string_view text) noexcept;
// Why `text` cannot be a name, and what to do; "" if it can.
[[nodiscard]] std::string why_no_name(std::string_view text);

}  // namespace indurop::plc
