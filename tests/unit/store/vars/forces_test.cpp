// SPDX-License-Identifier: Apache-2.0
// A forced part keeps its value against all writers, in every process, and can be written again afterwards.

#include "store/vars/forces.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "core/rt/clock.h"
#include "store/vars/store.h"
#include "test_schema.h"
#include "tests/support/forked.h"
#include "tests/support/wait_until.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using indurop::test::wait_until;
using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

schema::Schema io_image() {
  schema::Schema schema;
  schema.variables.push_back(variable("plc::count", scalar_type(schema::Base::Int32)));
  schema.variables.push_back(variable("plc::words", array_type(schema::Base::Int32, 4)));
  schema.variables.push_back(variable("plc::large", array_type(schema::Base::Int32, 4000)));
  return schema;
}

class Forces : public ::testing::Test {
 protected:
  std::int32_t get(const std::string& name, std::uint32_t offset = 0) const {
    std::array<std::uint8_t, 4> bytes{};
    EXPECT_TRUE(sut_->read(*sut_->find(hash(name)), offset, bytes).ok());
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  Status put(const std::string& name, std::int32_t value, std::uint32_t offset = 0) {
    return sut_->write(*sut_->find(hash(name)), offset, bytes_of(value));
  }
  Status force(const std::string& name, std::int32_t value, std::uint32_t offset = 0, rt::MonoTime until = kForever) {
    return sut_->force(*sut_->find(hash(name)), offset, bytes_of(value), until);
  }
  Status release(const std::string& name, std::uint32_t offset = 0) {
    return sut_->release(*sut_->find(hash(name)), offset);
  }

  TestNode node_{"forces"};
  Result<Store> sut_ = Store::create(node_.name(), io_image());
};

TEST_F(Forces, A_scalar_keeps_its_value_until_it_is_released) {
  ASSERT_TRUE(put("plc::count", 1).ok());
  ASSERT_TRUE(force("plc::count", 7).ok());
  EXPECT_EQ(get("plc::count"), 7);
  EXPECT_TRUE(put("plc::count", 2).ok());
  EXPECT_EQ(get("plc::count"), 7);
  ASSERT_TRUE(force("plc::count", 8).ok()) << "again, to another value";
  EXPECT_EQ(get("plc::count"), 8);
  ASSERT_TRUE(release("plc::count").ok());
  EXPECT_EQ(get("plc::count"), 8) << "until it is written";
  EXPECT_TRUE(put("plc::count", 3).ok());
  EXPECT_EQ(get("plc::count"), 3);
}

TEST_F(Forces, Of_an_array_only_the_part_is_held) {
  for (const std::string name : {"plc::words", "plc::large"}) {
    ASSERT_TRUE(force(name, 7, 4).ok());
    const std::uint64_t size = sut_->find(hash(name))->value_size;
    for (std::uint8_t round = 1; round < 6; ++round) {  // through all slots of the ring
      ASSERT_TRUE(sut_->write(*sut_->find(hash(name)), 0, std::vector<std::uint8_t>(size, round)).ok());
      EXPECT_EQ(get(name, 4), 7);
      EXPECT_EQ(get(name, 8), 0x01010101 * round);
      ASSERT_TRUE(put(name, -round, 4).ok());
      EXPECT_EQ(get(name, 4), 7);
      ASSERT_TRUE(put(name, -round, 0).ok());
      EXPECT_EQ(get(name), -round);
    }
    ASSERT_TRUE(release(name, 4).ok());
    ASSERT_TRUE(put(name, 5, 4).ok());
    EXPECT_EQ(get(name, 4), 5);
  }
}

TEST_F(Forces, Holds_in_other_processes_and_for_the_time_given) {
  const rt::MonoTime until = rt::MonoClock::now() + std::chrono::milliseconds(300);
  ASSERT_TRUE(force("plc::count", 7, 0, until).ok());
  Forked child([this] {
    auto mine = Store::attach(node_.name(), Mode::ReadWrite);
    while (mine->write(*mine->find(hash("plc::count")), 0, bytes_of<std::int32_t>(1)).ok()) {
    }
    return 1;
  });
  while (rt::MonoClock::now() < until) {
    const std::int32_t value = get("plc::count");
    ASSERT_TRUE(value == 7 || rt::MonoClock::now() >= until) << value;
  }
  EXPECT_TRUE(wait_until([this] { return get("plc::count") == 1; }));
  EXPECT_TRUE(sut_->forces().empty());
  child.kill_and_wait();
  sut_->release_overdue();
  EXPECT_EQ(release("plc::count").error().code, Errc::NotFound);
}

TEST_F(Forces, A_writer_at_this_moment_does_not_slip_through) {
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    while (!stop) {
      static_cast<void>(put("plc::count", 1));
    }
  });
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(force("plc::count", 7).ok());
    for (int look = 0; look < 100; ++look) {
      EXPECT_EQ(get("plc::count"), 7);
    }
    ASSERT_TRUE(release("plc::count").ok());
    ASSERT_TRUE(wait_until([this] { return get("plc::count") == 1; }));
  }
  stop = true;
  writer.join();
}

TEST_F(Forces, Are_listed_and_limited) {
  ASSERT_TRUE(force("plc::count", 7).ok());
  ASSERT_TRUE(force("plc::words", -1, 8).ok());
  const auto listed = Store::attach(node_.name(), Mode::ReadOnly)->forces();
  ASSERT_EQ(listed.size(), 2U);
  EXPECT_EQ(listed[0].value, 7U);
  EXPECT_EQ(listed[1].offset, 8U);
  EXPECT_EQ(listed[1].value, 0xFFFFFFFFU);
  for (std::uint32_t i = 2; i < kMaxForces; ++i) {
    ASSERT_TRUE(force("plc::large", 1, 4 * i).ok());
  }
  EXPECT_EQ(force("plc::large", 1, 4000).error().code, Errc::NoSpace);
  ASSERT_TRUE(release("plc::count").ok());
  EXPECT_TRUE(force("plc::large", 1, 4000).ok());
}

TEST_F(Forces, Wrong_ones_are_refused) {
  const DirectoryEntry& words = *sut_->find(hash("plc::words"));
  EXPECT_EQ(sut_->force(words, 0, std::vector<std::uint8_t>(16), kForever).error().code, Errc::OutOfRange);
  EXPECT_EQ(sut_->force(words, 0, std::vector<std::uint8_t>(3), kForever).error().code, Errc::InvalidArgument);
  EXPECT_EQ(force("plc::words", 1, 14).error().code, Errc::OutOfRange);
  EXPECT_EQ(release("plc::words", 4).error().code, Errc::NotFound);
  auto reader = Store::attach(node_.name(), Mode::ReadOnly);
  EXPECT_EQ(reader->force(words, 0, bytes_of(1), kForever).error().code, Errc::PermissionDenied);
}

TEST_F(Forces, End_with_the_node) {
  ASSERT_TRUE(force("plc::count", 7).ok());
  ASSERT_TRUE(force("plc::words", 7).ok());
  sut_ = Store::create(node_.name(), io_image());
  EXPECT_EQ(sut_->origin(), Origin::Adopted);
  EXPECT_TRUE(sut_->forces().empty());
  ASSERT_TRUE(put("plc::count", 3).ok());
  EXPECT_EQ(get("plc::count"), 3);
  ASSERT_TRUE(put("plc::words", 3).ok());
  EXPECT_EQ(get("plc::words"), 3);
}

TEST_F(Forces, A_client_killed_while_forcing_blocks_no_writer) {
  for (int i = 0; i < 20; ++i) {
    Forked child([this]() -> int {
      auto mine = Store::attach(node_.name(), Mode::ReadWrite);
      const DirectoryEntry& words = *mine->find(hash("plc::words"));
      for (std::uint32_t n = 0;; n = (n + 4) % 16) {
        static_cast<void>(mine->force(words, n, bytes_of(n), kForever));
        static_cast<void>(mine->release(words, n));
      }
    });
    ASSERT_TRUE(wait_until([this] { return !sut_->forces().empty(); }));
    child.kill_and_wait();
    ASSERT_TRUE(force("plc::count", i).ok());
    EXPECT_EQ(get("plc::count"), i);
    for (std::uint32_t n = 0; n < 16; n += 4) {
      const Status gone = release("plc::words", n);
      EXPECT_TRUE(gone.ok() || gone.error().code == Errc::NotFound);
    }
    ASSERT_TRUE(put("plc::words", i + 1, 12).ok());
    EXPECT_EQ(get("plc::words", 12), i + 1);
  }
}

}  // namespace
}  // namespace indurop::vars
