// SPDX-License-Identifier: Apache-2.0
// Structs, arrays and texts held number by number: what the text says and nothing else, all or none.

#include "store/vars/held_value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <random>
#include <thread>

#include "store/vars/custody.h"
#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

schema::Type text_type(std::uint32_t size) {
  schema::Type type;
  type.base = schema::Base::Text;
  type.text_size = size;
  type.element_size = size;
  return type;
}

// {double x; char name[20]; uint8_t n[3]; int16_t z} with holes between the fields.
schema::Type part_type() {
  schema::Type type;
  type.base = schema::Base::Struct;
  type.name = "Part";
  type.element_size = 40;
  type.align = 8;
  const auto add = [&type](const char* name, schema::Type field, std::uint32_t offset) {
    schema::Field made;
    made.name = name;
    made.type = std::move(field);
    made.offset = offset;
    type.fields.push_back(made);
  };
  add("x", scalar_type(schema::Base::Double), 0);
  add("name", text_type(20), 8);
  add("n", test::array_type(schema::Base::UInt8, 3), 28);
  add("z", scalar_type(schema::Base::Int16), 32);
  return type;
}

class HeldValues : public ::testing::Test {
 protected:
  HeldValues() {
    schema::Schema schema;
    schema.variables.push_back(variable("part", part_type()));
    schema::Type many = part_type();
    many.dims = {20};
    schema.variables.push_back(variable("many", many));
    sut_ = std::make_unique<Store>(Store::create(node_.name(), schema).value());
  }
  ~HeldValues() override { static_cast<void>(remove_shm_file(custody_file(node_.name()))); }

  HeldValue value(const std::string& name, const std::string& text) {
    const DirectoryEntry* entry = sut_->find(hash(name));
    const schema::Type& type = sut_->schema().variables[entry->schema_index].type;
    HeldValue made{entry, 0, type, std::vector<std::uint8_t>(type.size()), {}};
    EXPECT_TRUE(schema::parse_value(type, text, made.bytes).ok()) << text;
    made.parts = parts_to_hold(type, text, made.bytes);
    return made;
  }
  static std::vector<HeldValue> number_at(const DirectoryEntry& entry, std::uint32_t offset) {
    return {{&entry, offset, scalar_type(schema::Base::Double), test::bytes_of(1.0), {{0, 8}}}};
  }
  std::string now(const std::string& name) {
    const DirectoryEntry* entry = sut_->find(hash(name));
    std::vector<std::uint8_t> bytes(entry->value_size);
    EXPECT_TRUE(sut_->read(*entry, 0, bytes).ok());
    return schema::format_value(sut_->schema().variables[entry->schema_index].type, bytes);
  }
  void write(const std::string& name, const std::string& text) {
    const HeldValue made = value(name, text);
    ASSERT_TRUE(sut_->write(*made.variable, 0, made.bytes).ok());
  }

  TestNode node_{"held"};
  std::unique_ptr<Store> sut_;
};

TEST_F(HeldValues, What_is_said_is_held_and_the_rest_goes_on) {
  struct Case {
    const char* said;
    const char* after;
  };
  constexpr const char* kElse = "{x: 9, name: \"another user\", n: [9, 9, 9], z: -9}";
  for (const auto& [said, after] : {
           Case{"{x: 0.5}", "{x: 0.5, name: \"another user\", n: [9, 9, 9], z: -9}"},
           Case{"{z: -1, n: [255, 0, 1]}", "{x: 9, name: \"another user\", n: [255, 0, 1], z: -1}"},
           Case{"{name: \"\"}", "{x: 9, name: \"\", n: [9, 9, 9], z: -9}"},
           Case{"{name: \"nineteen characters\"}", "{x: 9, name: \"nineteen characters\", n: [9, 9, 9], z: -9}"},
           Case{"{}", kElse},
           Case{"{x: 1, name: \"a\", n: [1, 2, 3], z: 4}", "{x: 1, name: \"a\", n: [1, 2, 3], z: 4}"},
       }) {
    const std::vector<HeldValue> held{value("part", said)};
    ASSERT_TRUE(hold(*sut_, held, kForever).ok()) << said;
    write("part", kElse);
    EXPECT_EQ(now("part"), after);
    EXPECT_TRUE(release(*sut_, held, kForever).ok());
    EXPECT_TRUE(sut_->forces().empty());
    write("part", kElse);
    EXPECT_EQ(now("part"), kElse);
  }
}

TEST_F(HeldValues, A_shorter_text_keeps_nothing_of_a_longer_one) {
  for (const char* text : {"seventeen letters", "short", "eight888", "", "sixteen letters!"}) {
    ASSERT_TRUE(hold(*sut_, std::vector<HeldValue>{value("part", "{name: \"" + std::string(text) + "\"}")}, kForever));
    write("part", "{x: 1, name: \"something other\", n: [1, 1, 1], z: 1}");
    EXPECT_EQ(now("part"), "{x: 1, name: \"" + std::string(text) + "\", n: [1, 1, 1], z: 1}");
    const auto parts = forced_parts(*sut_);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].name, "part.name");
    EXPECT_EQ(schema::format_value(parts[0].type, parts[0].bytes), "\"" + std::string(text) + "\"");
  }
}

TEST_F(HeldValues, What_does_not_fit_is_not_begun) {
  std::string all = "[";
  for (int i = 0; i < 20; ++i) {
    all += std::string(i == 0 ? "" : ", ") + "{x: 1, n: [1, 1, 1], z: 1}";  // 5 numbers, 100 together
  }
  ASSERT_TRUE(hold(*sut_, std::vector<HeldValue>{value("part", "{x: 1}")}, kForever).ok());
  EXPECT_EQ(hold(*sut_, std::vector<HeldValue>{value("many", all + "]")}, kForever).error().code, Errc::NoSpace);
  EXPECT_EQ(sut_->forces().size(), 1U);
  EXPECT_EQ(now("many").find("x: 1"), std::string::npos);
}

TEST_F(HeldValues, A_word_that_is_held_in_another_size_is_held_again) {
  const DirectoryEntry& part = *sut_->find(hash("part"));
  const std::vector<std::uint8_t> one{'X'};
  ASSERT_TRUE(sut_->force(part, 8, one, kForever).ok());
  const std::vector<std::uint8_t> eight{'A', 'B', 'C', 'D', 'E', 'F', 'G', 0};
  ASSERT_TRUE(sut_->force(part, 8, eight, kForever).ok());
  write("part", "{x: 1, name: \"other\", n: [1, 1, 1], z: 1}");
  EXPECT_EQ(now("part"), "{x: 1, name: \"ABCDEFG\", n: [1, 1, 1], z: 1}");
}

TEST_F(HeldValues, A_lease_is_prolonged_by_its_owner_only) {
  const auto soon = [this] { return sut_->now() + std::chrono::seconds(100); };
  const std::vector<HeldValue> mine{value("part", "{x: 1, z: 2}")};
  const rt::MonoTime first = soon();
  ASSERT_TRUE(hold(*sut_, mine, first).ok());
  const rt::MonoTime second = first + std::chrono::seconds(1);
  ASSERT_TRUE(prolong(*sut_, mine, first, second).ok());
  EXPECT_EQ(sut_->forces()[0].until, second);
  EXPECT_EQ(prolong(*sut_, mine, first, second).error().code, Errc::NotFound) << "that is not its end any more";
  ASSERT_TRUE(hold(*sut_, std::vector<HeldValue>{value("part", "{x: 7}")}, kForever).ok()) << "another user";
  EXPECT_EQ(prolong(*sut_, mine, second, soon()).error().code, Errc::NotFound);
  EXPECT_EQ(now("part").find("{x: 7"), 0U);
  EXPECT_EQ(release(*sut_, mine, second).error().code, Errc::NotFound);
  for (const Force& force : sut_->forces()) {
    EXPECT_TRUE(force.until == kForever || force.offset == 32);
  }
  const rt::MonoTime past = sut_->now() - std::chrono::milliseconds(1);
  ASSERT_TRUE(sut_->force(*mine[0].variable, 32, test::bytes_of<std::int16_t>(2), past).ok());
  EXPECT_EQ(sut_->prolong(*mine[0].variable, 32, past, soon()).error().code, Errc::NotFound) << "it is over";
}

TEST_F(HeldValues, Notes_are_those_of_the_force) {
  auto custody = Custody::create(node_.name());
  ASSERT_TRUE(custody.ok());
  const DirectoryEntry& many = *sut_->find(hash("many"));
  // More than there is room for: those of what is not forced any more go.
  std::mt19937 random(1);
  std::map<std::uint32_t, std::string> expected;
  for (int round = 0; round < 500; ++round) {
    const std::uint32_t offset = static_cast<std::uint32_t>(random() % 20) * 40;
    if (expected.contains(offset) && random() % 2 == 0) {
      ASSERT_TRUE(sut_->release(many, offset).ok());
      expected.erase(offset);
      continue;
    }
    ForceNote note;
    note.who = "anna" + std::to_string(round);
    note.reason = std::string(300, 'r');
    note.lease = round % 2 == 0;
    ASSERT_TRUE(custody->hold(*sut_, number_at(many, offset), kForever, note).ok());
    expected[offset] = note.who;
    for (const auto& [where, who] : expected) {
      const auto known = custody->note_of(many, where);
      ASSERT_TRUE(known.has_value());
      EXPECT_EQ(known->who, who);
      EXPECT_EQ(known->reason.size(), 159U);
    }
  }
}

// A reader at any moment.
TEST_F(HeldValues, No_force_is_seen_without_its_note) {
  auto custody = Custody::create(node_.name());
  ASSERT_TRUE(custody.ok());
  const DirectoryEntry& many = *sut_->find(hash("many"));
  std::atomic<bool> done = false;
  std::atomic<std::size_t> seen = 0;
  std::size_t bare = 0;
  std::thread looker([&] {
    const auto view = Custody::open(node_.name(), Mode::ReadOnly);
    while (!done) {
      for (const Force& force : sut_->forces()) {
        ++seen;
        const std::vector<Force> later = view->note_of(many, force.offset) ? std::vector<Force>() : sut_->forces();
        bare += static_cast<std::size_t>(std::count_if(later.begin(), later.end(), [&](const Force& one) {
          return one.offset == force.offset && one.until == force.until;
        }));
      }
    }
  });
  ForceNote note;
  note.who = "anna";
  for (std::uint32_t i = 0; i < 2000 || seen < 1000; ++i) {
    const std::uint32_t offset = i % 20 * 40;
    // Each has another end, by which it is known again.
    const rt::MonoTime until = sut_->now() + std::chrono::hours(1) + std::chrono::seconds(i);
    EXPECT_TRUE(hold(node_.name(), *sut_, number_at(many, offset), until, note).ok());
    if (i % 3 == 0) {
      EXPECT_TRUE(sut_->release(many, offset).ok());
    }
  }
  done = true;
  looker.join();
  EXPECT_EQ(bare, 0U);
}

TEST_F(HeldValues, Notes_stay_as_they_were_if_nothing_is_held) {
  auto custody = Custody::create(node_.name());
  ASSERT_TRUE(custody.ok());
  const DirectoryEntry& many = *sut_->find(hash("many"));
  ForceNote note;
  note.who = "anna";
  ASSERT_TRUE(custody->hold(*sut_, number_at(many, 40), kForever, note).ok());
  note.who = "bert";
  std::vector<HeldValue> too_many;
  for (std::uint32_t offset = 0; too_many.size() <= kMaxForces; offset += 8) {
    too_many.push_back(number_at(many, offset)[0]);
  }
  EXPECT_EQ(custody->hold(*sut_, too_many, kForever, note).error().code, Errc::NoSpace);
  EXPECT_EQ(custody->note_of(many, 40)->who, "anna");
  EXPECT_FALSE(custody->note_of(many, 0).has_value());
}

TEST_F(HeldValues, The_lock_outlives_the_run_and_says_what_it_forbids) {
  EXPECT_EQ(lock_of(node_.name()).lock, WriteLock::None) << "no node has run";
  auto custody = Custody::create(node_.name());
  LockNote note;
  note.who = "anna";
  note.lock = WriteLock::Tune;
  ASSERT_TRUE(custody->set_lock(note).ok());
  ASSERT_TRUE(Custody::create(node_.name()).ok());
  note = lock_of(node_.name());
  EXPECT_EQ(note.who, "anna");
  EXPECT_EQ(Custody::open(node_.name(), Mode::ReadOnly)->set_lock(note).error().code, Errc::PermissionDenied);
  struct Row {
    WriteLock lock;
    Act act;
    bool allowed;
  };
  for (const auto& [lock, act, allowed] : {
           Row{WriteLock::None, Act::Set, true},
           Row{WriteLock::None, Act::Force, true},
           Row{WriteLock::None, Act::Command, true},
           Row{WriteLock::Tune, Act::SetParameter, true},
           Row{WriteLock::Tune, Act::Set, false},
           Row{WriteLock::Tune, Act::Force, false},
           Row{WriteLock::Tune, Act::Command, false},
           Row{WriteLock::All, Act::SetParameter, false},
           Row{WriteLock::All, Act::Set, false},
           Row{WriteLock::All, Act::Force, false},
           Row{WriteLock::All, Act::Command, false},
       }) {
    note.lock = lock;
    EXPECT_EQ(!refusal(note, act).has_value(), allowed) << word_of(lock) << " " << static_cast<int>(act);
  }
}

}  // namespace
}  // namespace indurop::vars
