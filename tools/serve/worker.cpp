// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/worker.h"

#include <csignal>
#include <utility>

namespace indurop::serve {

Worker::Worker() {
  // Signals are handled by the door's thread.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  // The kernel kills a process whose thread blocks a fault that it causes; a SIGBUS from a truncated block is survived.
  sigdelset(&all, SIGBUS);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Worker::~Worker() {
  {
    const std::lock_guard guard(lock_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool Worker::add(std::function<void()> job) {
  {
    const std::lock_guard guard(lock_);
    if (jobs_.size() >= kMostJobs) {
      return false;
    }
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
  return true;
}

bool Worker::add_if_idle(std::function<void()> job) {
  {
    const std::lock_guard guard(lock_);
    if (working_ || !jobs_.empty()) {
      return false;
    }
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
  return true;
}

void Worker::work() {
  std::unique_lock guard(lock_);
  for (;;) {
    changed_.wait(guard, [this] { return ending_ || !jobs_.empty(); });
    if (ending_) {
      return;
    }
    const auto job = std::move(jobs_.front());
    jobs_.pop_front();
    working_ = true;
    guard.unlock();
    job();
    guard.lock();
    working_ = false;
  }
}

}  // namespace indurop::serve
