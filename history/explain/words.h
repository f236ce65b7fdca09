// SPDX-License-Identifier: Apache-2.0
// Texts for times in the sentences of answers.

#pragma once

#include <cstdint>
#include <string>

#include "history/explain/facts.h"

namespace indurop::explain {

// Returns three digits and a unit: "812 ns", "1.24 ms".
std::string short_time(std::int64_t ns);
// Returns "tick 120 (0.12 s)".
std::string at_tick(const Facts& facts, std::uint64_t tick);
// Returns "tick 120" for a time, or "before tick 0".
std::string when(const Facts& facts, std::int64_t time_ns);
// Returns what the quality of a field device means (docs/io.md, Quality).
std::string quality_text(std::int64_t number);
// Returns "user ana of host pc4".
std::string who(const OrderFact& order);

}  // namespace indurop::explain
