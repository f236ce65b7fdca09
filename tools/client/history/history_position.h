// SPDX-License-Identifier: Apache-2.0
// Where a page of a history ended, as a text that a client returns for the next one. The server keeps nothing.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::tools {

struct HistoryPosition {
  std::int64_t at_ns = 0;               // the first time of the next page
  std::int64_t real_minus_node_ns = 0;  // CLOCK_REALTIME minus the node's time, the same for all pages
  std::vector<std::uint64_t> seen;      // digest of each item's last value; 0: it is not known
};

// Never 0. The value is on no page twice, however its changes are split into pages.
std::uint64_t digest_of(std::span<const std::uint8_t> bytes) noexcept;

std::string to_text(const HistoryPosition& position);
// Returns nothing if the text is no position in a history of `items` items.
std::optional<HistoryPosition> history_position(std::string_view text, std::size_t items);

}  // namespace indurop::tools
