// SPDX-License-Identifier: Apache-2.0
// The questions, as pure functions of the facts: the same facts give the same answer. No answer names a culprit that
// the facts do not show.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "history/explain/answer.h"
#include "history/explain/facts.h"

namespace indurop::explain {

// Explains why a module did not run in a tick, or ended late.
Answer why_late(const Facts& facts, const std::string& module, std::uint64_t tick);

// Explains why a value is old at a time. `plant`: the facts of the boards, including the asked one; `asked`: its index.
Answer why_old(std::span<const Facts> plant, std::size_t asked, const std::string& variable, std::int64_t at_ns);

// Explains why a board is silent. `plant` and `asked` as in why_old().
Answer why_gone(std::span<const Facts> plant, std::size_t asked, const std::string& board);

// Explains why a board's own node has ended, from its own facts alone.
Answer why_ended(const Facts& facts);

// Returns who set, forced or wrote a variable last before a time.
Answer who_changed(const Facts& facts, const std::string& variable, std::int64_t at_ns);

// Returns the last tick in which a module was late or did not run although it was due, as far back as is known; kNone
// if there is none.
inline constexpr std::uint64_t kNone = UINT64_MAX;
std::uint64_t last_trouble(const Facts& facts, const std::string& module);

}  // namespace indurop::explain
