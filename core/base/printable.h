// SPDX-License-Identifier: Apache-2.0
// Makes text from other programs safe for a terminal: it cannot move the cursor, change colours or pass for a line of
// ours.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

// Replaces control characters and invalid UTF-8 by '?'. `kept`: control characters that are not replaced.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace indurop::base
