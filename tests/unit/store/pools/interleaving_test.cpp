// SPDX-License-Identifier: Apache-2.0
// Writers, readers and those who free what dead ones held, in random turns: after each access to shared memory another
// one may go on, or the one before may be dead. The algorithm is compiled again, with atomics that allow it.

#include "stepped_atomic.h"
// The atomics come first.
#include "store/pools/chunks.cpp"  // NOLINT(bugprone-suspicious-include)

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>

namespace indurop::pools {
namespace {

constexpr std::uint32_t kWriters = 2;
constexpr std::uint32_t kUsers = 5;
constexpr std::size_t kStack = std::size_t{64} << 10U;

class Turns {
 public:
  Turns(std::uint32_t chunks, unsigned seed) : chunks_(memory_->header, chunks), random_(seed) {
    for (std::uint32_t seat = 0; seat < kUsers; ++seat) {
      begin(seat);
    }
  }

  // One of them goes on, for one access or for several.
  void turn() {
    const auto seat = static_cast<std::uint32_t>(random_() % kUsers);
    const auto longest = std::array{1U, 20U, 800U}[random_() % 3];
    for (auto left = random_() % longest + 1; left > 0 && !users_[seat]->ended(); --left) {
      users_[seat]->resume();
    }
    if (users_[seat]->ended() || random_() % 200 == 0) {
      bury(seat);
    }
  }

  void end() {
    for (std::uint32_t seat = 0; seat < kUsers; ++seat) {
      users_[seat].reset();
      (void)chunks_.release_all(seat);
    }
    EXPECT_EQ(chunks_.free(), chunks_.count() - 1);
    EXPECT_GT(read_, 10U);
  }
  [[nodiscard]] const std::string& wrong() const noexcept { return wrong_; }

 private:
  // All words of a chunk that is whole are equal.
  using Content = std::array<Atomic<std::uint64_t>, 4>;
  struct Memory {
    PoolHeader header{};
    std::array<Content, kMaxChunks> content{};
  };

  // Its user is dead and another one frees what it held, while the rest goes on; then the seat has a new user.
  void bury(std::uint32_t seat) {
    users_[seat] = std::make_unique<rt::Fiber>(kStack, [this, seat] {
      (void)chunks_.release_all(seat);
      memory_->header.seats[seat].seen.store(0);
      use(seat);
    });
  }
  void begin(std::uint32_t seat) {
    users_[seat] = std::make_unique<rt::Fiber>(kStack, [this, seat] { use(seat); });
  }

  void use(std::uint32_t seat) {
    if (seat < kWriters) {
      write(seat);
    }
    read(seat, seat == kWriters);
  }

  void write(std::uint32_t seat) {
    while (true) {
      const std::uint64_t value = ++values_;
      if (const auto chunk = chunks_.take(seat)) {
        for (auto& word : memory_->content[*chunk]) {
          word.store(value);
        }
        if (value % 5 == 0) {
          chunks_.discard(seat, *chunk);
        } else if (chunks_.publish(seat, *chunk, rt::mono_time(1)) == 0) {
          wrong_ = "a living writer's chunk was taken away";
        }
      }
    }
  }

  void read(std::uint32_t seat, bool only_latest) {
    std::uint64_t last = 0;
    while (true) {
      const Seat& self = memory_->header.seats[seat];
      const std::uint64_t missed = self.missed.load();
      const auto held = only_latest ? chunks_.latest(seat) : chunks_.next(seat);
      if (!held) {
        continue;
      }
      for (int twice = 0; twice < 2; ++twice) {
        expect_whole(held->chunk);
      }
      if (held->number < last) {
        wrong_ = "a reader went back in time";
      }
      if (!only_latest && last != 0 && held->number != last + 1 + self.missed.load() - missed) {
        wrong_ = "a chunk was neither read nor counted as missed";
      }
      last = held->number;
      ++read_;
      chunks_.release(seat, held->chunk);
    }
  }

  void expect_whole(std::uint32_t chunk) {
    const std::uint64_t first = memory_->content[chunk][0].load();
    for (const auto& word : memory_->content[chunk]) {
      if (word.load() != first || first == 0) {
        wrong_ = "a chunk changed in a reader's hand";
      }
    }
  }

  std::unique_ptr<Memory> memory_ = std::make_unique<Memory>();
  Chunks chunks_;
  std::mt19937 random_;
  std::uint64_t values_ = 0;
  std::uint64_t read_ = 0;
  std::string wrong_;
  std::array<std::unique_ptr<rt::Fiber>, kUsers> users_;
};

class TurnsOfChunks : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Sizes, TurnsOfChunks, testing::Values(2U, 3U, 4U, 6U));

TEST_P(TurnsOfChunks, Never_show_a_reader_a_chunk_that_changes) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Turns turns(GetParam(), seed);
    for (int i = 0; i < 5000; ++i) {
      turns.turn();
      ASSERT_EQ(turns.wrong(), "") << "seed " << seed << ", turn " << i;
    }
    turns.end();
  }
}

}  // namespace
}  // namespace indurop::pools
