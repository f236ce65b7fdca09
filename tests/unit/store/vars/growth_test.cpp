// SPDX-License-Identifier: Apache-2.0
// A store grows while its node runs.

#include "store/vars/growth.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "store/vars/snapshot.h"
#include "store/vars/store.h"
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

schema::Variable a_number(const std::string& name, std::int32_t initial = 0) {
  schema::Variable made = variable(name, scalar_type(schema::Base::Int32));
  made.initial = bytes_of(initial);
  return made;
}

schema::Variable some_words(const std::string& name, std::uint32_t count) {
  return variable(name, array_type(schema::Base::UInt64, count));
}

schema::Schema two_variables() {
  schema::Schema schema;
  schema.variables = {a_number("a::one", 1), some_words("a::many", 3)};
  return schema;
}

template <class T>
Result<T> value_of(const Store& store, const std::string& name, std::uint32_t offset = 0) {
  const DirectoryEntry* entry = store.find(hash(name));
  if (entry == nullptr) {
    return Error{Errc::NotFound, 0, "variable"};
  }
  std::uint8_t bytes[sizeof(T)] = {};
  if (const Status read = store.read(*entry, offset, bytes); !read) {
    return read.error();
  }
  T value{};
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
void set_value(Store& store, const std::string& name, T value, std::uint32_t offset = 0) {
  ASSERT_TRUE(store.write(*store.find(hash(name)), offset, bytes_of(value)).ok());
}

void grow(Store& store, const std::vector<schema::Variable>& variables) {
  ASSERT_TRUE(store.reserve(variables).ok());
  auto next = store.prepare(variables);
  ASSERT_TRUE(next.ok()) << next.error().where;
  store.announce(std::move(next).value());
}

std::size_t file_size_of(const TestNode& node) {
  struct stat info {};
  EXPECT_EQ(::stat(node.path().c_str(), &info), 0);
  return static_cast<std::size_t>(info.st_size);
}

class GrowingStore : public ::testing::Test {
 protected:
  Store attached(Mode mode = Mode::ReadOnly) { return std::move(Store::attach(node_.name(), mode)).value(); }

  const TestNode node_{"grow"};
  Store sut_ = std::move(Store::create(node_.name(), two_variables())).value();
};

TEST_F(GrowingStore, A_new_variable_is_there_with_its_initial_value_for_all_who_look_again) {
  const Store before = attached();
  set_value<std::int32_t>(sut_, "a::one", 5);
  grow(sut_, {a_number("b::late", 42), some_words("a::late", 2000)});
  EXPECT_TRUE(before.grown());
  EXPECT_FALSE(before.retired());
  EXPECT_EQ(before.find(hash("b::late")), nullptr);
  EXPECT_EQ(value_of<std::int32_t>(before, "a::one").value(), 5) << "what was found stays usable";
  Store after = attached(Mode::ReadWrite);
  EXPECT_FALSE(after.grown());
  EXPECT_EQ(value_of<std::int32_t>(after, "b::late").value(), 42);
  EXPECT_EQ(value_of<std::uint64_t>(after, "a::late", 1999 * 8).value(), 0U);
  set_value<std::int32_t>(after, "b::late", 43);
  EXPECT_EQ(value_of<std::int32_t>(sut_, "b::late").value(), 43);
  EXPECT_EQ(after.schema().variables.size(), 4U);
  EXPECT_EQ(after.layout_hash(), sut_.layout_hash());
  EXPECT_NE(after.layout_hash(), before.layout_hash());
}

TEST_F(GrowingStore, Indices_in_the_directory_and_places_stay) {
  const Store before = attached();
  grow(sut_, {a_number("a::a"), a_number("z::z")});
  const Store after = attached();
  for (std::size_t i = 0; i < before.directory().size(); ++i) {
    EXPECT_EQ(before.directory()[i].name_hash, after.directory()[i].name_hash);
    EXPECT_EQ(before.directory()[i].offset, after.directory()[i].offset);
  }
  EXPECT_GE(after.find(hash("a::a"))->offset, before.header().total_size);
}

TEST_F(GrowingStore, What_is_only_reserved_is_seen_by_no_one) {
  const std::vector<schema::Variable> late{a_number("b::late", 42)};
  ASSERT_TRUE(sut_.reserve(late).ok());
  auto* const place = static_cast<std::int32_t*>(sut_.place(hash("b::late"), late[0].type_hash));
  ASSERT_NE(place, nullptr);
  *place = 7;  // as static objects of a version that is loaded and rejected
  EXPECT_EQ(sut_.find(hash("b::late")), nullptr);
  EXPECT_EQ(attached().find(hash("b::late")), nullptr);
  EXPECT_FALSE(attached().grown());
  grow(sut_, late);
  EXPECT_EQ(value_of<std::int32_t>(attached(), "b::late").value(), 42);
  EXPECT_EQ(sut_.place(hash("b::late"), late[0].type_hash), place);
}

TEST_F(GrowingStore, Values_of_the_new_variables_can_be_forced_and_read_together) {
  grow(sut_, {a_number("b::late", 42)});
  const Store other = attached();
  ASSERT_TRUE(sut_.force(*sut_.find(hash("b::late")), 0, bytes_of<std::int32_t>(9), kForever).ok());
  set_value<std::int32_t>(sut_, "b::late", 1);
  std::uint8_t late[4] = {};
  std::uint8_t many[24] = {};
  const PartToRead parts[] = {{other.find(hash("b::late")), 0, late}, {other.find(hash("a::many")), 0, many}};
  ASSERT_TRUE(read_snapshot(other, parts).ok());
  EXPECT_EQ(late[0], 9);
  ASSERT_EQ(other.forces().size(), 1U);
}

TEST_F(GrowingStore, A_changed_type_has_another_place_and_readers_of_the_former_one_get_an_error) {
  Store before = attached(Mode::ReadWrite);
  set_value<std::int32_t>(sut_, "a::one", 5);
  grow(sut_, {some_words("a::one", 2)});
  const DirectoryEntry& former = *before.find(hash("a::one"));
  std::uint8_t bytes[4] = {};
  EXPECT_EQ(before.read(former, 0, bytes).error().code, Errc::TypeMismatch);
  EXPECT_EQ(before.write(former, 0, bytes).error().code, Errc::TypeMismatch);
  EXPECT_EQ(before.force(former, 0, bytes, kForever).error().code, Errc::TypeMismatch);
  EXPECT_TRUE(before.forces().empty());
  const PartToRead part{&former, 0, bytes};
  EXPECT_EQ(read_snapshot(before, {&part, 1}).error().code, Errc::TypeMismatch);
  EXPECT_EQ(sut_.read(former, 0, bytes).error().code, Errc::TypeMismatch)
      << "in the node, by who has a copy of the entry";
  const Store after = attached();
  EXPECT_EQ(value_of<std::uint64_t>(after, "a::one", 8).value(), 0U);
  EXPECT_EQ(value_of<std::int32_t>(after, "a::one_before").value(), 5) << "it stays readable under another name";
  grow(sut_, {a_number("a::one")});
  EXPECT_EQ(value_of<std::int32_t>(attached(), "a::one").value(), 5) << "back at its former place";
  EXPECT_EQ(value_of<std::uint64_t>(attached(), "a::one_before", 8).value(), 0U);
  EXPECT_TRUE(before.read(former, 0, bytes).ok());
}

TEST_F(GrowingStore, Without_room_nothing_changes) {
  const std::size_t size = file_size_of(node_);
  const std::vector<schema::Variable> large{a_number("b::small"), some_words("b::large", (kGrowthRoom / 32) + 1)};
  EXPECT_EQ(sut_.reserve(large).error().code, Errc::NoSpace);
  EXPECT_FALSE(attached().grown());
  grow(sut_, {a_number("b::small", 3)});
  EXPECT_EQ(value_of<std::int32_t>(attached(), "b::small").value(), 3);
  EXPECT_LT(file_size_of(node_), size + 64 * 1024);
}

TEST_F(GrowingStore, Without_memory_nothing_changes) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{file_size_of(node_), file_size_of(node_)};  // what a full /dev/shm is to a file
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::vector<schema::Variable> late{some_words("b::late", 5000)};
    const bool refused = !sut_.reserve(late).ok() && sut_.place(hash("b::late"), late[0].type_hash) == nullptr;
    ::_exit(refused ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(value_of<std::int32_t>(attached(), "a::one").value(), 1);
}

TEST_F(GrowingStore, Without_its_file_name_it_does_not_grow) {
  ASSERT_EQ(::unlink(node_.path().c_str()), 0);
  const std::vector<schema::Variable> late{some_words("b::late", 5000)};
  EXPECT_EQ(sut_.reserve(late).error().code, Errc::NotFound);
  EXPECT_EQ(value_of<std::int32_t>(sut_, "a::one").value(), 1);
}

// Whatever the node did when it was killed, the next one starts with all values, and so do those that attach meanwhile.
TEST_F(GrowingStore, A_node_that_is_killed_in_any_phase_leaves_a_whole_store) {
  set_value<std::int32_t>(sut_, "a::one", 5);
  const std::vector<schema::Variable> late{a_number("b::late", 42), some_words("a::many", 5)};
  for (int phase = 0; phase < 6; ++phase) {
    const pid_t child = ::fork();
    if (child == 0) {
      if (phase > 0) {
        (void)sut_.reserve(late);
      }
      if (phase > 1) {
        auto next = sut_.prepare(late);
        for (std::size_t i = 0; i < next->words.size() && i + 2 < static_cast<std::size_t>(phase); ++i) {
          next->words[i].to->store(next->words[i].value);
        }
      }
      ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(value_of<std::int32_t>(attached(), "a::one").value(), 5) << phase;
    schema::Schema started = two_variables();
    if (phase % 2 == 1) {
      started.variables[1] = late[1];
      started.variables.push_back(late[0]);
    }
    {
      auto next = Store::create(node_.name(), started);
      ASSERT_TRUE(next.ok()) << phase;
      EXPECT_EQ(value_of<std::int32_t>(*next, "a::one").value(), 5) << phase;
      EXPECT_TRUE(value_of<std::uint64_t>(*next, "a::many").ok()) << phase;
    }
    sut_ = std::move(Store::create(node_.name(), two_variables())).value();
    EXPECT_EQ(value_of<std::int32_t>(sut_, "a::one").value(), 5) << phase;
    EXPECT_TRUE(value_of<std::uint64_t>(sut_, "a::many").ok()) << phase;
  }
}

// The oracle knows only which declarations came in which order.
TEST_F(GrowingStore, Random_growths_are_what_an_oracle_says) {
  std::mt19937 random(20);
  struct Known {
    std::uint32_t count;
    std::map<std::uint32_t, std::uint64_t> values;  // by number of words, that each place has last had
  };
  std::map<std::string, Known> oracle;
  for (int round = 0; round < 300; ++round) {
    std::vector<schema::Variable> declared;
    for (int i = 0; i < 3; ++i) {
      const std::string name = "v::x" + std::to_string(random() % 40);
      const auto count = static_cast<std::uint32_t>(1 + random() % 4);
      if (std::none_of(declared.begin(), declared.end(), [&](const auto& one) { return one.name == name; })) {
        declared.push_back(some_words(name, count));
        Known& known = oracle[name];
        known.count = count;
        known.values.try_emplace(count, 0);
      }
    }
    grow(sut_, declared);
    Store look = attached(Mode::ReadWrite);
    for (auto& [name, known] : oracle) {
      const DirectoryEntry* const entry = look.find(hash(name));
      ASSERT_NE(entry, nullptr);
      ASSERT_EQ(entry->value_size, known.count * 8);
      ASSERT_EQ(value_of<std::uint64_t>(look, name).value(), known.values[known.count]) << name;
      known.values[known.count] = random();
      set_value<std::uint64_t>(look, name, known.values[known.count]);
    }
  }
}

// A value is stamped with the number of the growth before which it was written; a reader that begins after a growth was
// announced must not see an older one, nor half of two.
TEST_F(GrowingStore, Readers_see_no_torn_or_old_value_in_a_thousand_growths_and_memory_is_flat) {
  constexpr std::uint64_t kGrowths = 1000;
  grow(sut_, {some_words("v::x", 4)});
  grow(sut_, {some_words("v::x", 6)});
  std::atomic<std::uint64_t> announced{0};
  std::atomic<std::uint64_t> reads{0};
  std::atomic<std::uint64_t> wrong{0};
  std::atomic<bool> done{false};
  const auto read_on = [&](Mode mode) {
    Store look = attached(mode);
    std::uint64_t follows = 0;
    while (!done.load() || follows == 0) {
      const std::uint64_t least = announced.load();
      const DirectoryEntry& entry = *look.find(hash("v::x"));
      std::vector<std::uint64_t> value(entry.value_size / 8);
      const Status read =
          look.read(entry, 0, {reinterpret_cast<std::uint8_t*>(value.data()), value.size() * sizeof(std::uint64_t)});
      if (read) {
        const bool torn = std::any_of(value.begin(), value.end(), [&](std::uint64_t word) { return word != value[0]; });
        wrong += torn || value[0] < least ? 1U : 0U;
        ++reads;
      } else if (read.error().code != Errc::TypeMismatch) {
        ++wrong;
      }
      if (look.grown()) {
        if (auto again = Store::attach(node_.name(), mode); again) {
          look = std::move(again).value();
          ++follows;
        }
      }
    }
  };
  std::thread reader(read_on, Mode::ReadOnly);
  std::thread other(read_on, Mode::ReadWrite);
  const std::size_t size = file_size_of(node_);
  for (std::uint64_t i = 1; i <= kGrowths; ++i) {
    const std::uint32_t count = i % 2 == 0 ? 6 : 4;
    const std::vector<schema::Variable> next{some_words("v::x", count)};
    ASSERT_TRUE(sut_.reserve(next).ok());
    const std::vector<std::uint64_t> value(count, i);
    auto* const ring = static_cast<abi::RingHeader*>(sut_.place(hash("v::x"), next[0].type_hash));
    auto* const slot = begin_write(*ring, 0, count * 8);
    ASSERT_NE(slot, nullptr);
    std::memcpy(slot, value.data(), value.size() * 8);
    commit(*ring);
    auto prepared = sut_.prepare(next);
    ASSERT_TRUE(prepared.ok());
    sut_.announce(std::move(prepared).value());
    announced.store(i);
  }
  done = true;
  reader.join();
  other.join();
  EXPECT_EQ(wrong.load(), 0U);
  EXPECT_GT(reads.load(), kGrowths);
  EXPECT_EQ(file_size_of(node_), size);
}

}  // namespace
}  // namespace indurop::vars
