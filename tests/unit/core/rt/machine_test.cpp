// SPDX-License-Identifier: Apache-2.0
#include "core/rt/machine.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/rt/thread.h"

namespace indurop::rt {
namespace {

// A line of /proc/self/status in kB.
long status_kb(const char* key) {
  std::FILE* const file = std::fopen("/proc/self/status", "re");
  char line[256];
  long value = -1;
  while (file != nullptr && value < 0 && std::fgets(line, sizeof line, file) != nullptr) {
    if (std::strncmp(line, key, std::strlen(key)) == 0) {
      value = std::strtol(line + std::strlen(key) + 1, nullptr, 10);
    }
  }
  if (file != nullptr) {
    std::fclose(file);
  }
  return value;
}

constexpr long kMegabyte = 1024;  // in kB

// Ends the process, 0: good. A process of its own, because locked stays locked.
[[noreturn]] void lock_after_freeing() {
  constexpr std::size_t kBlock = 4000;
  std::vector<void*> blocks(10'000);
  for (void*& block : blocks) {
    block = std::malloc(kBlock);
    std::memset(block, 1, kBlock);
  }
  void* const stays = std::malloc(kBlock);  // so the heap cannot simply become shorter
  std::memset(stays, 1, kBlock);
  for (void* block : blocks) {
    std::free(block);
  }
  if (!lock_memory()) {
    std::_Exit(2);
  }
  const long resident = status_kb("RssAnon:");
  void* const later = std::malloc(kBlock);
  std::memset(later, 1, kBlock);
  const bool good = resident > 0 && resident < 30 * kMegabyte && static_cast<char*>(stays)[100] == 1 &&
                    status_kb("VmLck:") > kMegabyte;
  std::fprintf(stderr, "resident %ld kB, locked %ld kB\n", resident, status_kb("VmLck:"));
  std::_Exit(good ? 0 : 1);
}

bool may_lock() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;  // sanitizers lock no memory and have a heap of their own
#endif
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  return ::geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY;
}

// Pages of the calling thread's stack that are in memory, and all of them but the guard's.
struct StackPages {
  std::size_t present = 0;
  std::size_t all = 0;
};
StackPages stack_pages() {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const StackBounds stack = own_stack();
  std::vector<unsigned char> there(stack.bytes / page);
  StackPages pages{0, there.size()};
  if (::mincore(const_cast<char*>(stack.lowest), stack.bytes, there.data()) == 0) {
    pages.present =
        static_cast<std::size_t>(std::count_if(there.begin(), there.end(), [](auto one) { return (one & 1U) != 0; }));
  }
  return pages;
}

// What a program takes that starts threads with large stacks before and after memory is locked.
[[noreturn]] void lock_between_threads() {
  constexpr std::size_t kLargeStack = 32U << 20U;
  auto before = Thread::start({"before", 0, -1, kLargeStack}, [] {});
  if (!before) {
    std::_Exit(3);
  }
  before.value().join();
  if (!lock_memory()) {
    std::_Exit(2);
  }
  long resident = 0;
  auto later = Thread::start({"later", 0, -1, kLargeStack}, [&resident] { resident = status_kb("RssAnon:"); });
  later.value().join();
  std::fprintf(stderr, "resident %ld kB\n", resident);
  std::_Exit(resident > 0 && resident < 20 * kMegabyte ? 0 : 1);
}

// The same of threads that come, allocate, and go. A heap of one's own is 64 MB, and locked although it is not used.
[[noreturn]] void allocate_in_threads() {
  if (!lock_memory()) {
    std::_Exit(2);
  }
  const long locked = status_kb("VmLck:");
  std::vector<Thread> threads(4);
  std::atomic<int> allocated{0};
  long later = 0;
  for (Thread& one : threads) {
    auto started = Thread::start({"allocates", 0, -1}, [&allocated, &later] {
      void* const block = std::malloc(100'000);
      std::memset(block, 1, 100'000);
      if (++allocated == 4) {
        later = status_kb("VmLck:");
      }
      while (allocated.load() < 4) {
        std::this_thread::yield();
      }
      std::free(block);
    });
    one = std::move(started).value();
  }
  threads.clear();
  std::fprintf(stderr, "locked %ld kB, then %ld kB\n", locked, later);
  std::_Exit(locked > 0 && later > 0 && later - locked < 60 * kMegabyte ? 0 : 1);
}

TEST(Machine, Threads_that_allocate_take_no_locked_heap_each) {
  if (!may_lock()) {
    GTEST_SKIP() << "memory cannot be locked: without root, without an unlimited memlock, or with a sanitizer";
  }
  EXPECT_EXIT(allocate_in_threads(), ::testing::ExitedWithCode(0), "");
}

TEST(Machine, Unused_stacks_take_no_locked_memory) {
  if (!may_lock()) {
    GTEST_SKIP() << "memory cannot be locked: without root, without an unlimited memlock, or with a sanitizer";
  }
  EXPECT_EXIT(lock_between_threads(), ::testing::ExitedWithCode(0), "");
}

// How much of the mapping that begins here is in memory, in kB.
long resident_kb(const void* begin) {
  std::FILE* const file = std::fopen("/proc/self/smaps", "re");
  char line[512];
  bool here = false;
  long value = -1;
  while (file != nullptr && value < 0 && std::fgets(line, sizeof line, file) != nullptr) {
    const bool heading = std::strchr(line, '-') != nullptr && std::strchr(line, ':') > std::strchr(line, '-');
    here = heading ? std::strtoull(line, nullptr, 16) == reinterpret_cast<std::uintptr_t>(begin) : here;
    value = here && std::strncmp(line, "Rss:", 4) == 0 ? std::strtol(line + 4, nullptr, 10) : value;
  }
  if (file != nullptr) {
    std::fclose(file);
  }
  return value;
}

// Two equal mappings of a file, as code is; one of them need not stay.
[[noreturn]] void lock_but_for_code() {
  constexpr std::size_t kBytes = 64U << 10U;
  const int file = ::open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
  const auto map = [file](off_t from) {
    return static_cast<const char*>(::mmap(nullptr, kBytes, PROT_READ, MAP_PRIVATE, file, from));
  };
  const char* const stays = map(0);
  const char* const goes = map(kBytes);
  const char before = goes[100];
  if (!lock_memory({}, std::span(goes, kBytes))) {
    std::_Exit(2);
  }
  std::fprintf(stderr, "stays %ld kB, goes %ld kB\n", resident_kb(stays), resident_kb(goes));
  const bool good = resident_kb(stays) == kBytes / 1024 && resident_kb(goes) == 0 && goes[100] == before;
  std::_Exit(good ? 0 : 1);
}

TEST(Machine, Code_that_is_named_does_not_stay_in_memory_and_comes_back_when_it_is_used) {
  if (!may_lock()) {
    GTEST_SKIP() << "memory cannot be locked: without root, without an unlimited memlock, or with a sanitizer";
  }
  EXPECT_EXIT(lock_but_for_code(), ::testing::ExitedWithCode(0), "");
}

TEST(Thread, Stack_of_a_real_time_thread_is_there_before_it_runs) {
  StackPages urgent;
  StackPages normal;
  {
    auto one = Thread::start({"urgent", 1, -1, 1U << 20U}, [&urgent] { urgent = stack_pages(); });
    auto other = Thread::start({"normal", 0, -1, 1U << 20U}, [&normal] { normal = stack_pages(); });
    ASSERT_TRUE(one.ok() && other.ok());
  }
  EXPECT_GT(urgent.all, 200U);
  EXPECT_EQ(urgent.present, urgent.all);
  EXPECT_LT(normal.present, normal.all);
}

TEST(Machine, What_was_freed_before_locking_takes_no_memory) {
  if (!may_lock()) {
    GTEST_SKIP() << "memory cannot be locked: without root, without an unlimited memlock, or with a sanitizer";
  }
  EXPECT_EXIT(lock_after_freeing(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace indurop::rt
