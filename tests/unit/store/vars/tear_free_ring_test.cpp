// SPDX-License-Identifier: Apache-2.0

#include "store/vars/tear_free_ring.h"

#include <gtest/gtest.h>
#include <indurop/detail/variable_access.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "core/rt/shared_mutex.h"

namespace indurop::vars {
namespace {

using Bytes = std::vector<unsigned char>;

// A ring in private memory.
class Ring {
 public:
  explicit Ring(std::uint32_t size, const void* initial = nullptr)
      : size_(size), memory_(static_cast<unsigned char*>(std::aligned_alloc(abi::kAlign, bytes(size)))) {
    std::memset(memory_.get(), 0, bytes(size));
    EXPECT_TRUE(init_ring(memory_.get(), size, initial));
  }
  static std::size_t bytes(std::uint32_t size) { return abi::entry_size(abi::Kind::Ring, size); }
  abi::RingHeader& operator*() { return *reinterpret_cast<abi::RingHeader*>(memory_.get()); }
  abi::RingHeader* operator->() { return &**this; }
  Bytes value() {
    Bytes copy(size_);
    EXPECT_TRUE(try_read(**this, size_, 0, copy.data(), size_));
    return copy;
  }

 private:
  struct Free {
    void operator()(unsigned char* memory) const { std::free(memory); }
  };
  std::uint32_t size_;
  std::unique_ptr<unsigned char, Free> memory_;
};

void write(Ring& ring, std::uint32_t offset, const Bytes& data) {
  auto* slot = static_cast<unsigned char*>(begin_write(*ring, offset, static_cast<std::uint32_t>(data.size())));
  ASSERT_NE(slot, nullptr);
  std::memcpy(slot + offset, data.data(), data.size());
  commit(*ring);
}

TEST(Ring, Starts_with_the_initial_value) {
  const Bytes initial{1, 2, 3};
  Ring sut(3, initial.data());
  EXPECT_EQ(sut.value(), initial);
}

class RingOfSize : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Sizes, RingOfSize, testing::Values(1U, 24U, 64U, 256U, 512U, 513U, 1000U, 4096U, 100'000U));

// Writes of parts, whole values, edits, given-up writes with traces left in the slot: the value is always what a
// plain array would hold.
TEST_P(RingOfSize, Behaves_like_an_array) {
  const std::uint32_t size = GetParam();
  Ring sut(size);
  Bytes model(size, 0);
  std::mt19937 random(size);
  const auto pick = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
  const int steps = size > 10'000 ? 300 : 2000;
  for (int i = 0; i < steps; ++i) {
    const std::uint32_t offset = pick(4) == 0 ? 0 : pick(size);
    const std::uint32_t length = pick(8) == 0 ? size - offset : 1 + pick(std::min(size - offset, 40U));
    const bool whole = pick(10) == 0;
    const bool give_up = pick(4) == 0;
    auto* slot = static_cast<unsigned char*>(whole ? begin_edit(*sut) : begin_write(*sut, offset, length));
    ASSERT_NE(slot, nullptr);
    if (whole) {
      ASSERT_EQ(std::memcmp(slot, model.data(), size), 0) << "edit " << i;
    }
    std::memset(slot + offset, i & 0xFF, length);
    if (give_up) {
      discard(*sut);
    } else {
      std::memset(model.data() + offset, i & 0xFF, length);
      commit(*sut);
    }
    ASSERT_EQ(sut.value(), model) << "step " << i;
  }
}

TEST(Ring, Small_write_to_a_large_value_announces_a_small_change) {
  Ring sut(10'000'000);
  for (std::uint32_t i = 0; i < 8; ++i) {
    write(sut, i * 1'000'000, {1, 2, 3});
  }
  for (const abi::DirtyRange& dirty : sut->dirty) {
    EXPECT_EQ(dirty.length, 3U);
  }
}

TEST(Ring, Writer_holding_the_lock_may_not_begin_again) {
  Ring sut(24);
  ASSERT_NE(begin_edit(*sut), nullptr);
  EXPECT_EQ(begin_write(*sut, 0, 8), nullptr);
  EXPECT_EQ(sut->lost_writes.load(), 1U);
  discard(*sut);
  EXPECT_NE(begin_write(*sut, 0, 8), nullptr);
  discard(*sut);
}

TEST(Ring, Lock_of_a_stopped_holder_is_given_up) {
  Ring sut(24);
  std::thread([&] {
    ASSERT_NE(begin_edit(*sut), nullptr);
    std::thread([&] {
      const auto before = std::chrono::steady_clock::now();
      EXPECT_EQ(begin_write(*sut, 0, 8), nullptr);
      EXPECT_GE(std::chrono::steady_clock::now() - before, rt::kLockLimit);
    }).join();
    discard(*sut);
  }).join();
  EXPECT_EQ(sut->lost_writes.load(), 1U);
  EXPECT_TRUE(check_ring(*sut, 24));
}

TEST(Ring, Write_of_a_thread_that_ended_inside_is_dropped_without_traces) {
  for (const std::uint32_t size : {24U, 4096U}) {
    Ring sut(size);
    write(sut, 0, Bytes(size, 1));
    const Bytes before = sut.value();
    std::thread([&] {
      auto* slot = static_cast<unsigned char*>(begin_write(*sut, 8, 8));
      std::memset(slot + 8, 0xFF, 8);
    }).join();
    EXPECT_EQ(sut.value(), before);
    write(sut, 0, {2});
    Bytes expected = before;
    expected[0] = 2;
    EXPECT_EQ(sut.value(), expected);
    EXPECT_EQ(sut->lost_writes.load(), 0U);
  }
}

TEST(Ring, Release_frees_only_what_the_caller_holds) {
  Ring sut(24);
  release_if_mine(*sut, rt::this_thread());
  ASSERT_NE(begin_edit(*sut), nullptr);
  std::thread([&] { release_if_mine(*sut, rt::this_thread()); }).join();
  std::thread([&] { EXPECT_EQ(begin_edit(*sut), nullptr); }).join();
  release_if_mine(*sut, rt::this_thread());
  std::thread([&] {
    EXPECT_NE(begin_edit(*sut), nullptr);
    commit(*sut);
  }).join();
}

TEST(Ring, Slow_read_gets_through_against_a_writer_without_pause) {
  constexpr std::uint32_t kSize = 64 * 1024;
  Ring sut(kSize);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (unsigned i = 0; !stop; ++i) {
      auto* slot = static_cast<unsigned char*>(begin_write(*sut, 0, kSize));
      if (slot != nullptr) {
        const Bytes value(kSize, static_cast<unsigned char>(i));
        indurop::detail::copy_to_shared(slot, value.data(), kSize);
        commit(*sut);
      }
    }
  });
  for (int i = 0; i < 50; ++i) {
    Bytes copy(kSize);
    read_slow(*sut, copy.data(), 0, kSize);
    EXPECT_EQ(copy, Bytes(kSize, copy[0]));
  }
  stop = true;
  writer.join();
}

TEST(Ring, Lock_memory_that_was_overwritten_is_noticed) {
  Ring sut(24);
  EXPECT_TRUE(check_ring(*sut, 24));
  EXPECT_FALSE(check_ring(*sut, 32));
  const std::uint32_t no_thread = 0x3FFFFFF0;  // beyond the largest thread id
  std::memcpy(&sut->lock, &no_thread, sizeof(no_thread));
  EXPECT_FALSE(check_ring(*sut, 24));
  EXPECT_EQ(begin_write(*sut, 0, 8), nullptr);
  EXPECT_EQ(sut.value(), Bytes(24, 0));
}

}  // namespace
}  // namespace indurop::vars
