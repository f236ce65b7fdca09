// SPDX-License-Identifier: Apache-2.0
// In virtual time nothing passes while a module does not return. This watchdog uses real time: a run that does not
// return for kTimeout, or for a shorter time once the node is to end, is ended as a fault.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "core/rt/thread.h"

namespace indurop::node {

class HangWatch {
 public:
  // A thread of this class calls both: `progress` returns another number whenever a run has returned, `end` ends the
  // run in progress, and does nothing if there is none.
  HangWatch(std::function<std::uint64_t()> progress, std::function<void()> end);
  ~HangWatch();
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;
  static constexpr std::chrono::seconds kTimeout{10};

 private:
  void loop();

  std::function<std::uint64_t()> progress_;
  std::function<void()> end_;
  std::atomic<bool> stop_{false};
  rt::Thread thread_;
};

}  // namespace indurop::node
