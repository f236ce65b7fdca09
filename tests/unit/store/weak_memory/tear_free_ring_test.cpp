// SPDX-License-Identifier: Apache-2.0
// A variable of several bytes in every execution that C++ allows: no reader sees a value that was never written, none
// goes back in time, no change of a part is lost; and each barrier of the code is needed for that.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

// NOLINTBEGIN(bugprone-suspicious-include): compiled here with the atomics of the model
#include "store/vars/tear_free_ring.cpp"
// NOLINTEND(bugprone-suspicious-include)

namespace indurop::rt {

// The lock of a variable is a mutex of the model; its holders live.
int take_free(SharedMutex& mutex) noexcept {
  test::weak::lock(&mutex);
  return 0;
}
LockResult lock_refused(SharedMutex& /*mutex*/, int /*error*/, std::chrono::nanoseconds /*limit*/) noexcept {
  return LockResult::Broken;
}
LockResult try_lock(SharedMutex& mutex) noexcept {
  test::weak::lock(&mutex);
  return LockResult::Locked;
}
int release(SharedMutex& mutex) noexcept {
  test::weak::unlock(&mutex);
  return 0;
}
bool held_by(const SharedMutex& /*mutex*/, ThreadId /*thread*/) noexcept {
  return false;
}
bool init_shared_mutex(SharedMutex& /*mutex*/) noexcept {
  return true;
}
void inherit_shared_mutex(SharedMutex& /*mutex*/) noexcept {}

}  // namespace indurop::rt

namespace indurop::vars {

namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;
using test::weak::Weakening;

struct Value {
  std::uint8_t first;
  std::uint8_t second;
};

class WeakRing : public testing::Test {
 protected:
  static constexpr int kWrites = 5;  // the fifth one reuses the slot of the first

  void reset() {
    std::fill(std::begin(memory_), std::end(memory_), std::byte{0});
    const Value initial{0, 0};
    init_ring(memory_, sizeof(Value), &initial);
  }
  abi::RingHeader& ring() { return *reinterpret_cast<abi::RingHeader*>(memory_); }

  void write(Value value) {
    void* const to = begin_write(ring(), 0, sizeof value);
    detail::copy_to_shared(to, &value, sizeof value);
    commit(ring());
  }
  // One try without lock; nothing if it was overtaken.
  std::optional<Value> read() {
    Value value{};
    const std::uint64_t seq = ring().seq.load(std::memory_order_acquire);
    if (!detail::try_copy(&ring(), abi::slot_stride(sizeof(Value)), seq, &value, 0, sizeof value)) {
      return std::nullopt;
    }
    return value;
  }

  // One writer, whose value n is (n, n), and a reader that reads twice.
  Outcome one_writer(const Weakening& without = {}) {
    return explore(
        [this] {
          reset();
          for (auto& one : read_) {
            one.reset();
          }
          return Program{{[this] {
                            for (std::uint8_t n = 1; n <= kWrites; ++n) {
                              write({n, n});
                            }
                          },
                          [this] {
                            for (auto& one : read_) {
                              one = read();
                            }
                          }},
                         [this] { return wrong(); }};
        },
        without);
  }
  std::string wrong() const {
    std::uint8_t last = 0;
    for (const auto& one : read_) {
      if (one && one->first != one->second) {
        return "torn: " + std::to_string(one->first) + ", " + std::to_string(one->second);
      }
      if (one && one->first < last) {
        return "back from " + std::to_string(last) + " to " + std::to_string(one->first);
      }
      last = one ? one->first : last;
    }
    return {};
  }

  alignas(64) std::byte memory_[sizeof(abi::RingHeader) + abi::kSlots * abi::slot_stride(sizeof(Value))]{};
  std::array<std::optional<Value>, 2> read_{};
};

TEST_F(WeakRing, No_value_is_torn_or_goes_back) {
  const Outcome outcome = one_writer();
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
  RecordProperty("states", std::to_string(outcome.states));
}

TEST_F(WeakRing, Each_barrier_is_needed) {
  EXPECT_NE(one_writer({.no_acquire_fences = true}).wrong, "") << "in try_copy()";
  EXPECT_NE(one_writer({.no_release_fences = true}).wrong, "") << "in open_slot()";
  EXPECT_NE(one_writer({.no_acquire_loads = true}).wrong, "") << "of seq";
  EXPECT_NE(one_writer({.no_release_stores = true}).wrong, "") << "of seq";
}

// Of a large value only the differences are copied from version to version.
TEST_F(WeakRing, Parts_of_a_large_value_are_not_torn) {
  constexpr std::uint32_t kSize = kWholeCopyLimit + 8;
  constexpr std::uint32_t kPart = 300;  // two bytes there are changed by turns: first, second, first, ...
  alignas(64) static std::byte memory[sizeof(abi::RingHeader) + abi::kSlots * abi::slot_stride(kSize)];
  auto& large = *reinterpret_cast<abi::RingHeader*>(memory);
  const auto change = [&](std::uint32_t n) {
    const auto value = static_cast<std::uint8_t>(n / 2 + 1);
    auto* const to = static_cast<unsigned char*>(begin_write(large, kPart + n % 2, 1));
    detail::copy_to_shared(to + kPart + n % 2, &value, 1);
    commit(large);
  };
  Value seen{};
  bool is_whole = false;
  const auto run = [&](const Weakening& without) {
    return explore(
        [&] {
          std::fill(std::begin(memory), std::end(memory), std::byte{0});
          init_ring(memory, kSize, nullptr);
          for (std::uint32_t n = 0; n < abi::kSlots; ++n) {
            change(n);  // the first versions are copied whole
          }
          is_whole = false;
          return Program{{[&] {
                            for (std::uint32_t n = abi::kSlots; n < 2 * abi::kSlots + 1; ++n) {
                              change(n);
                            }
                          },
                          [&] {
                            const std::uint64_t seq = large.seq.load(std::memory_order_acquire);
                            is_whole =
                                detail::try_copy(&large, abi::slot_stride(kSize), seq, &seen, kPart, sizeof seen);
                          }},
                         [&] {
                           const bool good = seen.first == seen.second || seen.first == seen.second + 1;
                           return is_whole && !good ? std::string("torn") : std::string();
                         }};
        },
        without);
  };
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
  EXPECT_NE(run({.no_release_fences = true}).wrong, "");
}

TEST_F(WeakRing, Two_that_change_a_part_lose_nothing) {
  const auto change = [this](std::size_t part) {
    auto* const to = static_cast<unsigned char*>(begin_write(ring(), static_cast<std::uint32_t>(part), 1));
    const std::uint64_t now = ring().seq.load(std::memory_order_relaxed);
    std::uint8_t value = 0;
    detail::copy_from_shared(&value, detail::slot(&ring(), now, abi::slot_stride(sizeof(Value))) + part, 1);
    ++value;
    detail::copy_to_shared(to + part, &value, 1);
    commit(ring());
  };
  std::optional<Value> seen;
  const Outcome outcome = explore([&] {
    reset();
    seen.reset();
    return Program{{[&] {
                      change(0);
                      change(1);
                    },
                    [&] {
                      change(1);
                      change(0);
                    },
                    [&] { seen = read(); }},
                   [&] {
                     const Value last = read().value();
                     if (last.first != 2 || last.second != 2) {
                       return "lost: " + std::to_string(last.first) + ", " + std::to_string(last.second);
                     }
                     // Changes by turns, so the two parts are never further apart than the changes under way.
                     return seen && (seen->first > 2 || seen->second > 2) ? std::string("never written") : "";
                   }};
  });
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

}  // namespace
}  // namespace indurop::vars
