// SPDX-License-Identifier: Apache-2.0
// What happened on the bus, kept until it is read: the latest events, and in words. Keeping is real-time safe.

#pragma once

#include <array>
#include <string>
#include <string_view>

#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class Events {
 public:
  void push(const Event& event) noexcept {
    events_[(first_ + count_) % events_.size()] = event;
    if (count_ < events_.size()) {
      ++count_;
    } else {
      first_ = (first_ + 1) % events_.size();
      ++dropped_;
    }
  }
  bool pop(Event& event) noexcept {
    if (count_ == 0) {
      return false;
    }
    event = events_[first_];
    first_ = (first_ + 1) % events_.size();
    --count_;
    return true;
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  std::array<Event, 256> events_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint64_t dropped_ = 0;
};

// "slave 3 (Test drive): refused a state: invalid mailbox configuration (0016h)"
std::string describe(const Event& event, std::string_view name);

}  // namespace indurop::io::ethercat
