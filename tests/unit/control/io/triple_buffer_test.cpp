// SPDX-License-Identifier: Apache-2.0
// A writer and a reader that never wait for each other.
#include "control/io/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

namespace indurop::io {
namespace {

TEST(TripleBuffer, Gives_the_newest_value_once) {
  TripleBuffer<int> sut;
  sut.fill(7);
  EXPECT_FALSE(sut.update());
  EXPECT_EQ(sut.front(), 7);
  sut.back() = 1;
  sut.publish();
  sut.back() = 2;
  sut.publish();
  EXPECT_TRUE(sut.update());
  EXPECT_EQ(sut.front(), 2);
  EXPECT_FALSE(sut.update());
  EXPECT_EQ(sut.front(), 2);
}

TEST(TripleBuffer, Front_stays_while_the_writer_goes_on) {
  TripleBuffer<int> sut;
  sut.back() = 1;
  sut.publish();
  ASSERT_TRUE(sut.update());
  for (int i = 2; i < 10; ++i) {
    sut.back() = i;
    sut.publish();
    EXPECT_EQ(sut.front(), 1);
  }
  ASSERT_TRUE(sut.update());
  EXPECT_EQ(sut.front(), 9);
}

TEST(TripleBuffer, Never_tears_and_never_goes_back) {
  constexpr std::size_t kWords = 64;
  constexpr std::uint64_t kRounds = 200'000;
  TripleBuffer<std::array<std::uint64_t, kWords>> sut;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kRounds; ++n) {
      sut.back().fill(n);
      sut.publish();
    }
  });
  std::uint64_t last = 0;
  bool torn = false;
  while (last < kRounds) {
    if (!sut.update()) {
      continue;
    }
    const std::uint64_t first = sut.front()[0];
    for (const std::uint64_t word : sut.front()) {
      torn = torn || word != first;
    }
    torn = torn || first <= last;
    last = first;
  }
  writer.join();
  EXPECT_FALSE(torn);
}

}  // namespace
}  // namespace indurop::io
