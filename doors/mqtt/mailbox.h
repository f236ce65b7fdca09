// SPDX-License-Identifier: Apache-2.0
// Tasks that other threads leave for the thread of the main loop.

#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"

namespace indurop::mqtt {

class Mailbox {
 public:
  static constexpr std::size_t kMostTasks = 10000;

  Mailbox() : wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

  // May be called by any thread. Returns false if too many tasks wait already.
  bool post(std::function<void()> task) {
    {
      const std::lock_guard guard(mutex_);
      if (tasks_.size() >= kMostTasks) {
        return false;
      }
      tasks_.push_back(std::move(task));
    }
    const std::uint64_t one = 1;
    (void)!::write(wake_.get(), &one, sizeof one);
    return true;
  }

  // Executes the tasks that wait.
  void run() {
    std::uint64_t count = 0;
    (void)!::read(wake_.get(), &count, sizeof count);
    std::vector<std::function<void()>> tasks;
    {
      const std::lock_guard guard(mutex_);
      tasks.swap(tasks_);
    }
    for (const auto& task : tasks) {
      task();
    }
  }

  // Readable while tasks wait.
  [[nodiscard]] int descriptor() const noexcept { return wake_.get(); }

 private:
  base::Descriptor wake_;
  std::mutex mutex_;
  std::vector<std::function<void()>> tasks_;
};

}  // namespace indurop::mqtt
