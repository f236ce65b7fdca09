// SPDX-License-Identifier: Apache-2.0
// Calls of shared functions by users, in a store opened for writing. A call is served by the module that implements the
// function, like those of modules: it takes one of the function's slots, and the time of that module. Not real-time
// safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/schema/schema.h"
#include "store/operate/item.h"
#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/store.h"

namespace indurop::operate {

// The longest time that a call waits for its result, whatever the function declares.
inline constexpr std::int64_t kMaxCallNs = 5'000'000'000;

// Returns the function of this full name, or nullptr.
const schema::Function* find_function(const vars::Store& store, std::string_view name) noexcept;
// Returns true if the function has no result.
bool is_void(const schema::Function& function) noexcept;
// Returns true if a module serves the function now.
bool is_served(const vars::Store& store, const schema::Function& function) noexcept;

struct FunctionCall {
  const schema::Function* function = nullptr;
  std::vector<std::uint8_t> arguments;  // the bytes of their struct
  std::string text;                     // "a=1, b=2", for journals
};

// Checks arguments, given by name: each must be there once, with a value of its type, within its range.
Result<FunctionCall, Refusal> prepare_call(const schema::Function& function,
                                           const std::vector<std::pair<std::string, std::string>>& arguments,
                                           ReadLiteral literal = nullptr);

// Calls the function, waits for its result at most for its deadline, and notes it in the journal. Returns the bytes of
// the result. Errors: Locked; Absent (no module serves it); Busy (all slots are in use, or there was no result in time:
// it may have been executed all the same); Wrong (the function failed, or has another type).
Result<std::vector<std::uint8_t>, Refusal> call(const std::string& node, vars::Store& store, const FunctionCall& call,
                                                const Who& who);

}  // namespace indurop::operate
