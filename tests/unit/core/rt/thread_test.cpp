// SPDX-License-Identifier: Apache-2.0
#include "core/rt/thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

namespace indurop::rt {
namespace {

constexpr std::size_t kStack = std::size_t{128} * 1024;

thread_local volatile char large[16 * kStack];

TEST(Thread, Has_its_whole_stack_in_addition_to_large_thread_local_variables) {
  ThreadSettings small;
  small.name = "small";
  small.stack_bytes = kStack;
  std::atomic<bool> done{false};
  auto sut = Thread::start(small, [&done] {
    volatile char used[kStack / 2];
    for (std::size_t at = 0; at < sizeof used; at += 512) {
      used[at] = 1;
    }
    large[0] = used[0];
    done = large[0] == 1;
  });
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  sut.value().join();
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace indurop::rt
