// SPDX-License-Identifier: Apache-2.0
// Converts texts of editors that do not write UTF-8.

#pragma once

#include <string>

namespace indurop::plc {

// Converts to UTF-8: from UTF-16 with or without a byte order mark, UTF-8, or otherwise Latin-1.
[[nodiscard]] std::string as_utf8(std::string text);

}  // namespace indurop::plc
