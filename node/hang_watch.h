// SPDX-License-Identifier: Apache-2.0
// In virtual time nothing passes while a module does not return. This looks in real time: what has not returned
// for long, or not since somebody wants the node to end, is ended as a fault.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "rt/thread.h"

namespace indurop::node {

class HangWatch {
 public:
  // Both are called by a thread of its own: `progress` is another number whenever something returned, `end` ends what
  // is in progress; nothing, if there is none.
  HangWatch(std::function<std::uint64_t()> progress, std::function<void()> end);
  ~HangWatch();
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;
  static constexpr std::chrono::seconds kPatience{10};

 private:
  void loop();

  std::function<std::uint64_t()> progress_;
  std::function<void()> end_;
  std::atomic<bool> stop_{false};
  rt::Thread thread_;
};

}  // namespace indurop::node
