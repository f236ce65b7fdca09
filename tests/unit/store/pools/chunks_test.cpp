// SPDX-License-Identifier: Apache-2.0
// The chunks of a pool against a model that knows no atomics, and under threads.

#include "store/pools/chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include "pool_memory.h"

namespace indurop::pools {
namespace {

using test::SharedPool;

constexpr rt::MonoTime kNow = rt::mono_time(1000);

std::uint64_t publish_one(SharedPool& pool, std::uint32_t seat, std::uint64_t value) {
  const auto chunk = pool->take(seat);
  if (!chunk) {
    return 0;
  }
  pool.content(*chunk).fill(value);
  return pool->publish(seat, *chunk, kNow);
}

TEST(Chunks, Nothing_is_read_before_something_was_published) {
  SharedPool sut(4);
  EXPECT_FALSE(sut->latest(0));
  EXPECT_FALSE(sut->next(0));
  EXPECT_EQ(sut->free(), 4U);
}

TEST(Chunks, A_published_chunk_is_read_where_it_was_written) {
  SharedPool sut(4);
  EXPECT_EQ(publish_one(sut, 0, 7), 1U);
  const auto read = sut->latest(1);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->number, 1U);
  EXPECT_EQ(sut.content(read->chunk).value(), 7U);
  EXPECT_EQ(sut->time_of(read->chunk), kNow);
}

TEST(Chunks, The_newest_one_and_those_in_a_hand_are_not_filled_again) {
  SharedPool sut(3);
  publish_one(sut, 0, 1);
  const auto old = sut->latest(1);
  publish_one(sut, 0, 2);
  publish_one(sut, 0, 3);
  ASSERT_TRUE(old);
  EXPECT_EQ(sut.content(old->chunk).value(), 1U);
  const auto newest = sut->latest(2);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->number, 3U);
  const auto filling = sut->take(0);
  ASSERT_TRUE(filling);
  EXPECT_FALSE(sut->take(0)) << "one is held, one is newest, one is being filled";
  EXPECT_EQ(sut.header().without_a_chunk.load(), 1U);
  EXPECT_EQ(sut.header().seats[0].without_a_chunk.load(), 1U);
  sut->discard(0, *filling);
  EXPECT_TRUE(sut->take(0));
}

TEST(Chunks, A_reader_of_each_chunk_gets_them_in_order_and_knows_what_it_missed) {
  SharedPool sut(4);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    publish_one(sut, 0, i);
  }
  auto read = sut->next(1);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->number, 3U) << "it begins with the latest";
  sut->release(1, read->chunk);
  EXPECT_FALSE(sut->next(1));
  for (std::uint64_t i = 4; i <= 10; ++i) {
    publish_one(sut, 0, i);
  }
  std::vector<std::uint64_t> numbers;
  while ((read = sut->next(1))) {
    numbers.push_back(read->number);
    sut->release(1, read->chunk);
  }
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{7, 8, 9, 10}));
  EXPECT_EQ(sut.header().seats[1].missed.load(), 3U);
  EXPECT_EQ(sut.header().missed.load(), 3U);
}

TEST(Chunks, A_chunk_that_was_taken_away_is_not_published) {
  SharedPool sut(2);
  const auto chunk = sut->take(5);
  ASSERT_TRUE(chunk);
  EXPECT_EQ(sut->release_all(5), 1U);
  EXPECT_EQ(sut->publish(5, *chunk, kNow), 0U);
  EXPECT_EQ(sut->release_all(5), 0U);
  EXPECT_FALSE(sut->latest(0));
}

// ---- against a model

struct Model {
  struct Chunk {
    std::uint64_t number = 0;  // 0: free
    int filled_by = -1;
    std::map<std::uint32_t, int> held_by;
    std::uint64_t value = 0;
  };
  std::vector<Chunk> chunks;
  std::array<std::uint64_t, kSeats> seen{};
  std::array<std::uint64_t, kSeats> missed{};
  std::uint64_t numbers = 0;

  [[nodiscard]] std::uint64_t newest() const {
    std::uint64_t newest = 0;
    for (const Chunk& chunk : chunks) {
      newest = std::max(newest, chunk.number);
    }
    return newest;
  }
  // The lowest number that may be taken; 0 stands for a free chunk, nothing for none.
  [[nodiscard]] std::optional<std::uint64_t> to_take() const {
    std::optional<std::uint64_t> lowest;
    for (const Chunk& chunk : chunks) {
      const bool is_newest = chunk.number != 0 && chunk.number == newest();
      if (chunk.filled_by < 0 && chunk.held_by.empty() && !is_newest) {
        lowest = std::min(lowest.value_or(UINT64_MAX), chunk.number);
      }
    }
    return lowest;
  }
  [[nodiscard]] std::uint64_t next(std::uint32_t seat) const {
    std::uint64_t lowest = UINT64_MAX;
    for (const Chunk& chunk : chunks) {
      lowest = chunk.number > seen[seat] ? std::min(lowest, chunk.number) : lowest;
    }
    return seen[seat] == 0 ? newest() : lowest == UINT64_MAX ? 0 : lowest;
  }
};

class RandomSteps {
 public:
  RandomSteps(std::uint32_t chunks, unsigned seed) : sut_(chunks), random_(seed) { model_.chunks.resize(chunks); }

  void step() {
    const std::uint32_t seat = pick(kUsers);
    switch (pick(8)) {
      case 0:
      case 1:
        return take(seat);
      case 2:
      case 3:
        return end_filling(seat);
      case 4:
        return latest(seat);
      case 5:
        return next(seat);
      case 6:
        return release(seat);
      default:
        return pick(6) == 0 ? die(seat) : release(seat);
    }
  }

 private:
  static constexpr std::uint32_t kUsers = 4;
  std::uint32_t pick(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }

  void take(std::uint32_t seat) {
    const auto lowest = model_.to_take();
    const auto chunk = sut_->take(seat);
    ASSERT_EQ(chunk.has_value(), lowest.has_value());
    if (chunk) {
      ASSERT_EQ(model_.chunks[*chunk].number, *lowest);
      ASSERT_TRUE(model_.chunks[*chunk].held_by.empty());
      ASSERT_LT(model_.chunks[*chunk].filled_by, 0);
      model_.chunks[*chunk].number = 0;
      model_.chunks[*chunk].filled_by = static_cast<int>(seat);
    }
  }
  void end_filling(std::uint32_t seat) {
    for (std::uint32_t i = 0; i < model_.chunks.size(); ++i) {
      Model::Chunk& chunk = model_.chunks[i];
      if (chunk.filled_by != static_cast<int>(seat)) {
        continue;
      }
      chunk.filled_by = -1;
      if (pick(4) == 0) {
        return sut_->discard(seat, i);
      }
      chunk.value = random_() | 1U;
      sut_.content(i).fill(chunk.value);
      chunk.number = ++model_.numbers;
      ASSERT_EQ(sut_->publish(seat, i, kNow), chunk.number);
      return;
    }
  }
  void expect_read(std::uint32_t seat, std::uint64_t number, const std::optional<Held>& read) {
    ASSERT_EQ(read ? read->number : 0, number);
    if (read) {
      Model::Chunk& chunk = model_.chunks[read->chunk];
      ASSERT_EQ(chunk.number, number);
      ASSERT_EQ(sut_.content(read->chunk).value(), chunk.value);
      ++chunk.held_by[seat];
    }
  }
  void latest(std::uint32_t seat) {
    const std::uint64_t number = model_.newest();
    expect_read(seat, number, sut_->latest(seat));
    model_.seen[seat] = std::max(model_.seen[seat], number);
  }
  void next(std::uint32_t seat) {
    const std::uint64_t number = model_.next(seat);
    expect_read(seat, number, sut_->next(seat));
    if (number != 0) {
      model_.missed[seat] += model_.seen[seat] == 0 ? 0 : number - model_.seen[seat] - 1;
      model_.seen[seat] = number;
    }
    ASSERT_EQ(sut_.header().seats[seat].missed.load(), model_.missed[seat]);
  }
  void release(std::uint32_t seat) {
    const auto first = static_cast<std::size_t>(pick(static_cast<std::uint32_t>(model_.chunks.size())));
    for (std::size_t i = 0; i < model_.chunks.size(); ++i) {
      const std::size_t at = (first + i) % model_.chunks.size();
      auto& holders = model_.chunks[at].held_by;
      if (const auto held = holders.find(seat); held != holders.end()) {
        sut_->release(seat, static_cast<std::uint32_t>(at));
        if (--held->second == 0) {
          holders.erase(held);
        }
        return;
      }
    }
  }
  void die(std::uint32_t seat) {
    std::uint32_t in_hand = 0;
    for (Model::Chunk& chunk : model_.chunks) {
      const bool filled = chunk.filled_by == static_cast<int>(seat);
      in_hand += chunk.held_by.erase(seat) != 0 || filled ? 1U : 0U;
      chunk.filled_by = filled ? -1 : chunk.filled_by;
    }
    ASSERT_EQ(sut_->release_all(seat), in_hand);
  }

  SharedPool sut_;
  Model model_;
  std::mt19937 random_;
};

class ChunksOfSize : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Sizes, ChunksOfSize, testing::Values(2U, 3U, 4U, 7U, 64U));

TEST_P(ChunksOfSize, Random_steps_do_what_the_model_does) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomSteps steps(GetParam(), seed);
    for (int i = 0; i < 2000; ++i) {
      ASSERT_NO_FATAL_FAILURE(steps.step()) << "seed " << seed << ", step " << i;
    }
  }
}

// ---- with threads

struct Watched {
  std::atomic<bool> end{false};
  std::atomic<std::uint64_t> torn{0};
  std::atomic<std::uint64_t> backwards{0};
  std::atomic<std::uint64_t> read{0};
};

void read_each(SharedPool& pool, std::uint32_t seat, bool only_latest, Watched& watched) {
  std::uint64_t last = 0;
  while (!watched.end.load()) {
    const auto held = only_latest ? pool->latest(seat) : pool->next(seat);
    if (!held) {
      continue;
    }
    const std::uint64_t value = pool.content(held->chunk).value();
    watched.torn += value == 0 || pool.content(held->chunk).value() != value ? 1U : 0U;
    watched.backwards += held->number < last || (!only_latest && held->number == last) ? 1U : 0U;
    last = held->number;
    ++watched.read;
    pool->release(seat, held->chunk);
  }
}

TEST(Chunks, Threads_never_see_a_chunk_change_in_their_hand) {
  constexpr std::uint64_t kPublished = 20'000;
  SharedPool sut(6);
  Watched watched;
  std::vector<std::thread> readers;
  for (std::uint32_t seat = 2; seat < 5; ++seat) {
    readers.emplace_back([&, seat] { read_each(sut, seat, seat == 2, watched); });
  }
  std::vector<std::thread> writers;
  for (std::uint32_t seat = 0; seat < 2; ++seat) {
    writers.emplace_back([&, seat] {
      for (std::uint64_t i = 1; sut.header().numbers.load() < kPublished; ++i) {
        publish_one(sut, seat, i << 8U | seat);
      }
    });
  }
  for (std::thread& writer : writers) {
    writer.join();
  }
  while (watched.read.load() == 0) {
    std::this_thread::yield();
  }
  watched.end.store(true);
  for (std::thread& reader : readers) {
    reader.join();
  }
  EXPECT_EQ(watched.torn.load(), 0U);
  EXPECT_EQ(watched.backwards.load(), 0U);
  test::expect_at_rest(sut.memory(), 6);
}

}  // namespace
}  // namespace indurop::pools
