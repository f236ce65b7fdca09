// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/candidate_thread.h"

#include <utility>

namespace indurop::node {
namespace {

constexpr std::size_t kCandidateStack = std::size_t{8} * 1024 * 1024;

}  // namespace

CandidateThread::CandidateThread(const CandidateTask& task) : task_(task) {
  task_.try_first = true;
  auto started = rt::Thread::start({"irp-reload", 0, -1, kCandidateStack}, [this] {
    candidate_ = make_candidate(task_);
    done_.store(true, std::memory_order_release);
  });
  if (started) {
    thread_ = std::move(started).value();
  } else {
    candidate_.errors.emplace_back("no thread could be started to load the new version");
    done_.store(true, std::memory_order_release);
  }
}

Candidate CandidateThread::take() {
  thread_.join();
  return std::move(candidate_);
}

}  // namespace indurop::node
