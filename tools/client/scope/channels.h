// SPDX-License-Identifier: Apache-2.0
// The channels of a scope and their inputs: channels given as variables, parts, globs and expressions, and the numbers
// in shared memory from which they are computed.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "tools/client/scope/formula.h"
#include "tools/client/scope/trigger.h"

namespace indurop::tools {

inline constexpr std::size_t kMostScopeLines = 64;

// A number that is part of a variable.
struct ScopeInput {
  std::uint32_t variable = 0;  // index in the schema
  std::uint32_t offset = 0;
  schema::Base base{};
};
// Reads the number from the variable's bytes.
double number_of(const ScopeInput& input, const std::uint8_t* bytes) noexcept;

struct ScopeLine {
  std::string name;  // "joints[1]"
  Formula formula;
};
// Lines that are drawn together: the elements of an array, or a single one.
struct ScopeChannel {
  std::string name;
  std::string unit;
  std::vector<std::string> words;  // for an enumeration: its names by number
  bool yes_no = false;
  std::vector<ScopeLine> lines;
};

struct ScopePlan {
  std::vector<ScopeInput> inputs;
  std::vector<ScopeChannel> channels;
  std::optional<Trigger> trigger;  // none: starts at once
};

// `texts`: names, parts, globs, expressions; "NAME = EXPRESSION" also names the channel. Errors: what cannot be a
// channel (text; more than kMostScopeLines lines) or cannot be parsed.
Result<ScopePlan, base::Problem> plan_scope(const schema::Schema& schema, const std::vector<std::string>& texts,
                                            std::string_view trigger);

}  // namespace indurop::tools
