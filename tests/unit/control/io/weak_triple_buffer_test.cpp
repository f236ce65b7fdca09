// SPDX-License-Identifier: Apache-2.0
// The three places between a device's thread and the tick in every execution that C++ allows.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

#include "control/io/triple_buffer.h"

namespace indurop::io {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;

// A value whose halves are equal, with accesses that nothing else orders.
struct Pair {
  std::atomic<int> first;
  std::atomic<int> second;
  Pair() = default;
  Pair(const Pair& other) : Pair() { *this = other; }
  Pair& operator=(const Pair& other) {
    set(other.first.load(std::memory_order_relaxed));
    return *this;
  }
  void set(int value) {
    first.store(value, std::memory_order_relaxed);
    second.store(value, std::memory_order_relaxed);
  }
};

TEST(WeakBuffer, No_value_is_torn_or_goes_back) {
  alignas(TripleBuffer<Pair>) static std::byte memory[sizeof(TripleBuffer<Pair>)];
  static std::string wrong;
  const Outcome outcome = explore([] {
    auto* const buffer = ::new (memory) TripleBuffer<Pair>;
    wrong.clear();
    return Program{{[=] {
                      for (int n = 1; n <= 4; ++n) {
                        buffer->back().set(n);
                        buffer->publish();
                      }
                    },
                    [=] {
                      int last = 0;
                      for (int i = 0; i < 3; ++i) {
                        buffer->update();
                        const int first = buffer->front().first.load(std::memory_order_relaxed);
                        const int second = buffer->front().second.load(std::memory_order_relaxed);
                        wrong += first != second ? "torn " : "";
                        wrong += first < last ? "back " : "";
                        last = first;
                      }
                    }},
                   [] { return wrong; }};
  });
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

}  // namespace
}  // namespace indurop::io
