// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/program_loader.h"

#include <exception>
#include <thread>
#include <utility>

#include "control/robot/plan/ordinary_thread.h"

namespace indurop::robot {

namespace {

constexpr std::chrono::milliseconds kPoll{20};
constexpr std::chrono::milliseconds kSoon{1};

}  // namespace

ProgramLoader::ProgramLoader(const Settings& settings, std::string urdf)
    : names_(names_of(settings)),
      urdf_(std::move(urdf)),
      in_tick_(settings.plan_in_tick),
      learned_(settings.learned),
      guarded_(settings.guarded) {
  constexpr std::size_t kStack = std::size_t{1} << 20U;
  in_tick_ = in_tick_ || !begin_ordinary_thread(thread_, "robot-load", kStack, enter, this);
}

ProgramLoader::~ProgramLoader() {
  if (!in_tick_) {
    ending_.store(true, std::memory_order_relaxed);
    ::pthread_join(thread_, nullptr);
  }
}

void* ProgramLoader::enter(void* loader) noexcept {
  static_cast<ProgramLoader*>(loader)->run();
  return nullptr;
}

// After a crash it reads nothing more, and reports the crash for each request.
void ProgramLoader::run() noexcept {
  const auto loop = [](void* loader) noexcept { static_cast<ProgramLoader*>(loader)->look_for_work(); };
  if (guarded_ == nullptr) {
    look_for_work();
  } else if (!guarded_(loop, this, crash_, sizeof crash_)) {
    static_cast<void>(program_.release());  // its state is unknown
    for (; !ending_.load(std::memory_order_relaxed); std::this_thread::sleep_for(kPoll)) {
      State asked = State::Asked;
      state_.compare_exchange_strong(asked, State::Made, std::memory_order_acq_rel);
    }
  }
}

// The thread polls: waking it would be a system call of the tick.
void ProgramLoader::look_for_work() noexcept {
  for (; !ending_.load(std::memory_order_relaxed); std::this_thread::sleep_for(kPoll)) {
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::Asked) {
      read();
      state_.store(State::Made, std::memory_order_release);
    } else if (state == State::Spent) {
      program_.reset();
      state_.store(State::Free, std::memory_order_release);
    }
  }
}

void ProgramLoader::read() noexcept {
  try {
    other_signals_ = false;
    program_.reset();
    auto program = read_program(names_, urdf_);
    if (!program) {
      why_ = program.error().text;
      return;
    }
    if ((*program)->book.signals != *present_) {
      if (const auto prepared = signals_->prepare((*program)->book.signals); !prepared) {
        why_ = prepared.error();
        return;
      }
      other_signals_ = true;
    }
    program_ = std::move(program).value();
  } catch (const std::exception& wrong) {
    program_.reset();
    why_ = wrong.what();
  }
}

void ProgramLoader::ask(Signals& signals, const std::vector<std::string>& present) noexcept {
  signals_ = &signals;
  present_ = &present;
  if (in_tick_) {
    read();
    state_.store(State::Made, std::memory_order_relaxed);
  } else {
    state_.store(State::Asked, std::memory_order_release);
  }
}

void ProgramLoader::give_back() noexcept {
  if (in_tick_) {
    program_.reset();
  }
  state_.store(in_tick_ ? State::Free : State::Spent, std::memory_order_release);
}

bool ProgramLoader::made() noexcept {
  const auto is_made = [this] { return state_.load(std::memory_order_acquire) == State::Made; };
  if (free() || state_.load(std::memory_order_acquire) == State::Spent) {
    return false;
  }
  if (!(learned_ != nullptr ? learned_(is_made()) : is_made())) {
    return false;
  }
  // In a replay the recorded answer may not be true yet; there is time to wait for it.
  while (!is_made()) {
    std::this_thread::sleep_for(kSoon);
  }
  return true;
}

}  // namespace indurop::robot
