// SPDX-License-Identifier: Apache-2.0
// Variables of boards as metrics of Sparkplug: each number, text or bool of a variable is one.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/json.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/sparkplug/payload.h"

namespace indurop::mqtt {

DataType data_type_of(schema::Base base) noexcept;
// Returns the bytes of a leaf as they travel. Text that is no UTF-8 is replaced.
WireValue wire_value_of(const Leaf& leaf, std::span<const std::uint8_t> bytes);
// Returns what a host wants a leaf to be, for `indurop serve`; nothing if the value cannot be meant for it.
std::optional<base::Json> json_for(schema::Base base, const WireValue& value);
std::int32_t sparkplug_quality(Quality quality) noexcept;
// "knu::Robot::joints[1].y" is the metric "knu/Robot/joints[1]/y".
std::string metric_name(std::string_view leaf);

// The aliases of a board's metrics: `first` is that of the first leaf, in the order of variables and leaves.
class AliasTable {
 public:
  AliasTable(const Board& board, std::uint64_t first);
  [[nodiscard]] std::uint64_t alias(std::size_t variable, std::size_t leaf) const {
    return first_ + begin_[variable] + leaf;
  }
  [[nodiscard]] std::uint64_t end() const noexcept { return first_ + count_; }
  struct Place {
    std::size_t variable;
    std::size_t leaf;
  };
  // The leaf that a metric of a command means, by its name or its alias.
  [[nodiscard]] std::optional<Place> find(const Metric& metric) const;

 private:
  std::uint64_t first_;
  std::uint64_t count_ = 0;
  std::vector<std::uint64_t> begin_;  // by variable
  std::map<std::string, Place, std::less<>> by_name_;
};

}  // namespace indurop::mqtt
