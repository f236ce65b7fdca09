// SPDX-License-Identifier: Apache-2.0
// Names in OMG IDL, which reserves words that C and C++ do not.

#pragma once

#include <string>
#include <string_view>

namespace indurop::schema {

// Returns true for a keyword of OMG IDL 4.2, ignoring case, as IDL compilers do.
[[nodiscard]] bool is_idl_keyword(std::string_view name);

// Returns the name as written in IDL: a keyword such as `port` is escaped as `_port`, which still means `port`.
[[nodiscard]] std::string idl_name(std::string_view name);

}  // namespace indurop::schema
