// SPDX-License-Identifier: Apache-2.0
// The variables and parts of variables whose history is read.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "store/operate/item.h"
#include "store/vars/store.h"

namespace indurop::tools {

struct HistoryItem {
  std::uint32_t variable = 0;  // index in the store's directory
  const schema::Variable* declared = nullptr;
  std::size_t offset = 0;  // of the part
  std::size_t size = 0;

  // Returns the part's bytes in those of the variable; empty if these are too few.
  [[nodiscard]] std::span<const std::uint8_t> part_of(std::span<const std::uint8_t> whole) const noexcept {
    return offset + size <= whole.size() ? whole.subspan(offset, size) : std::span<const std::uint8_t>();
  }
};

// The items belong to the store and point into its schema.
inline std::vector<HistoryItem> history_items(const vars::Store& store, const std::vector<operate::Item>& items) {
  std::vector<HistoryItem> out;
  for (const operate::Item& item : items) {
    out.push_back({static_cast<std::uint32_t>(item.entry - store.directory().data()), item.place.variable,
                   item.place.offset, item.place.type.size()});
  }
  return out;
}

}  // namespace indurop::tools
