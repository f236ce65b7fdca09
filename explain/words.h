// SPDX-License-Identifier: Apache-2.0
// Times in the sentences of answers.

#pragma once

#include <cstdint>
#include <string>

#include "explain/facts.h"

namespace indurop::explain {

// Three digits and a unit: "812 ns", "1.24 ms".
std::string short_time(std::int64_t ns);
// "tick 120 (0.12 s)".
std::string at_tick(const Facts& facts, std::uint64_t tick);
// "tick 120" of a time, "before tick 0".
std::string when(const Facts& facts, std::int64_t time_ns);
// "user ana of host pc4"
std::string who(const OrderFact& order);

}  // namespace indurop::explain
