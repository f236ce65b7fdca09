// SPDX-License-Identifier: Apache-2.0
// A process that uses a pool is driven instruction by instruction, as if it was killed after each of them.

#include <gtest/gtest.h>
#include <sys/auxv.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <functional>
#include <memory>

#include "pool_memory.h"

// The thread sanitizer's own threads and signals do not take part in this.
#ifndef __SANITIZE_THREAD__

namespace indurop::pools {
namespace {

using test::SharedPool;

constexpr rt::MonoTime kPublishedAt = rt::mono_time(1000);

// A child that stands before an instruction.
class Driven {
 public:
  explicit Driven(const std::function<void()>& run) : pid_(::fork()) {
    if (pid_ == 0) {
      ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
      ::raise(SIGSTOP);
      run();
      ::_exit(0);
    }
    alive_ = await() && WIFSTOPPED(status_);
  }
  Driven(const Driven&) = delete;
  Driven& operator=(const Driven&) = delete;
  ~Driven() {
    if (alive_) {
      ::kill(pid_, SIGKILL);
      static_cast<void>(await());
    }
  }
  [[nodiscard]] bool alive() const noexcept { return alive_; }
  [[nodiscard]] bool ended_well() const noexcept { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }
  // Returns false when it has ended.
  bool step() {
    alive_ = ::ptrace(PTRACE_SINGLESTEP, pid_, nullptr, nullptr) == 0 && await() && WIFSTOPPED(status_);
    return alive_;
  }

 private:
  bool await() { return ::waitpid(pid_, &status_, 0) == pid_; }
  pid_t pid_;
  int status_ = 0;
  bool alive_ = false;
};

// Before ARMv8.1 an atomic instruction of C++ is a loop of an exclusive load and store, which never ends when it is
// stepped: each step makes the store fail.
bool has_atomic_instructions() {
#ifdef __aarch64__
  return (::getauxval(AT_HWCAP) & HWCAP_ATOMICS) != 0;
#else
  return true;
#endif
}

bool may_trace() {
  Driven child([] {});
  return child.alive() && child.step();
}

// What a module does in some runs: publishes, discards, reads the latest and each chunk, holds two at once.
void use(SharedPool& pool, std::uint32_t seat) {
  for (std::uint64_t i = 1; i <= 3; ++i) {
    if (const auto chunk = pool->take(seat)) {
      pool.content(*chunk).fill(i);
      pool->publish(seat, *chunk, kPublishedAt);
    }
    const auto latest = pool->latest(seat);
    const auto next = pool->next(seat);
    const auto unwanted = pool->take(seat);
    if (unwanted) {
      pool.content(*unwanted).fill(99);
      pool.content(*unwanted).words[3] = 0;
      pool->discard(seat, *unwanted);
    }
    for (const auto& held : {latest, next}) {
      if (held) {
        pool->release(seat, held->chunk);
      }
    }
  }
}

// After each of its instructions the pool is what it was before or after that step of the pool, and nothing is lost but
// what was in its hand.
TEST(Instructions, A_death_after_any_of_them_leaves_a_pool_at_rest) {
  if (!may_trace()) {
    GTEST_SKIP() << "no right to trace processes";
  }
  if (!has_atomic_instructions()) {
    GTEST_SKIP() << "the processor has no atomic instructions (LSE)";
  }
  constexpr std::uint32_t kCount = 3;
  constexpr std::uint32_t kSeat = 7;
  SharedPool pool(kCount);
  Driven child([&] { use(pool, kSeat); });
  const auto copy = std::make_unique<test::Memory>();
  std::uint64_t newest = 0;
  int steps = 0;
  for (; child.step(); ++steps) {
    std::memcpy(static_cast<void*>(copy.get()), &pool.memory(), sizeof(test::Memory));
    Chunks after(copy->header, kCount);
    (void)after.release_all(kSeat);
    ASSERT_NO_FATAL_FAILURE(test::expect_at_rest(*copy, kCount)) << "after instruction " << steps;
    const auto read = after.latest(0);
    ASSERT_GE(read ? read->number : 0, newest) << "after instruction " << steps;
    newest = read ? read->number : 0;
  }
  EXPECT_TRUE(child.ended_well());
  EXPECT_EQ(newest, 3U);
  EXPECT_GT(steps, 500);
  RecordProperty("instructions", steps);
}

}  // namespace
}  // namespace indurop::pools

#endif
