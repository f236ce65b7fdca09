// SPDX-License-Identifier: Apache-2.0
// What DDS threads report about the endpoints of a topic: how many readers it has, that a value has arrived, and that a
// participant uses the topic with another type or QoS.

#pragma once

#include <atomic>
#include <cstdint>

#include "core/rt/signal_word.h"
#include "network/dds/endpoint.h"

namespace indurop::mirror {

// The endpoints that use the listener must be closed before this object is destroyed.
class TopicEvents {
 public:
  // `wake` is signalled when a value arrives.
  explicit TopicEvents(rt::SignalWord& wake) noexcept : wake_(wake) {}
  TopicEvents(const TopicEvents&) = delete;
  TopicEvents& operator=(const TopicEvents&) = delete;

  [[nodiscard]] dds::Listener listener();

  [[nodiscard]] int readers() const noexcept { return readers_.load(std::memory_order_acquire); }
  // Returns whether a value has arrived since the last call.
  bool take_arrival() noexcept { return arrived_.exchange(false, std::memory_order_acq_rel); }
  // Returns the number of disagreements on type or QoS since the last call.
  std::uint32_t take_disagreements() noexcept;

 private:
  // Called by DDS threads.
  void data_came() noexcept;
  void readers_changed(int now) noexcept { readers_.store(now, std::memory_order_release); }
  void disagreed() noexcept { disagreements_.fetch_add(1, std::memory_order_relaxed); }

  rt::SignalWord& wake_;
  std::atomic<int> readers_{0};
  std::atomic<bool> arrived_{false};
  std::atomic<std::uint32_t> disagreements_{0};
  std::uint32_t reported_ = 0;  // of the disagreements
};

}  // namespace indurop::mirror
