// SPDX-License-Identifier: Apache-2.0
// The inlined read of the generated headers, of each size as often as INDUROP_READS says (default 200,000), against
// writers that preempt it and writers that are killed in the middle of a write.

#include <gtest/gtest.h>

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <array>

#include "core/rt/thread.h"
#include "fault.h"
#include "store/vars/store.h"
#include "store/vars/tear_free_ring.h"

// What libindurop provides to modules.
extern "C" void indurop_read_slow(const indurop::abi::RingHeader* ring, void* to, std::uint32_t offset,
                                  std::uint32_t length) noexcept {
  indurop::vars::read_slow(*const_cast<indurop::abi::RingHeader*>(ring), to, offset, length);
}

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::hash;
using test::TestNode;
using test::variable;

template <std::size_t Words>
using Value = std::array<std::uint64_t, Words>;
constexpr std::size_t kSmall = 3;   // 24 bytes
constexpr std::size_t kLarge = 32;  // 256 bytes
constexpr std::uint64_t kAtOnce = 10'000;

struct Score {
  std::atomic<bool> stop;
  std::atomic<std::uint64_t> reads;  // of each size
  std::atomic<std::uint64_t> torn;
  std::atomic<std::uint64_t> backwards;
  std::atomic<std::uint64_t> changes;  // times a read saw another value than the one before
  std::atomic<std::uint64_t> commits;
};

schema::Schema both() {
  schema::Schema schema;
  schema.variables.push_back(variable("small", array_type(schema::Base::UInt64, kSmall)));
  schema.variables.push_back(variable("large", array_type(schema::Base::UInt64, kLarge)));
  return schema;
}

abi::RingHeader& ring_of(Store& store, const char* name) {
  return *static_cast<abi::RingHeader*>(store.entry(hash(name), 0));
}

template <std::size_t Words>
void bump(abi::RingHeader& ring) {
  auto* const to = static_cast<std::uint64_t*>(begin_write(ring, 0, Words * 8));
  if (to == nullptr) {
    return;
  }
  const auto* const now = reinterpret_cast<const std::uint64_t*>(
      detail::slot(&ring, ring.seq.load(std::memory_order_relaxed), ring.slot_stride));
  const std::uint64_t next = __atomic_load_n(now, __ATOMIC_RELAXED) + 1;
  for (std::size_t i = 0; i < Words; ++i) {
    __atomic_store_n(to + i, next, __ATOMIC_RELAXED);
  }
  commit(ring);
}

void write_until_stopped(Store& store, Score& score, int fifo_priority) {
  (void)rt::set_fifo(fifo_priority);  // refused for an ordinary user: then the writers preempt less
  while (!score.stop) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) {
      bump<kSmall>(ring_of(store, "small"));
      bump<kLarge>(ring_of(store, "large"));
    }
    score.commits.fetch_add(100, std::memory_order_relaxed);
    // A real-time thread must let others run, however slow a sanitizer makes it.
    const std::chrono::nanoseconds worked = std::chrono::steady_clock::now() - begin;
    std::this_thread::sleep_for(std::max<std::chrono::nanoseconds>(worked, std::chrono::microseconds(20)));
  }
}

// On the core of the reader, so that a write comes between any two of its instructions.
void write_while_read(Store& store, Score& score) {
  (void)rt::pin_to_core(rt::allowed_cores().front());
  write_until_stopped(store, score, 10);
}

template <std::size_t Words>
void read_many(abi::RingHeader& ring, Score& score, std::uint64_t& last) {
  std::uint64_t torn = 0;
  std::uint64_t backwards = 0;
  std::uint64_t changes = 0;
  for (std::uint64_t n = 0; n < kAtOnce; ++n) {
    const auto value = detail::ring_read<Value<Words>, Words * 8>(&ring, 0);
    std::uint64_t different = 0;
    for (std::size_t i = 1; i < Words; ++i) {
      different |= value[i] ^ value[0];
    }
    torn += different != 0 ? 1U : 0U;
    backwards += value[0] < last ? 1U : 0U;
    changes += value[0] != last ? 1U : 0U;
    last = value[0];
  }
  score.torn.fetch_add(torn, std::memory_order_relaxed);
  score.backwards.fetch_add(backwards, std::memory_order_relaxed);
  score.changes.fetch_add(changes, std::memory_order_relaxed);
}

// Goes on until some of the values were new: a quick reader could be done before the first writer comes.
void read_until(Store& store, Score& score, std::uint64_t wanted) {
  constexpr std::uint64_t kNew = 100;
  (void)rt::pin_to_core(rt::allowed_cores().front());
  std::uint64_t small = 0;
  std::uint64_t large = 0;
  while (score.reads.load(std::memory_order_relaxed) < wanted || score.changes.load(std::memory_order_relaxed) < kNew) {
    read_many<kSmall>(ring_of(store, "small"), score, small);
    read_many<kLarge>(ring_of(store, "large"), score, large);
    score.reads.fetch_add(kAtOnce, std::memory_order_relaxed);
  }
  score.stop = true;
}

// A process that attaches to the store and does something with it.
template <class Work>
int attached(const TestNode& node, const Work& work) {
  auto store = Store::attach(node.name(), Mode::ReadWrite);
  if (!store.ok()) {
    return 1;
  }
  work(*store);
  return 0;
}

// Lets writers come and be killed until the reader has read enough.
int kill_writers(const TestNode& node, Score& score) {
  std::mt19937 random(11);
  int kills = 0;
  for (; !score.stop; ++kills) {
    Forked writer([&] { return attached(node, [&](Store& store) { write_until_stopped(store, score, 11); }); });
    test::wait_a_random_moment(random, 4000);
    writer.kill_and_wait();
  }
  return kills;
}

std::uint64_t wanted_reads() {
  const char* const text = std::getenv("INDUROP_READS");
  return text == nullptr ? 200'000 : std::strtoull(text, nullptr, 10);
}

void expect_whole_values(const Score& score, int kills) {
  EXPECT_GE(score.reads, wanted_reads());
  EXPECT_EQ(score.torn, 0U);
  EXPECT_EQ(score.backwards, 0U);
  std::printf("%llu reads of 24 bytes and as many of 256, %llu saw a new value, %llu commits, %d writers killed\n",
              static_cast<unsigned long long>(score.reads), static_cast<unsigned long long>(score.changes),
              static_cast<unsigned long long>(score.commits), kills);
}

TEST(ManyReads, Of_what_other_processes_write_are_never_torn_or_older) {
  const TestNode node("many-reads");
  const test::Shared<Score> score;
  auto store = Store::create(node.name(), both());
  ASSERT_TRUE(store.ok());
  Forked steady([&] { return attached(node, [&](Store& mine) { write_while_read(mine, *score); }); });
  Forked reader([&] { return attached(node, [&](Store& mine) { read_until(mine, *score, wanted_reads()); }); });
  const int kills = kill_writers(node, *score);
  EXPECT_EQ(reader.wait(), 0);
  EXPECT_EQ(steady.wait(), 0);
  expect_whole_values(*score, kills);
}

TEST(ManyReads, Of_what_a_thread_of_the_same_process_writes_are_never_torn_or_older) {
  const TestNode node("many-reads");
  const test::Shared<Score> score;
  auto store = Store::create(node.name(), both());
  ASSERT_TRUE(store.ok());
  Forked process([&] {
    return attached(node, [&](Store& mine) {
      std::thread steady([&] { write_while_read(mine, *score); });
      read_until(mine, *score, wanted_reads());
      steady.join();
    });
  });
  const int kills = kill_writers(node, *score);
  EXPECT_EQ(process.wait(), 0);
  expect_whole_values(*score, kills);
}

}  // namespace
}  // namespace indurop::vars
