// SPDX-License-Identifier: Apache-2.0
// Names in OMG IDL, which reserves words that C and C++ do not.

#pragma once

#include <string>
#include <string_view>

namespace indurop::schema {

// A keyword of OMG IDL 4.2, in whatever case: compilers compare them without regard to it.
[[nodiscard]] bool is_idl_keyword(std::string_view name);

// The name as IDL writes it: a keyword such as `port` is `_port` there, which means `port`.
[[nodiscard]] std::string idl_name(std::string_view name);

}  // namespace indurop::schema
