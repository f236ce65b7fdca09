// SPDX-License-Identifier: Apache-2.0
// The chunks of a pool in every execution that C++ allows: what a reader holds is whole and does not change, and no
// reader gets an older chunk than before.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

// NOLINTBEGIN(bugprone-suspicious-include): compiled here with the atomics of the model
#include "store/pools/chunks.cpp"
// NOLINTEND(bugprone-suspicious-include)

namespace indurop::pools {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;
using test::weak::Weakening;

constexpr std::uint32_t kWriter = 0;
constexpr std::uint32_t kReader = 1;

// Two words, whose accesses nothing else orders.
struct Content {
  Atomic<int> first;
  Atomic<int> second;
};
struct Memory {
  PoolHeader header;
  std::array<Content, kMaxChunks> contents;
};
alignas(Memory) std::array<std::byte, sizeof(Memory)> bytes{};

Memory& memory() {
  return *reinterpret_cast<Memory*>(bytes.data());
}

void write(Chunks& chunks, int value) {
  if (const auto chunk = chunks.take(kWriter)) {
    memory().contents[*chunk].first.store(value, std::memory_order_relaxed);
    memory().contents[*chunk].second.store(value, std::memory_order_relaxed);
    chunks.publish(kWriter, *chunk, rt::MonoTime{});
  }
}

// What is wrong with a chunk that is read while it is held.
std::string read(Chunks& chunks, std::uint64_t& last) {
  const auto held = chunks.latest(kReader);
  if (!held) {
    return {};
  }
  const Content& content = memory().contents[held->chunk];
  const int first = content.first.load(std::memory_order_relaxed);
  const int second = content.second.load(std::memory_order_relaxed);
  chunks.release(kReader, held->chunk);
  const bool is_older = held->number < std::exchange(last, held->number);
  return first != second ? "torn" : is_older ? std::string("older") : "";
}

// A writer fills each chunk again while a reader holds one.
Outcome read_while_writing(int writes, int reads, const Weakening& without = {}) {
  static std::string wrong;
  return explore(
      [=] {
        bytes.fill(std::byte{0});
        wrong.clear();
        Chunks chunks(memory().header, kMinChunks);
        write(chunks, 1);
        return Program{{[=]() mutable {
                          for (int value = 2; value < 2 + writes; ++value) {
                            write(chunks, value);
                          }
                        },
                        [=]() mutable {
                          std::uint64_t last = 0;
                          for (int i = 0; i < reads; ++i) {
                            wrong += read(chunks, last);
                          }
                        }},
                       [] { return wrong; }};
      },
      without);
}

TEST(WeakPool, A_chunk_that_is_held_is_whole_and_stays) {
  const Outcome outcome = read_while_writing(3, 1);
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST(WeakPool, Each_order_is_needed) {
  EXPECT_NE(read_while_writing(2, 1, {.no_sequential_accesses = true}).wrong, "") << "in hold() and take()";
  EXPECT_NE(read_while_writing(2, 1, {.no_acquire_loads = true}).wrong, "");
  EXPECT_NE(read_while_writing(2, 1, {.no_release_stores = true}).wrong, "");
}

}  // namespace
}  // namespace indurop::pools
