// SPDX-License-Identifier: Apache-2.0
// Writers are killed at random instants while others read: no reader ever sees half a value or an older one again.

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <vector>

#include "fault.h"
#include "store/vars/store.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::hash;
using test::TestNode;
using test::variable;

constexpr std::uint32_t kSmall = 32;     // words of 8 bytes: 256 bytes, always copied whole
constexpr std::uint32_t kLarge = 2048;   // 16 KiB: copied where versions differ
constexpr const char* kWhole = "whole";  // small, every commit sets all words to one number
constexpr const char* kPairs = "pairs";  // large, every commit adds one to both words of one pair
constexpr const char* kTotal = "total";  // large, an edit adds one to some word and to word 0

schema::Schema fault_schema() {
  schema::Schema schema;
  schema.variables.push_back(variable(kWhole, array_type(schema::Base::UInt64, kSmall)));
  schema.variables.push_back(variable(kPairs, array_type(schema::Base::UInt64, kLarge)));
  schema.variables.push_back(variable(kTotal, array_type(schema::Base::UInt64, kLarge)));
  return schema;
}

struct WriterScore {
  std::atomic<bool> stop;
  std::atomic<std::uint64_t> commits;
  std::atomic<std::uint64_t> refused;
  std::atomic<std::uint64_t> reads;
  std::atomic<std::uint64_t> timeouts;
  std::atomic<std::uint64_t> torn;
  std::atomic<std::uint64_t> backwards;
};

using Words = std::vector<std::uint64_t>;

class Writer {
 public:
  explicit Writer(Store& store) : store_(store) {}

  bool write_whole() {
    abi::RingHeader& ring = this->ring(kWhole);
    auto* to = static_cast<std::uint64_t*>(begin_write(ring, 0, kSmall * 8));
    if (to == nullptr) {
      return false;
    }
    const std::uint64_t next = current(ring)[0] + 1;
    for (std::uint32_t i = 0; i < kSmall; ++i) {
      put(to + i, next);
    }
    commit(ring);
    return true;
  }

  bool write_pair(std::uint32_t pair) {
    abi::RingHeader& ring = this->ring(kPairs);
    auto* to = static_cast<std::uint64_t*>(begin_write(ring, pair * 16, 16));
    if (to == nullptr) {
      return false;
    }
    const std::uint64_t next = current(ring)[std::size_t{pair} * 2] + 1;
    put(to + std::size_t{pair} * 2, next);
    put(to + std::size_t{pair} * 2 + 1, next);
    commit(ring);
    return true;
  }

  bool edit_total(std::uint32_t word) {
    abi::RingHeader& ring = this->ring(kTotal);
    auto* to = static_cast<std::uint64_t*>(begin_edit(ring));
    if (to == nullptr) {
      return false;
    }
    put(to + word, get(to + word) + 1);
    put(to, get(to) + 1);
    commit(ring);
    return true;
  }

 private:
  abi::RingHeader& ring(const char* name) { return *static_cast<abi::RingHeader*>(store_.entry(hash(name), 0)); }
  static const std::uint64_t* current(abi::RingHeader& ring) {
    return reinterpret_cast<const std::uint64_t*>(reinterpret_cast<unsigned char*>(&ring) + sizeof(abi::RingHeader) +
                                                  ring.seq.load() % abi::kSlots * ring.slot_stride);
  }
  // NOLINTNEXTLINE(readability-non-const-parameter): it writes there
  static void put(std::uint64_t* to, std::uint64_t value) { __atomic_store_n(to, value, __ATOMIC_RELAXED); }
  static std::uint64_t get(const std::uint64_t* from) { return __atomic_load_n(from, __ATOMIC_RELAXED); }
  Store& store_;
};

int run_writer(const TestNode& node, WriterScore& score, unsigned seed) {
  auto store = Store::attach(node.name(), Mode::ReadWrite);
  if (!store.ok()) {
    return 1;
  }
  Writer writer(*store);
  std::mt19937 random(seed);
  while (!score.stop) {
    const bool done = writer.write_whole() && writer.write_pair(static_cast<std::uint32_t>(random() % (kLarge / 2))) &&
                      writer.edit_total(1 + static_cast<std::uint32_t>(random() % (kLarge - 1)));
    (done ? score.commits : score.refused).fetch_add(1);
  }
  return 0;
}

class Reader {
 public:
  Reader(const Store& store, WriterScore& score) : store_(store), score_(score), last_(3, Words(kLarge)) {}

  void look() {
    if (read(kWhole, kSmall)) {
      std::uint64_t different = 0;
      for (std::uint32_t i = 1; i < kSmall; ++i) {
        different += words_[i] != words_[0] ? 1U : 0U;
      }
      judge(different != 0, last_[0], kSmall);
    }
    if (read(kPairs, kLarge)) {
      bool torn = false;
      for (std::uint32_t i = 0; i < kLarge; i += 2) {
        torn = torn || words_[i] != words_[i + 1];
      }
      judge(torn, last_[1], kLarge);
    }
    if (read(kTotal, kLarge)) {
      std::uint64_t sum = 0;
      for (std::uint32_t i = 1; i < kLarge; ++i) {
        sum += words_[i];
      }
      judge(sum != words_[0], last_[2], kLarge);
    }
  }

 private:
  bool read(const char* name, std::uint32_t count) {
    words_.resize(count);
    const Status status =
        store_.read(*store_.find(hash(name)), 0, {reinterpret_cast<std::uint8_t*>(words_.data()), count * 8U});
    (status.ok() ? score_.reads : score_.timeouts).fetch_add(1);
    return status.ok();
  }
  void judge(bool torn, Words& last, std::uint32_t count) {
    bool backwards = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      backwards = backwards || words_[i] < last[i];
      last[i] = words_[i];
    }
    score_.torn.fetch_add(torn ? 1 : 0);
    score_.backwards.fetch_add(backwards ? 1 : 0);
  }
  const Store& store_;
  WriterScore& score_;
  Words words_;
  std::vector<Words> last_;
};

int run_reader(const TestNode& node, WriterScore& score, Mode mode) {
  const auto store = Store::attach(node.name(), mode);
  if (!store.ok()) {
    return 1;
  }
  Reader reader(*store, score);
  while (!score.stop) {
    reader.look();
  }
  reader.look();
  return 0;
}

TEST(KilledWriters, Never_leave_a_torn_or_older_value) {
  const TestNode node("killed-writers");
  const test::Shared<WriterScore> score;
  auto store = Store::create(node.name(), fault_schema());
  ASSERT_TRUE(store.ok());
  Forked reader([&] { return run_reader(node, *score, Mode::ReadOnly); });
  Forked steady([&] { return run_writer(node, *score, 1); });
  std::mt19937 random(7);
  int kills = 0;
  for (const test::Duration duration; !duration.over(); ++kills) {
    Forked writer([&] { return run_writer(node, *score, static_cast<unsigned>(random())); });
    test::wait_a_random_moment(random, 4000);
    writer.kill_and_wait();
  }
  score->stop = true;
  EXPECT_EQ(reader.wait(), 0);
  EXPECT_EQ(steady.wait(), 0);
  EXPECT_EQ(score->torn, 0U);
  EXPECT_EQ(score->backwards, 0U);
  EXPECT_GT(score->reads, 0U);
  EXPECT_GT(score->commits, 0U);
  Reader last(*store, *score);
  last.look();
  EXPECT_EQ(score->torn, 0U);
  for (const char* name : {kWhole, kPairs, kTotal}) {
    EXPECT_TRUE(
        check_ring(*static_cast<abi::RingHeader*>(store->entry(hash(name), 0)), store->find(hash(name))->value_size));
  }
  std::printf("%d kills, %llu commits, %llu refused, %llu reads, %llu time-outs\n", kills,
              static_cast<unsigned long long>(score->commits), static_cast<unsigned long long>(score->refused),
              static_cast<unsigned long long>(score->reads), static_cast<unsigned long long>(score->timeouts));
}

TEST(KilledWriters, Killed_readers_disturb_no_writer_and_no_reader) {
  const TestNode node("killed-readers");
  const test::Shared<WriterScore> score;
  auto store = Store::create(node.name(), fault_schema());
  ASSERT_TRUE(store.ok());
  Forked writer([&] { return run_writer(node, *score, 1); });
  std::mt19937 random(8);
  for (const test::Duration duration; !duration.over();) {
    Forked reader([&] { return run_reader(node, *score, random() % 2 == 0 ? Mode::ReadOnly : Mode::ReadWrite); });
    test::wait_a_random_moment(random, 4000);
    reader.kill_and_wait();
  }
  score->stop = true;
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_EQ(score->torn, 0U);
  EXPECT_EQ(score->refused, 0U);
  EXPECT_GT(score->commits, 0U);
}

}  // namespace
}  // namespace indurop::vars
