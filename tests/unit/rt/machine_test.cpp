// SPDX-License-Identifier: Apache-2.0
#include "rt/machine.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

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

TEST(Machine, What_was_freed_before_locking_takes_no_memory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers lock no memory and have a heap of their own";
#endif
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  if (::geteuid() != 0 && limit.rlim_cur != RLIM_INFINITY) {
    GTEST_SKIP() << "memory cannot be locked without root or an unlimited memlock";
  }
  EXPECT_EXIT(lock_after_freeing(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace indurop::rt
