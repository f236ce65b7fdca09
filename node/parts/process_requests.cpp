// SPDX-License-Identifier: Apache-2.0
#include "node/parts/process_requests.h"

#include <thread>
#include <utility>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kAnswerPatience{1};
constexpr std::chrono::microseconds kAnswerPoll{20};

}  // namespace

ProcessRequests::ProcessRequests(std::string node, const Prepared& prepared, bool waits)
    : node_(std::move(node)), prepared_(prepared), waits_(waits) {
  const scheduler::RunBlock& run = prepared.run();
  for (std::uint32_t i = 0; prepared.tape && i < run.module_count; ++i) {
    if (run.modules()[i].type == scheduler::ModuleType::Process && prepared.tape->of(i) != nullptr) {
      subjects_.push_back({i});
    }
  }
}

void ProcessRequests::begin_period() {
  for (Subject& subject : subjects_) {
    subject.due = true;
    subject.asked = false;
  }
}

void ProcessRequests::ask() {
  for (Subject& subject : subjects_) {
    if (subject.due) {
      subject.due = !ask_one(subject);
    }
  }
}

bool ProcessRequests::ask_one(Subject& subject) {
  const scheduler::RunBlock& run = prepared_.run();
  const scheduler::ModuleRecord& record = run.modules()[subject.module];
  const std::int32_t pid = run.process_slots()[subject.module].pid.load(std::memory_order_acquire);
  if (record.state.load() != scheduler::ModuleState::Running || pid == 0) {
    return true;
  }
  if (subject.pid != pid || !subject.keyframes) {
    subject.pid = pid;
    auto opened = tape::ProcessKeyframes::open(node_, subject.module, run.node_pid.load());
    subject.keyframes.reset();
    if (!opened) {
      return true;  // it declares nothing
    }
    subject.keyframes.emplace(std::move(opened).value());
  }
  if (subject.keyframes->form().empty()) {
    return true;  // it keeps nothing
  }
  tape::KeyframeRequestWords& words = subject.keyframes->words();
  const std::uint64_t asked = words.asked.load(std::memory_order_relaxed);
  const bool is_answered = words.answered.load(std::memory_order_acquire) == asked;
  if (subject.asked && is_answered && words.done.load(std::memory_order_relaxed) != 0) {
    return true;
  }
  if (is_answered) {
    subject.asked = true;
    words.puts_back.store(0, std::memory_order_relaxed);
    words.asked.store(asked + 1, std::memory_order_release);
    words.wake.wake();
  }
  const rt::MonoTime until = rt::MonoClock::now() + kAnswerPatience;
  while (waits_ && words.answered.load(std::memory_order_acquire) != words.asked.load(std::memory_order_relaxed) &&
         rt::MonoClock::now() < until) {
    std::this_thread::sleep_for(kAnswerPoll);
  }
  return waits_;
}

}  // namespace indurop::node
