// SPDX-License-Identifier: Apache-2.0
// A debugger stops a process inside a write: others neither wait for ever nor see its unfinished version.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "core/rt/shared_mutex.h"
#include "fault.h"
#include "store/vars/store.h"
#include "store/vars/tear_free_ring.h"
#include "tests/support/wait_until.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::bytes_of;
using test::hash;
using test::TestNode;
using test::variable;

schema::Schema one_variable() {
  schema::Schema schema;
  schema.variables.push_back(variable("joints", array_type(schema::Base::Double, 30)));
  return schema;
}

// Takes the lock, spoils the slot, and stays there.
int hold(const TestNode& node, std::atomic<bool>& holding) {
  auto store = Store::attach(node.name(), Mode::ReadWrite);
  if (!store.ok()) {
    return 1;
  }
  void* slot = begin_edit(*static_cast<abi::RingHeader*>(store->entry(hash("joints"), 0)));
  std::memset(slot, 0xFF, 240);
  holding = true;
  while (true) {
    ::pause();
  }
}

class StoppedWriter : public testing::Test {
 protected:
  StoppedWriter()
      : node_("stopped"),
        store_(Store::create(node_.name(), one_variable()).value()),
        holder_([this] { return hold(node_, *holding_); }) {
    EXPECT_TRUE(indurop::test::wait_until([this] { return holding_->load(); }));
    holder_.signal(SIGSTOP);
  }
  Status write(double value) { return store_.write(*store_.find(hash("joints")), 0, bytes_of(value)); }
  double read() {
    double value = -1;
    std::vector<std::uint8_t> bytes(8);
    EXPECT_TRUE(store_.read(*store_.find(hash("joints")), 0, bytes).ok());
    std::memcpy(&value, bytes.data(), 8);
    return value;
  }
  abi::RingHeader& ring() { return *static_cast<abi::RingHeader*>(store_.entry(hash("joints"), 0)); }

  TestNode node_;
  test::Shared<std::atomic<bool>> holding_;
  Store store_;
  Forked holder_;
};

TEST_F(StoppedWriter, Write_is_refused_after_the_limit_and_counted) {
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(write(1.0).error().code, Errc::Busy);
  EXPECT_GE(std::chrono::steady_clock::now() - before, rt::kLockLimit);
  EXPECT_EQ(ring().lost_writes.load(), 1U);
  store_.reset(false);
  EXPECT_EQ(ring().lost_writes.load(), 2U);
}

TEST_F(StoppedWriter, Reading_goes_on) {
  EXPECT_EQ(read(), 0.0);
  double value = -1;
  read_slow(ring(), &value, 8, 8);
  EXPECT_EQ(value, 0.0);
}

TEST_F(StoppedWriter, Its_death_frees_the_lock_and_drops_its_version) {
  EXPECT_EQ(write(1.0).error().code, Errc::Busy);
  holder_.kill_and_wait();
  EXPECT_TRUE(write(2.0).ok());
  EXPECT_EQ(read(), 2.0);
  std::vector<std::uint8_t> rest(232);
  ASSERT_TRUE(store_.read(*store_.find(hash("joints")), 8, rest).ok());
  EXPECT_EQ(rest, std::vector<std::uint8_t>(232, 0));
}

TEST_F(StoppedWriter, A_new_node_adopts_the_block_in_its_presence) {
  auto sut = Store::create(node_.name(), one_variable());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::Adopted);
}

TEST_F(StoppedWriter, New_layout_carries_the_published_value_over) {
  schema::Schema more = one_variable();
  more.variables.push_back(variable("more", test::scalar_type(schema::Base::Bool)));
  auto sut = Store::create(node_.name(), more);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::CarriedOver);
  std::vector<std::uint8_t> value(240, 1);
  ASSERT_TRUE(sut->read(*sut->find(hash("joints")), 0, value).ok());
  EXPECT_EQ(value, std::vector<std::uint8_t>(240, 0));
}

}  // namespace
}  // namespace indurop::vars
