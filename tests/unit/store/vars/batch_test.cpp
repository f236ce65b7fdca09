// SPDX-License-Identifier: Apache-2.0
// Several values changed in one tick: all or none, with any other writer.

#include "store/vars/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <thread>

#include "core/rt/clock.h"
#include "store/vars/tear_free_ring.h"
#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

constexpr std::chrono::seconds kPatience{30};
constexpr std::uint32_t kLargeEnd = 4 * 3999;

schema::Schema parameters() {
  schema::Schema schema;
  schema.variables.push_back(variable("p::gain", scalar_type(schema::Base::Int32)));
  schema.variables.push_back(variable("p::words", array_type(schema::Base::Int32, 4)));
  schema.variables.push_back(variable("p::large", array_type(schema::Base::Int32, 4000)));
  return schema;
}

class BatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(store_.ok());
    ASSERT_TRUE(sut_.ok());
  }
  void TearDown() override { static_cast<void>(remove_shm_file(batch_file(node_.name()))); }

  [[nodiscard]] const DirectoryEntry& entry(const std::string& name) const { return *store_->find(hash(name)); }
  [[nodiscard]] std::int32_t get(const std::string& name, std::uint32_t offset = 0) const {
    std::array<std::uint8_t, 4> bytes{};
    EXPECT_TRUE(store_->read(entry(name), offset, bytes).ok());
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  // All places the same number.
  Result<std::uint64_t> change_all(std::int32_t to, std::chrono::nanoseconds patience = kPatience) {
    const auto bytes = bytes_of(to);
    const std::array changes{Change{&entry("p::words"), 12, bytes}, Change{&entry("p::gain"), 0, bytes},
                             Change{&entry("p::words"), 0, bytes}, Change{&entry("p::large"), kLargeEnd, bytes}};
    return change_in_one_tick(node_.name(), *store_, changes, patience);
  }
  [[nodiscard]] std::array<std::int32_t, 4> all() const {
    return {get("p::gain"), get("p::words"), get("p::words", 12), get("p::large", kLargeEnd)};
  }
  void tick() { sut_->carry_out(*store_, ++ticks_); }

  // Ticks on a thread of its own, each followed by what a module does in it.
  class Ticking {
   public:
    Ticking(BatchTest& of, std::function<void()> module)
        : thread_([this, &of, module = std::move(module)] {
            while (!end_) {
              of.tick();
              module();
            }
          }) {}
    Ticking(const Ticking&) = delete;
    Ticking& operator=(const Ticking&) = delete;
    ~Ticking() {
      end_ = true;
      thread_.join();
    }

   private:
    std::atomic<bool> end_{false};
    std::thread thread_;
  };

  TestNode node_{"batch"};
  Result<Store> store_ = Store::create(node_.name(), parameters());
  Result<Batch> sut_ = Batch::create(node_.name(), *store_);
  std::uint64_t ticks_ = 0;
};

TEST_F(BatchTest, No_tick_sees_a_mixture) {
  std::atomic<int> mixtures{0};
  const Ticking ticking(*this, [&] {
    const auto seen = all();
    mixtures += std::count(seen.begin(), seen.end(), seen[0]) == 4 ? 0 : 1;
  });
  std::uint64_t last = 0;
  for (std::int32_t i = 1; i <= 300; ++i) {
    const auto done = change_all(i);
    ASSERT_TRUE(done.ok()) << done.error().where;
    EXPECT_GT(*done, last);
    last = *done;
    EXPECT_EQ(get("p::large", kLargeEnd), i);
  }
  EXPECT_EQ(mixtures, 0);
  EXPECT_EQ(get("p::words", 4), 0);
}

TEST_F(BatchTest, A_variable_that_is_being_written_keeps_all_as_they_are) {
  auto* const ring = static_cast<abi::RingHeader*>(store_->entry(hash("p::large"), 0));
  ASSERT_NE(begin_edit(*ring), nullptr);
  {
    const Ticking ticking(*this, [] {});
    const auto done = change_all(7);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().code, Errc::Busy);
  }
  discard(*ring);
  EXPECT_EQ(all(), (std::array<std::int32_t, 4>{0, 0, 0, 0}));
  const Ticking ticking(*this, [] {});
  EXPECT_TRUE(change_all(8).ok());
  EXPECT_EQ(all(), (std::array<std::int32_t, 4>{8, 8, 8, 8}));
}

TEST_F(BatchTest, A_batch_that_is_no_longer_awaited_is_not_written) {
  const auto done = change_all(7, std::chrono::milliseconds(20));
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, Errc::Timeout);
  tick();
  EXPECT_EQ(get("p::gain"), 0);
}

TEST_F(BatchTest, Forced_parts_keep_their_values) {
  ASSERT_TRUE(store_->force(entry("p::words"), 12, bytes_of(std::int32_t{5}), kForever).ok());
  const Ticking ticking(*this, [] {});
  ASSERT_TRUE(change_all(7).ok());
  EXPECT_EQ(all(), (std::array<std::int32_t, 4>{7, 7, 5, 7}));
}

TEST_F(BatchTest, More_than_a_tick_may_do_is_refused) {
  const auto bytes = bytes_of(std::int32_t{1});
  const std::vector<Change> changes(kMaxBatchValues + 1, Change{&entry("p::gain"), 0, bytes});
  const auto done = change_in_one_tick(node_.name(), *store_, changes, kPatience);
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, Errc::InvalidArgument);
}

TEST_F(BatchTest, Nonsense_in_the_file_does_no_harm) {
  auto file = ShmFile::open(batch_file(node_.name()), Mode::ReadWrite);
  ASSERT_TRUE(file.ok());
  auto& block = *reinterpret_cast<BatchBlock*>(file->data());
  for (const BatchEntry wrong :
       {BatchEntry{99, 0, 4, 0}, BatchEntry{0, 4'000'000'000, 4, 0}, BatchEntry{0, 0, 4, 4'294'967'295},
        BatchEntry{0, 0, 0, 0}, BatchEntry{0, 0, 4'294'967'295, 0}}) {
    block.count = 4'000'000'000;
    block.entries[0] = wrong;
    block.state = BatchState::Staged;
    tick();
    EXPECT_EQ(block.state, BatchState::Wrong);
  }
}

TEST_F(BatchTest, A_node_that_was_never_started_cannot) {
  EXPECT_EQ(change_in_one_tick("t-missing", *store_, {}, kPatience).error().code, Errc::NotFound);
}

}  // namespace
}  // namespace indurop::vars
