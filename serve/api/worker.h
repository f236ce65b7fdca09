// SPDX-License-Identifier: Apache-2.0
// The second thread: does what may wait or read files, one job after the other.

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
  // Lets the job at hand end; those that wait are dropped.
  ~Worker();

  // False if too many wait already.
  bool add(std::function<void()> job);
  // The same, for jobs that take long: false if it has anything to do.
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
