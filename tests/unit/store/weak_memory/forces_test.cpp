// SPDX-License-Identifier: Apache-2.0
// A forced number against a writer without lock, in every execution that C++ allows: once it is forced, it stays so.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

// NOLINTBEGIN(bugprone-suspicious-include): compiled here with the atomics of the model
#include "store/vars/forces.cpp"
// NOLINTEND(bugprone-suspicious-include)

// NOLINTNEXTLINE(readability-identifier-naming): of libindurop
extern "C" bool indurop_hold_scalar(void* entry) noexcept {
  return indurop::vars::hold_scalar(entry);
}

namespace indurop::rt {

void barrier_on_all_processors() noexcept {
  test::weak::fence_all();
}

}  // namespace indurop::rt

namespace indurop::vars {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;

class WeakForce : public testing::Test {
 protected:
  void reset() {
    std::fill(std::begin(memory_), std::end(memory_), std::byte{0});
    header().virtual_ns.store(1);
  }
  BlockHeader& header() { return *reinterpret_cast<BlockHeader*>(memory_); }
  void* number() { return memory_ + variable_.offset; }
  void force_to(std::uint64_t value) {
    const Status status = force(header(), {&variable_, 0, sizeof(std::uint32_t), value, kForever});
    EXPECT_TRUE(status);
  }
  // What is wrong if the number does not have this value at the end.
  std::string unless(std::uint32_t value) {
    const auto last = __atomic_load_n(static_cast<std::uint32_t*>(number()), __ATOMIC_RELAXED);
    return last == value ? "" : "it is " + std::to_string(last);
  }

  static constexpr std::size_t kHeader = (sizeof(BlockHeader) + abi::kAlign - 1) / abi::kAlign * abi::kAlign;
  DirectoryEntry variable_{1, 1, kHeader, sizeof(std::uint32_t), abi::Kind::Scalar, 0, 0};
  alignas(64) std::byte memory_[kHeader + abi::kAlign]{};
};

TEST_F(WeakForce, Holds_against_a_write_at_the_same_time) {
  const Outcome outcome = explore([this] {
    reset();
    return Program{{[this] { detail::scalar_write<std::uint32_t>(number(), 5); }, [this] { force_to(9); }},
                   [this] { return unless(9); }};
  });
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST_F(WeakForce, Holds_against_a_change_at_the_same_time) {
  const Outcome outcome = explore([this] {
    reset();
    return Program{
        {[this] { detail::scalar_modify<std::uint32_t>(number(), [](std::uint32_t before) { return before + 1; }); },
         [this] { force_to(9); }},
        [this] { return unless(9); }};
  });
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST_F(WeakForce, Is_changed_against_a_write_at_the_same_time) {
  const Outcome outcome = explore([this] {
    reset();
    force_to(9);
    return Program{{[this] { detail::scalar_write<std::uint32_t>(number(), 5); }, [this] { force_to(10); }},
                   [this] { return unless(10); }};
  });
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

}  // namespace
}  // namespace indurop::vars
