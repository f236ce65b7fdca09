// SPDX-License-Identifier: Apache-2.0
// Writers and readers of a pool are killed at random instants, thousands of times: the pool goes on, and nothing is
// lost but what was in their hands.

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "pool_node.h"
#include "tests/support/forked.h"

namespace indurop::pools {
namespace {

using indurop::test::Forked;
using test::Content;
using test::kShape;
using test::PoolNode;

constexpr int kTorn = 3;
constexpr int kNoSeat = 4;

Content& content(const Pool& pool, std::uint32_t chunk) {
  return *reinterpret_cast<Content*>(pool.data(chunk));
}

// A process of its own, from opening the pool on. Ends only if something is wrong.
int use_always(const std::string& node, bool writes, std::uint64_t seed) {
  (void)::nice(19);  // the one that kills it runs when it wants to
  auto pool = Pool::open(node, kShape.name, kShape.type_hash, vars::Mode::ReadWrite);
  auto seat = pool ? pool->take_seat("user") : Error{};
  while (!seat && seat.error().code == Errc::Busy) {
    seat = pool->take_seat("user");
  }
  if (!seat) {
    return kNoSeat;
  }
  Chunks chunks = pool->chunks();
  for (std::uint64_t i = seed << 32U | 1U;; ++i) {
    if (writes) {
      if (const auto chunk = chunks.take(*seat)) {
        content(*pool, *chunk).fill(i);
        chunks.publish(*seat, *chunk, rt::MonoClock::now());
      }
    } else if (const auto held = i % 2 == 0 ? chunks.latest(*seat) : chunks.next(*seat)) {
      const std::uint64_t value = content(*pool, held->chunk).value();
      if (value == 0 || content(*pool, held->chunk).value() != value) {
        return kTorn;
      }
      chunks.release(*seat, held->chunk);
    }
  }
}

void expect_at_rest(const Pool& pool) {
  const Usage usage = pool.usage();
  ASSERT_TRUE(usage.users.empty());
  ASSERT_EQ(usage.free, usage.numbers == 0 ? kShape.chunks : kShape.chunks - 1);
  Chunks chunks = pool.chunks();
  if (const auto newest = chunks.latest(0)) {
    ASSERT_NE(content(pool, newest->chunk).value(), 0U);
    chunks.release(0, newest->chunk);
  }
}

TEST(KilledUsers, Leave_a_pool_that_goes_on) {
  constexpr int kRounds = 250;
  constexpr std::size_t kUsers = 4;
  const PoolNode node("killed");
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  std::mt19937_64 random(1);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::unique_ptr<Forked>> users;
    for (std::size_t i = 0; i < kUsers; ++i) {
      const std::uint64_t seed = random() >> 33U;
      users.push_back(std::make_unique<Forked>([&, i, seed] { return use_always(node.name(), i < 2, seed); }));
    }
    for (const auto& user : users) {
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 300));  // when it dies
      user->signal(SIGKILL);
      ASSERT_EQ(user->wait(), 128 + SIGKILL) << "round " << round << ": it had ended before";
      (void)sut->sweep();
    }
    ASSERT_NO_FATAL_FAILURE(expect_at_rest(*sut)) << "round " << round;
  }
  EXPECT_GT(sut->usage().numbers, 0U);
  RecordProperty("published", std::to_string(sut->usage().numbers));
  RecordProperty("recovered", std::to_string(sut->usage().recovered));
}

// A node that is killed while it makes or adopts the pool, with users that live.
TEST(KilledUsers, Go_on_while_the_node_is_killed_and_started_again) {
  const PoolNode node("node");
  { ASSERT_TRUE(Pool::create(node.name(), kShape).ok()); }
  Forked writer([&] { return use_always(node.name(), true, 1); });
  Forked reader([&] { return use_always(node.name(), false, 2); });
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    Forked killed([&] {
      while (Pool::create(node.name(), kShape).ok()) {
      }
      return 1;
    });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 1000));  // when it dies
    killed.signal(SIGKILL);
    ASSERT_EQ(killed.wait(), 128 + SIGKILL) << "round " << round;
  }
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  const std::uint64_t before = sut->usage().numbers;
  while (sut->usage().numbers == before) {
    std::this_thread::yield();
  }
  EXPECT_EQ(sut->usage().users.size(), 2U);
  for (Forked* user : {&writer, &reader}) {
    user->signal(SIGKILL);
    EXPECT_EQ(user->wait(), 128 + SIGKILL) << "it had ended before";
  }
  (void)sut->sweep();
  expect_at_rest(*sut);
}

}  // namespace
}  // namespace indurop::pools
