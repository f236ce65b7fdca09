// SPDX-License-Identifier: Apache-2.0
// Which board counts if several deliver a variable (<standby>): the one that has served longest. A board that comes
// back does not take the lead again, so that outputs do not jump. All boards decide by this rule, each on its own.

#pragma once

#include <cstdint>

namespace indurop::mirror {

// `session`: number of a run of a board, which grows with the time of its start.
constexpr bool leads(std::uint64_t session, std::uint64_t other) noexcept {
  return session < other;
}

}  // namespace indurop::mirror
