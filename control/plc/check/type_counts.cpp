// SPDX-License-Identifier: Apache-2.0
// Limits types and values to what the passes over them can handle.

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/type_builder.h"
#include "control/plc/check/value_tree.h"

namespace indurop::plc {

bool count_fields(Context& context, const Place& at, const Type& type) {
  std::uint64_t& sum = context.program.fields;
  const bool before = sum <= kMaxFields;
  sum += before ? std::min(type.fields_inside, kMaxFields + 1) : 0;
  if (before && sum > kMaxFields) {
    context.error(at, fmt::format("all types and variables have more than {} fields together, use arrays", kMaxFields));
  }
  return sum <= kMaxFields;
}

bool count_values(Context& context, const Place& at, const Type& type, const ast::Initial* initial) {
  constexpr std::uint64_t kMaxInitialValues = 1'000'000;
  constexpr std::uint64_t kMostTogether = 4'000'000;
  const std::uint64_t own = values_of(type, initial);
  std::uint64_t& sum = context.program.values;
  if (own > kMaxInitialValues) {
    context.error(at, fmt::format("more than {} initial values, assign them in the body", kMaxInitialValues));
    return false;
  }
  const bool before = sum <= kMostTogether;
  sum += before ? own : 0;
  if (before && sum > kMostTogether) {
    context.error(at, fmt::format("all variables together begin with more than {} values, assign some in the body",
                                  kMostTogether));
  }
  return sum <= kMostTogether;
}

}  // namespace indurop::plc
