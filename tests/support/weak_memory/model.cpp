// SPDX-License-Identifier: Apache-2.0
#include "tests/support/weak_memory/model.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <unordered_set>
#include <utility>

#include "core/rt/fiber.h"
#include "tests/support/weak_memory/memory.h"

namespace indurop::test::weak {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;

std::uint64_t bits_at(const void* place, std::size_t size) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, place, size);
  return bits;
}

// The choices of an execution, each out of `count`; the next execution takes the next of them.
class Choices {
 public:
  std::size_t choose(std::size_t count) {
    if (at_ == made_.size()) {
      made_.push_back({0, count});
    }
    return made_[at_++].chosen;
  }
  // The execution goes beyond what the one before it did.
  [[nodiscard]] bool is_new() const { return at_ >= made_.size(); }
  void begin() { at_ = 0; }
  // False: there are no more.
  bool advance() {
    while (!made_.empty() && made_.back().chosen + 1 == made_.back().count) {
      made_.pop_back();
    }
    if (made_.empty()) {
      return false;
    }
    ++made_.back().chosen;
    return true;
  }

 private:
  struct Choice {
    std::size_t chosen;
    std::size_t count;
  };
  std::vector<Choice> made_;
  std::size_t at_ = 0;
};

class Model {
 public:
  Model(const Weakening& without, std::uint64_t max_states)
      : max_states_(max_states), memory_(without, [this](std::size_t count) { return choose(count); }) {}

  Outcome run(const std::function<Program()>& make);

  // The next step of the running thread, after which another one may run.
  Memory& step() {
    rt::Fiber::pause();
    return memory_;
  }
  Memory& memory() noexcept { return memory_; }
  [[nodiscard]] std::size_t running() const noexcept { return running_; }
  void wait_for(const void* mutex) { threads_[running_].waits_for = mutex; }

 private:
  struct Thread {
    const void* waits_for = nullptr;  // a mutex
    bool ended = false;
  };

  void make_fibers(std::size_t count);
  void execute(const Program& program);
  [[nodiscard]] std::vector<std::size_t> ready() const;
  [[nodiscard]] std::string result(const Program& program);
  std::size_t choose(std::size_t count) { return branches_ && count > 1 ? choices_.choose(count) : 0; }

  std::uint64_t max_states_;
  Memory memory_;
  std::vector<std::unique_ptr<rt::Fiber>> fibers_;
  const Program* program_ = nullptr;
  std::vector<Thread> threads_;
  std::size_t running_ = 0;
  Choices choices_;
  bool branches_ = true;  // false: the rest of this execution is of no interest
  std::unordered_set<std::uint64_t> seen_;
};

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): what the replaced atomics speak to
Model* current = nullptr;

void Model::make_fibers(std::size_t count) {
  while (fibers_.size() < count) {
    const std::size_t i = fibers_.size();
    fibers_.push_back(std::make_unique<rt::Fiber>(kStackBytes, [this, i] {
      for (;;) {
        program_->threads[i]();
        threads_[i].ended = true;
        rt::Fiber::pause();
      }
    }));
  }
}

std::vector<std::size_t> Model::ready() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (!threads_[i].ended && (threads_[i].waits_for == nullptr || memory_.is_free(threads_[i].waits_for))) {
      found.push_back(i);
    }
  }
  return found;
}

void Model::execute(const Program& program) {
  program_ = &program;
  threads_.assign(program.threads.size(), {});
  memory_.reset(program.threads.size());
  choices_.begin();
  branches_ = true;
  // Each thread stands before its next step, always.
  for (running_ = 0; running_ < threads_.size(); ++running_) {
    fibers_[running_]->resume();
  }
  for (std::vector<std::size_t> next = ready(); !next.empty(); next = ready()) {
    if (branches_ && choices_.is_new() && !seen_.insert(memory_.state()).second) {
      branches_ = false;
    }
    running_ = next[choose(next.size())];
    fibers_[running_]->resume();
  }
}

std::string Model::result(const Program& program) {
  const bool all_ended = std::all_of(threads_.begin(), threads_.end(), [](const Thread& one) { return one.ended; });
  return all_ended ? program.check() : "threads wait for each other";
}

Outcome Model::run(const std::function<Program()>& make) {
  Outcome outcome;
  for (;;) {
    memory_.reset(0);
    const Program program = make();
    make_fibers(program.threads.size());
    execute(program);
    if (!memory_.knew_all()) {
      seen_.clear();
      choices_ = {};
      outcome.executions = 0;
      continue;
    }
    outcome.states = seen_.size();
    if (branches_) {
      ++outcome.executions;
      outcome.wrong = result(program);
    }
    outcome.complete = outcome.wrong.empty() && !choices_.advance();
    if (outcome.complete || !outcome.wrong.empty() || seen_.size() > max_states_) {
      return outcome;
    }
  }
}

bool in_model() {
  return current != nullptr && rt::Fiber::current() != nullptr;
}

}  // namespace

Outcome explore(const std::function<Program()>& make, const Weakening& without, std::uint64_t max_states) {
  Model model(without, max_states);
  current = &model;
  const Outcome outcome = model.run(make);
  current = nullptr;
  return outcome;
}

std::uint64_t load(const void* place, std::size_t size, int order) {
  if (!in_model()) {
    return current != nullptr ? current->memory().final_value(place, size) : bits_at(place, size);
  }
  if (!current->memory().is_written(place)) {
    return bits_at(place, size);
  }
  return current->step().load(current->running(), place, size, order);
}

void store(void* place, std::uint64_t value, std::size_t size, int order) {
  if (!in_model()) {
    std::memcpy(place, &value, size);
    return;
  }
  current->memory().note_write(place);
  current->step().store(current->running(), place, value, size, order);
}

std::uint64_t modify(void* place, std::size_t size, int order, int failed,
                     const std::function<bool(std::uint64_t&)>& change) {
  if (in_model()) {
    current->memory().note_write(place);
    return current->step().modify(current->running(), place, size, order, failed, change);
  }
  const std::uint64_t before = bits_at(place, size);
  std::uint64_t after = before;
  if (change(after)) {
    std::memcpy(place, &after, size);
  }
  return before;
}

void fence(int order) {
  if (in_model()) {
    // Only the order of sequential fences is one more thing that differs.
    Memory& memory = order == __ATOMIC_SEQ_CST ? current->step() : current->memory();
    memory.fence(current->running(), order);
  }
}

void fence_all() {
  if (in_model()) {
    current->step().fence_all(current->running());
  }
}

void lock(const void* place) {
  if (in_model()) {
    current->wait_for(place);
    current->step().lock(current->running(), place);
    current->wait_for(nullptr);
  }
}

void unlock(const void* place) {
  if (in_model()) {
    current->step().unlock(current->running(), place);
  }
}

}  // namespace indurop::test::weak
