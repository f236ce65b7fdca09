// SPDX-License-Identifier: Apache-2.0
// Values set, forced and released under a write lock, and what is noted of that.

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/schema/schema.h"
#include "store/operate/hold.h"
#include "store/operate/journal.h"
#include "store/operate/set.h"
#include "store/vars/custody.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::operate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

schema::Type number() {
  schema::Type type;
  type.base = schema::Base::Double;
  type.element_size = sizeof(double);
  type.align = alignof(double);
  return type;
}

schema::Variable variable(const std::string& name, schema::Type type) {
  schema::Variable out;
  out.name = name;
  out.type = std::move(type);
  out.type_hash = schema::hash_of(out.type);
  return out;
}

schema::Schema variables() {
  schema::Type place;
  place.base = schema::Base::Struct;
  place.name = "Place";
  place.element_size = 2 * sizeof(double);
  place.align = alignof(double);
  for (const char* name : {"x", "y"}) {
    schema::Field field;
    field.name = name;
    field.type = number();
    field.offset = static_cast<std::uint32_t>(place.fields.size() * sizeof(double));
    place.fields.push_back(std::move(field));
  }
  schema::Schema schema;
  schema.variables = {variable("cell::gain", number()), variable("cell::axis", place),
                      variable("other::axis2", number())};
  schema.variables[0].range = schema::Range{0, 10};
  schema.variables[0].given = true;
  schema.variables[2].given = true;
  schema.variables[2].optional = true;
  return schema;
}

class Operate : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string folder = (std::filesystem::temp_directory_path() / "operate_XXXXXX").string();
    ASSERT_NE(::mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    ASSERT_EQ(::setenv("INDUROP_STATE_DIR", folder.c_str(), 1), 0);
    std::filesystem::create_directories(folder_ / node_);
    ASSERT_TRUE(vars::Custody::create(node_).ok());
    auto made = vars::Store::create(node_, variables());
    ASSERT_TRUE(made.ok());
    made_.emplace(std::move(made).value());
    auto attached = vars::Store::attach(node_, vars::Mode::ReadWrite);
    ASSERT_TRUE(attached.ok());
    store_.emplace(std::move(attached).value());
  }
  void TearDown() override {
    EXPECT_TRUE(vars::remove_shm_file(vars::block_file(node_)).ok());
    EXPECT_TRUE(vars::remove_shm_file(vars::custody_file(node_)).ok());
    std::filesystem::remove_all(folder_);
  }

  std::vector<Assignment> parsed(const std::vector<std::string>& lines) {
    auto all = parse_all(*store_, lines);
    EXPECT_TRUE(all.ok());
    return all ? std::move(all).value() : std::vector<Assignment>();
  }
  Result<void, Refusal> set_lines(const std::vector<std::string>& lines) {
    return set(node_, *store_, parsed(lines), ana_);
  }
  Result<Lease, Refusal> force(const std::vector<std::string>& lines, std::int64_t for_ns = 0,
                               Ends ends = Ends::AtTime) {
    return hold(node_, *store_, parsed(lines), for_ns, ends, ana_);
  }
  double value(const std::string& name) {
    const auto item = find(*store_, name);
    const auto bytes = read(*store_, *item);
    return std::stod(schema::format_value(item->place.type, *bytes));
  }
  // "action what=value" of all that was noted.
  std::vector<std::string> noted() {
    std::vector<std::string> all;
    for (const Order& one : read_orders(node_, 0)) {
      EXPECT_EQ(one.who, "ana");
      EXPECT_EQ(one.from, "pc4");
      EXPECT_EQ(one.reason, "a trial");
      EXPECT_GT(one.node_ns, 0);
      EXPECT_GT(one.wall_ns, 0);
      all.push_back(one.action + " " + one.what + (one.value.empty() ? "" : "=" + one.value));
    }
    return all;
  }

  const std::string node_ = "operate_test_" + std::to_string(::getpid());
  const Who ana_{"ana", "pc4", "a trial"};
  std::filesystem::path folder_;
  std::optional<vars::Store> made_;
  std::optional<vars::Store> store_;
};

TEST_F(Operate, A_force_that_is_in_the_table_but_not_yet_in_the_variable_is_reported_as_both) {
  ASSERT_TRUE(force({"cell::axis.y=2.5"}).ok());
  const auto forces = store_->forces();
  ASSERT_EQ(forces.size(), 1U);
  const auto overlaid = [&](const std::string& name) {
    const auto item = find(*store_, name);
    std::vector<std::uint8_t> bytes(item->place.type.size());  // as before the force: zeros
    const bool touched = overlay(forces, *item, bytes);
    return std::pair(touched, schema::format_value(item->place.type, bytes));
  };
  EXPECT_EQ(overlaid("cell::axis"), std::pair(true, std::string("{x: 0, y: 2.5}")));
  EXPECT_EQ(overlaid("cell::axis.y"), std::pair(true, std::string("2.5")));
  EXPECT_EQ(overlaid("cell::axis.x"), std::pair(false, std::string("0")));
  EXPECT_EQ(overlaid("cell::gain"), std::pair(false, std::string("0")));
}

TEST_F(Operate, Notes_full_names_values_and_ends) {
  ASSERT_TRUE(set_lines({"gain=2.5"}).ok());
  ASSERT_TRUE(force({"axis.x=1"}).ok());
  ASSERT_TRUE(force({"other::axis2=3"}, 60'000'000'000).ok());
  EXPECT_THAT(*release(node_, *store_, *select(*store_, {"axis"}), ana_), ElementsAre("cell::axis.x"));
  EXPECT_THAT(*release_all(node_, *store_, ana_), ElementsAre("other::axis2"));
  EXPECT_THAT(noted(), ElementsAre("set cell::gain=2.5", "force cell::axis.x=1", "force other::axis2=3",
                                   "unforce cell::axis.x", "unforce other::axis2"));
  const auto orders = read_orders(node_, 0);
  EXPECT_EQ(orders[1].until_ns, INT64_MAX);
  EXPECT_GT(orders[2].until_ns, orders[2].node_ns);
  EXPECT_LT(orders[2].until_ns, INT64_MAX);
}

TEST_F(Operate, A_force_shows_who_made_it) {
  ASSERT_TRUE(force({"axis={x: 1}"}).ok());
  const auto custody = vars::Custody::open(node_, vars::Mode::ReadOnly);
  const auto note = custody->note_of(*find(*store_, "axis")->entry, 0);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->who, "ana");
  EXPECT_EQ(note->from, "pc4");
  EXPECT_EQ(note->reason, "a trial");
}

TEST_F(Operate, Assignments_of_parts_of_one_value_add_up) {
  ASSERT_TRUE(set_lines({"axis={x: 1}", "axis={y: 2}", "axis.x=3"}).ok());
  EXPECT_EQ(value("axis.x"), 3);
  EXPECT_EQ(value("axis.y"), 2);
}

// A module that owns `x` must never read anything but what it wrote.
TEST_F(Operate, Parts_that_are_not_mentioned_keep_what_a_module_writes_meanwhile) {
  std::uint64_t lost = 0;
  {
    const std::jthread module([&](const std::stop_token& end) {
      auto own = vars::Store::attach(node_, vars::Mode::ReadWrite);
      const vars::DirectoryEntry& axis = *find(*own, "axis")->entry;
      std::array<std::uint8_t, sizeof(double)> wrote{};
      for (double count = 1; !end.stop_requested(); ++count) {
        auto now = wrote;
        lost += own->read(axis, 0, now) && now == wrote ? 0U : 1U;
        wrote = std::bit_cast<decltype(wrote)>(count);
        lost += own->write(axis, 0, wrote) ? 0U : 1U;
      }
    });
    for (int i = 1; i <= 3000; ++i) {
      ASSERT_TRUE(set_lines({"axis={y: " + std::to_string(i) + "}"}).ok());
      EXPECT_EQ(value("axis.y"), i);
    }
  }
  EXPECT_EQ(lost, 0U);
  EXPECT_GT(value("axis.x"), 0);
}

TEST_F(Operate, Names_all_that_is_wrong_and_changes_nothing) {
  const auto wrong = parse_all(*store_, {"gain=11", "nothing=1", "axis.x=?", "gain"});
  ASSERT_FALSE(wrong.ok());
  EXPECT_THAT(wrong.error(), ElementsAre(HasSubstr("11 is outside 0..10"), HasSubstr("no variable 'nothing'"),
                                         HasSubstr("cell::axis.x: '?' is not a number"), HasSubstr("NAME=VALUE")));
  EXPECT_THAT(noted(), IsEmpty());
}

TEST_F(Operate, Names_200_of_many_that_are_wrong) {
  const auto wrong = parse_all(*store_, std::vector<std::string>(300, "gian=1"));
  ASSERT_FALSE(wrong.ok());
  ASSERT_EQ(wrong.error().size(), 201U);
  EXPECT_EQ(wrong.error()[199], "no variable 'gian'; did you mean 'cell::gain'?");
  EXPECT_EQ(wrong.error()[200], "too many errors, the first 200 are shown");
}

TEST_F(Operate, What_is_forced_is_not_set) {
  ASSERT_TRUE(force({"axis.x=1"}).ok());
  const auto refused = set_lines({"gain=1", "axis={y: 2}"});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().why, Why::Forced);
  EXPECT_THAT(refused.error().reasons,
              ElementsAre("cell::axis is forced; release it first: indurop unforce 'cell::axis'"));
  EXPECT_EQ(value("gain"), 0) << "all or none";
}

TEST_F(Operate, The_lock_decides_what_may_be_done) {
  ASSERT_TRUE(force({"axis.x=1"}).ok());
  for (const auto lock : {vars::WriteLock::None, vars::WriteLock::Tune, vars::WriteLock::All}) {
    ASSERT_TRUE(set_lock(node_, lock, ana_).ok());
    const bool free = lock == vars::WriteLock::None;
    const auto allowed = [&](const auto& result, bool expected) {
      EXPECT_EQ(result.ok(), expected) << vars::word_of(lock);
      if (!result.ok()) {
        EXPECT_EQ(result.error().why, Why::Locked);
        EXPECT_THAT(result.error().text(), HasSubstr("by ana (a trial)"));
      }
    };
    allowed(set_lines({"gain=1"}), lock != vars::WriteLock::All);
    allowed(set_lines({"gain=1", "axis2=1"}), free);
    allowed(set_lines({"axis2=1"}), free);  // declared with a value, but a request
    allowed(force({"gain=1"}), free);
    allowed(release(node_, *store_, *select(*store_, {"gain"}), ana_), free);
  }
  EXPECT_THAT(*select(*store_, {"*axis*"}), ::testing::SizeIs(2));
}

TEST_F(Operate, A_lease_ends_when_another_user_releases_a_part) {
  auto lease = force({"axis={x: 1, y: 2}"}, 60'000'000'000, Ends::UnlessRenewed);
  ASSERT_TRUE(lease.ok());
  EXPECT_TRUE(renew(*lease, *store_, 60'000'000'000).ok());
  ASSERT_TRUE(release(node_, *store_, *select(*store_, {"axis.x"}), ana_).ok());
  const auto lost = renew(*lease, *store_, 60'000'000'000);
  ASSERT_FALSE(lost.ok());
  EXPECT_EQ(lost.error().why, Why::Forced);
  end(node_, *store_, *lease, ana_);
  EXPECT_THAT(store_->forces(), IsEmpty());
  EXPECT_THAT(noted(), ElementsAre("force cell::axis={x: 1, y: 2}", "unforce cell::axis.x", "unforce cell::axis"));
}

TEST_F(Operate, A_node_that_has_not_run_has_no_lock) {
  const auto refused = set_lock(node_ + "_no", vars::WriteLock::All, ana_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().why, Why::Absent);
}

// The journal says at any time what is forced: random orders, compared with the store.
TEST_F(Operate, The_journal_and_the_store_agree) {
  std::mt19937 random(7);
  const std::vector<std::string> parts{"cell::gain", "cell::axis.x", "cell::axis.y", "other::axis2"};
  const auto pick = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 200; ++i) {
    const std::string& part = parts[pick(parts.size())];
    switch (pick(4)) {
      case 0:
        ASSERT_TRUE(release(node_, *store_, *select(*store_, {part}), ana_).ok());
        break;
      case 1:
        static_cast<void>(set_lines({part + "=" + std::to_string(pick(10))}));  // refused while it is forced
        break;
      default:
        ASSERT_TRUE(force({part + "=" + std::to_string(pick(10))}).ok());
    }
    std::map<std::string, std::string> expected;
    for (const Order& one : read_orders(node_, 0)) {
      if (one.action == "force") {
        expected[one.what] = one.value;
      } else if (one.action == "unforce") {
        expected.erase(one.what);
      }
    }
    std::map<std::string, std::string> found;
    for (const vars::ForcedPart& one : vars::forced_parts(*store_)) {
      found[one.name] = schema::format_value(one.type, one.bytes);
    }
    ASSERT_EQ(found, expected) << "after " << i;
  }
}

}  // namespace
}  // namespace indurop::operate
