// SPDX-License-Identifier: Apache-2.0
// The questions. Pure functions of what is known: the same facts give the same answer. None names a culprit that the
// facts do not show.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "explain/answer.h"
#include "explain/facts.h"

namespace indurop::explain {

// Why a module did not run in a tick, or ended late.
Answer why_late(const Facts& facts, const std::string& module, std::uint64_t tick);

// Why a value is old at a time. `plant`: what is known of the boards, the asked one among them; `asked` its place.
Answer why_old(std::span<const Facts> plant, std::size_t asked, const std::string& variable, std::int64_t at_ns);

// Why a board is not heard any more; likewise.
Answer why_gone(std::span<const Facts> plant, std::size_t asked, const std::string& board);

// Why a board's own node has ended, by what is known of it alone.
Answer why_ended(const Facts& facts);

// Who set, forced or wrote a variable last before a time.
Answer who_changed(const Facts& facts, const std::string& variable, std::int64_t at_ns);

// The last tick in which a module was late or did not run although it was due, as far back as is known; `none` if there
// is none.
inline constexpr std::uint64_t kNone = UINT64_MAX;
std::uint64_t last_trouble(const Facts& facts, const std::string& module);

}  // namespace indurop::explain
