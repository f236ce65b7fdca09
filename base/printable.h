// SPDX-License-Identifier: Apache-2.0
// Text of others on a terminal: nothing in it may move the cursor, change colours or stand for a line that we said.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

// Control characters and what is no UTF-8 become '?'; the rest is as it was. `kept`: control characters that stay.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace indurop::base
