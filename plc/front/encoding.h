// SPDX-License-Identifier: Apache-2.0
// Texts of editors that do not write UTF-8.

#pragma once

#include <string>

namespace indurop::plc {

// UTF-8 of a text in UTF-16, with a mark at its beginning or without, in UTF-8, or, where it is neither, in Latin-1.
[[nodiscard]] std::string as_utf8(std::string text);

}  // namespace indurop::plc
