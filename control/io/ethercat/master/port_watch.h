// SPDX-License-Identifier: Apache-2.0
// Reads the error counters of a slave's ports once a second, and finds out which port has received broken frames or
// lost its link since: the cable there, or a plug, is bad. Real-time safe.

#pragma once

#include <array>
#include <optional>

#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class PortWatch {
 public:
  static constexpr std::size_t kPorts = 4;

  // The slave is in OP, for the first time or again: errors by which it was lost are found as well.
  void begin(Clock now) noexcept;
  [[nodiscard]] bool is_due(Clock now) const noexcept { return now >= due_at_; }
  Query query(std::uint16_t station, Clock now) noexcept;

  struct Finding {
    std::uint8_t port = 0;
    std::uint16_t broken_frames = 0;
    std::uint16_t lost_links = 0;
  };
  // Of the port with the most errors since the last query; nothing if there were none.
  std::optional<Finding> answer(Bytes data) noexcept;
  // Since the slave was found first.
  [[nodiscard]] std::uint64_t errors() const noexcept { return errors_; }

 private:
  static constexpr std::size_t kCounters = 12;  // two of each port, then a lost link of each

  Clock due_at_{0};
  std::array<std::uint8_t, kCounters> last_{};
  bool knows_last_ = false;
  bool clears_ = false;  // the next query: before a counter stands still at its maximum
  bool is_clearing_ = false;
  std::uint64_t errors_ = 0;
};

}  // namespace indurop::io::ethercat
