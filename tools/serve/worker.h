// SPDX-License-Identifier: Apache-2.0
// A second thread for jobs that may wait or read files; it executes them one after the other.

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace indurop::serve {

class Worker {
 public:
  static constexpr std::size_t kMostJobs = 32;

  Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  // Waits for the current job; discards those that have not started.
  ~Worker();

  // Returns false if too many jobs are waiting already.
  bool add(std::function<void()> job);
  // The same for long jobs: returns false if the worker is not idle.
  bool add_if_idle(std::function<void()> job);

 private:
  void work();

  std::mutex lock_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool working_ = false;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace indurop::serve
