// SPDX-License-Identifier: Apache-2.0
// What the body of a set, a force or a release asks for.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace indurop::serve {

// What a body asks for, after it was understood.
struct Wish {
  std::vector<std::pair<std::string, std::string>> values;  // name, value as `indurop set` takes it
  std::vector<std::string> names;
  std::string reason;
  std::int64_t for_ns = 0;
  bool all = false;
  bool lease = false;
};

// Or why it is none.
Result<Wish, std::string> read_wish(const std::string& body);
// For the audit log.
std::string text_of(const Wish& wish);

}  // namespace indurop::serve
