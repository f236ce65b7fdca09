// SPDX-License-Identifier: Apache-2.0
// Waking another process on the same core: the wake-up of a process module against a bare futex, in turn. Both sides
// need SCHED_FIFO, the woken one above the waker, so the time is from the waker's call to the first instruction.
// Prints "futex_p50_ns futex_p99_ns module_p50_ns module_p99_ns".

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <new>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/machine.h"
#include "core/rt/signal_word.h"
#include "core/rt/thread.h"

namespace {

using namespace indurop::rt;

constexpr int kRounds = 20'000;
constexpr int kChild = 60;
constexpr int kParent = 50;

struct Shared {
  std::atomic<std::uint32_t> futex_word{0};
  SignalWord word{};
  std::atomic<std::int64_t> sent_ns{0};
  std::int64_t futex_ns[kRounds]{};
  std::int64_t module_ns[kRounds]{};
};

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t seen) {
  ::syscall(SYS_futex, &word, FUTEX_WAIT, seen, nullptr, nullptr, 0);
}

void child(Shared& shared) {
  for (int i = 0; i < kRounds; ++i) {
    const auto seen = static_cast<std::uint32_t>(i);
    while (shared.futex_word.load() == seen) {
      futex_wait(shared.futex_word, seen);
    }
    shared.futex_ns[i] = now_ns() - shared.sent_ns.load();
    shared.word.wait();
    shared.module_ns[i] = now_ns() - shared.sent_ns.load();
  }
}

std::int64_t at(std::int64_t* values, double fraction) {
  std::sort(values, values + kRounds);
  return values[static_cast<int>(fraction * (kRounds - 1))];
}

}  // namespace

int main() {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& shared = *new (memory) Shared;
  shared.word.init(true);
  const int core = allowed_cores().back();
  auto idle = ShortIdle::hold();
  const pid_t process = ::fork();
  if (!pin_to_core(core) || !set_fifo(process == 0 ? kChild : kParent)) {
    std::fprintf(stderr, "needs SCHED_FIFO\n");
    return 77;
  }
  if (process == 0) {
    child(shared);
    ::_exit(0);
  }
  const auto pause = [] { sleep_until(now_ns() + 50'000); };
  pause();
  for (int i = 0; i < kRounds; ++i) {
    pause();
    shared.sent_ns.store(now_ns());
    shared.futex_word.fetch_add(1);
    ::syscall(SYS_futex, &shared.futex_word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
    pause();
    shared.sent_ns.store(now_ns());
    shared.word.wake();
  }
  ::waitpid(process, nullptr, 0);
  std::printf("%lld %lld ", static_cast<long long>(at(shared.futex_ns, 0.5)),
              static_cast<long long>(at(shared.futex_ns, 0.99)));
  std::printf("%lld %lld\n", static_cast<long long>(at(shared.module_ns, 0.5)),
              static_cast<long long>(at(shared.module_ns, 0.99)));
  return 0;
}
