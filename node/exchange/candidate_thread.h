// SPDX-License-Identifier: Apache-2.0
// Checks and loads a version on a thread of its own: that takes some ms, in which the node is supervised.

#pragma once

#include <atomic>

#include "core/rt/thread.h"
#include "node/exchange/candidate.h"

namespace indurop::node {

class CandidateThread {
 public:
  explicit CandidateThread(const CandidateTask& task);
  CandidateThread(const CandidateThread&) = delete;
  CandidateThread& operator=(const CandidateThread&) = delete;
  ~CandidateThread() = default;

  [[nodiscard]] bool is_done() const noexcept { return done_.load(std::memory_order_acquire); }
  // Waits for the end, and returns what was made.
  Candidate take();

 private:
  CandidateTask task_;
  Candidate candidate_;
  std::atomic<bool> done_{false};
  rt::Thread thread_;
};

}  // namespace indurop::node
