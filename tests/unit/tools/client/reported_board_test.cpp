// SPDX-License-Identifier: Apache-2.0
// A board elsewhere, from what its agent says: the store of a node here and the one that is made of its agent's words
// hold the same, whatever its variables are; words that make no sense change nothing.
#include "tools/client/board/reported_board.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "deploy/agent/board_values.h"
#include "store/vars/shm_file.h"

namespace indurop::tools {
namespace {

using Taken = ReportedBoard::Taken;

schema::Variable variable(const std::string& name, schema::Base base, std::vector<std::uint32_t> dims) {
  schema::Variable out;
  out.name = name;
  out.type.base = base;
  out.type.element_size = schema::size_of(base);
  out.type.align = out.type.element_size;
  out.type.dims = std::move(dims);
  out.kind = out.type.dims.empty() ? abi::Kind::Scalar : abi::Kind::Ring;
  out.type_hash = schema::hash_of(out.type);
  return out;
}

class RemoteBoardTest : public ::testing::Test {
 protected:
  ~RemoteBoardTest() override { EXPECT_TRUE(vars::remove_shm_file(vars::block_file(node_)).ok()); }

  vars::Store random_store(std::mt19937& rng) {
    constexpr schema::Base kBases[] = {schema::Base::UInt8, schema::Base::Int16, schema::Base::Float,
                                       schema::Base::Double, schema::Base::UInt64};
    schema::Schema schema;
    const std::size_t count = 1 + rng() % 40;
    for (std::size_t i = 0; i < count; ++i) {
      const auto dims = rng() % 3 == 0 ? std::vector<std::uint32_t>{1 + static_cast<std::uint32_t>(rng() % 7)}
                                       : std::vector<std::uint32_t>{};
      schema.variables.push_back(
          variable("some::v" + std::to_string(rng() % 1000) + "_" + std::to_string(i), kBases[rng() % 5], dims));
    }
    return std::move(vars::Store::create(node_, schema)).value();
  }

  std::string node_ = "remote_board_test_" + std::to_string(getpid());
};

std::vector<std::uint8_t> bytes_of(const vars::Store& store, const vars::DirectoryEntry& entry) {
  std::vector<std::uint8_t> bytes(entry.value_size);
  EXPECT_TRUE(store.read(entry, 0, bytes).ok());
  return bytes;
}

TEST_F(RemoteBoardTest, Holds_what_the_store_over_there_holds) {
  std::mt19937 rng(16);
  ReportedBoard sut("there");
  for (int round = 0; round < 60; ++round) {
    vars::Store there = random_store(rng);
    for (const vars::DirectoryEntry& entry : there.directory()) {
      std::vector<std::uint8_t> bytes(entry.value_size);
      for (std::uint8_t& byte : bytes) {
        byte = static_cast<std::uint8_t>(rng());
      }
      ASSERT_TRUE(there.write(entry, 0, bytes).ok());
    }
    deploy::BoardValues report(node_);
    const std::int64_t now = rt::now_ns();
    if (round % 2 == 0) {
      EXPECT_NE(sut.take_values(report.values(rt::mono_time(now)), now), Taken::Yes) << "of other variables";
    }
    ASSERT_TRUE(sut.take_variables(report.variables()));
    ASSERT_EQ(sut.take_values(report.values(rt::mono_time(now)), now), Taken::Yes);
    const auto here = sut.attach(1);
    ASSERT_TRUE(here.ok());
    EXPECT_FALSE(sut.attach(1).ok()) << "each reader once";
    ASSERT_EQ(here.value().directory().size(), there.directory().size());
    for (const vars::DirectoryEntry& entry : there.directory()) {
      const auto* const same = here.value().find(entry.name_hash);
      ASSERT_TRUE(same != nullptr && same->type_hash == entry.type_hash);
      EXPECT_EQ(bytes_of(here.value(), *same), bytes_of(there, entry));
    }
  }
}

TEST_F(RemoteBoardTest, Tells_ages_silence_and_forces) {
  schema::Schema schema;
  schema.variables = {variable("own", schema::Base::Double, {}), variable("theirs", schema::Base::Double, {}),
                      variable("silent", schema::Base::Double, {}), variable("never", schema::Base::Double, {})};
  vars::Store there = std::move(vars::Store::create(node_, schema)).value();
  const auto confirm = [&there](const char* name, std::int64_t what) {
    const auto* const entry = there.find(abi::fnv1a64(name, std::char_traits<char>::length(name)));
    abi::confirmed_of(there.entry(entry->name_hash, 0), entry->kind).store(what);
  };
  const std::int64_t begun = rt::now_ns();
  constexpr std::int64_t kAgo = 40'000'000;
  confirm("theirs", begun - kAgo);
  confirm("silent", -(begun - kAgo));
  confirm("never", abi::kNeverConfirmed);
  const auto& forced = there.directory().front();
  const double five = 5;
  ASSERT_TRUE(there.force(forced, 0, {reinterpret_cast<const std::uint8_t*>(&five), sizeof five}, vars::kForever).ok());
  deploy::BoardValues report(node_);
  ReportedBoard sut("there");
  ASSERT_TRUE(sut.take_variables(report.variables()));
  const std::string text = report.values(rt::mono_time(begun));
  const std::int64_t later = rt::now_ns() + 1'000'000'000;  // the clock over there is another one
  ASSERT_EQ(sut.take_values(text, later), Taken::Yes);
  const auto here = sut.attach(0);
  const auto confirmed = [&here](const char* name) {
    const auto* const entry = here.value().find(abi::fnv1a64(name, std::char_traits<char>::length(name)));
    return abi::confirmed_of(here.value().entry(entry->name_hash, 0), entry->kind).load();
  };
  EXPECT_EQ(confirmed("own"), later);
  EXPECT_LE(confirmed("theirs"), later - kAgo);
  EXPECT_GT(confirmed("theirs"), later - kAgo - 1'000'000'000);
  EXPECT_GE(confirmed("silent"), -(later - kAgo));
  EXPECT_LT(confirmed("silent"), 0);
  EXPECT_EQ(confirmed("never"), abi::kNeverConfirmed);
  ASSERT_EQ(here.value().forces().size(), 1U);
  EXPECT_EQ(here.value().forces().front().variable->name_hash, forced.name_hash);
  ASSERT_TRUE(there.release(forced, 0).ok());
  ASSERT_EQ(sut.take_values(report.values(rt::MonoClock::now() + deploy::BoardValues::kKeep), later), Taken::Yes);
  EXPECT_TRUE(here.value().forces().empty());
  sut.silent();
  EXPECT_EQ(confirmed("own"), -later);
  EXPECT_FALSE(sut.report().values);
}

TEST_F(RemoteBoardTest, Words_that_make_no_sense_change_nothing) {
  std::mt19937 rng(17);
  vars::Store there = random_store(rng);
  deploy::BoardValues report(node_);
  ReportedBoard sut("there");
  for (const char* text : {"", "\n", "{}\n{}", "[]\n", "{\"layout\": 1}\n", "{\"layout\": \"x\"}\nnothing"}) {
    EXPECT_FALSE(sut.take_variables(text)) << text;
  }
  EXPECT_FALSE(sut.attach(0).ok());
  ASSERT_TRUE(sut.take_variables(report.variables()));
  const std::string good = report.values(rt::MonoClock::now());
  const auto here = sut.attach(0);
  ASSERT_EQ(sut.take_values(good, 1000), Taken::Yes);
  const auto before = bytes_of(here.value(), here.value().directory().front());
  for (int round = 0; round < 500; ++round) {
    std::string bad = good;
    const std::size_t at = rng() % (bad.find('\n') + 2);
    rng() % 2 == 0 ? bad.resize(rng() % bad.size()) : void(bad[at] = static_cast<char>(rng()));
    (void)sut.take_values(bad, 1000);  // whatever it is taken for
    bad.resize(bad.size() / 2);
    EXPECT_NE(sut.take_values(bad, 1000), Taken::Yes);
  }
  EXPECT_EQ(sut.take_values(good, 1000), Taken::Yes);
  EXPECT_EQ(bytes_of(here.value(), here.value().directory().front()), before);
}

}  // namespace
}  // namespace indurop::tools
