// SPDX-License-Identifier: Apache-2.0

#include "store/vars/retain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "store/vars/crc32c.h"
#include "test_schema.h"
#include "tests/support/forked.h"

namespace indurop::vars {
namespace {

using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

schema::Schema schema_with(schema::Base base_of_count) {
  schema::Schema schema;
  schema.variables.push_back(variable("a::count", scalar_type(base_of_count), true));
  schema.variables.push_back(variable("a::offsets", array_type(schema::Base::Double, 12), true));
  schema.variables.push_back(variable("a::scratch", scalar_type(schema::Base::UInt32)));
  return schema;
}

std::vector<std::uint8_t> contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

class Retain : public testing::Test {
 protected:
  Retain() : node_("retain"), store_(Store::create(node_.name(), schema_with(schema::Base::UInt32)).value()) {
    std::string name = std::string(kShmDirectory) + "/t-retain-XXXXXX";  // in memory: thousands of files are rewritten
    directory_ = ::mkdtemp(name.data());
  }
  ~Retain() override { std::filesystem::remove_all(directory_); }
  [[nodiscard]] std::filesystem::path a() const { return directory_ / "retain.a"; }
  [[nodiscard]] std::filesystem::path b() const { return directory_ / "retain.b"; }

  void set(std::uint32_t count) {
    EXPECT_TRUE(store_.write(*store_.find(hash("a::count")), 0, bytes_of(count)).ok());
    EXPECT_TRUE(store_.write(*store_.find(hash("a::offsets")), 16, bytes_of(count / 2.0)).ok());
    EXPECT_TRUE(store_.write(*store_.find(hash("a::scratch")), 0, bytes_of(count)).ok());
  }
  std::uint32_t get(const char* name = "a::count") {
    std::uint32_t value = 0;
    std::vector<std::uint8_t> bytes(4);
    EXPECT_TRUE(store_.read(*store_.find(hash(name)), 0, bytes).ok());
    std::memcpy(&value, bytes.data(), 4);
    return value;
  }
  // Saves value 1 and then 2: the newest copy is retain.b.
  void save_two() {
    RetainFile file(directory_);
    set(1);
    ASSERT_TRUE(file.save(store_).ok());
    set(2);
    ASSERT_TRUE(file.save(store_).ok());
    store_.reset(false);
  }
  RetainReport load() {
    auto report = RetainFile(directory_).load(store_);
    EXPECT_TRUE(report.ok());
    return report.ok() ? report.value() : RetainReport{};
  }

  TestNode node_;
  Store store_;
  std::filesystem::path directory_;
};

TEST(Crc32c, Knows_the_check_value) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc32c({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0xE3069283U);
}

TEST_F(Retain, Nothing_saved_is_no_error) {
  const RetainReport report = load();
  EXPECT_EQ(report.restored, 0U);
  EXPECT_THAT(report.notes, IsEmpty());
}

TEST_F(Retain, Saved_values_come_back_and_others_do_not) {
  save_two();
  const RetainReport report = load();
  EXPECT_EQ(report.restored, 2U);
  EXPECT_THAT(report.notes, IsEmpty());
  EXPECT_EQ(get(), 2U);
  EXPECT_EQ(get("a::scratch"), 0U);
}

TEST_F(Retain, Copies_are_written_in_turn_and_only_when_something_changed) {
  RetainFile sut(directory_);
  bool written = false;
  set(1);
  ASSERT_TRUE(sut.save(store_, &written).ok());
  EXPECT_TRUE(written);
  EXPECT_FALSE(std::filesystem::exists(b()));
  const auto first = contents(a());
  ASSERT_TRUE(sut.save(store_, &written).ok());
  EXPECT_FALSE(written);
  set(2);
  ASSERT_TRUE(sut.save(store_, &written).ok());
  EXPECT_TRUE(written);
  EXPECT_EQ(contents(a()), first);
  set(3);
  ASSERT_TRUE(RetainFile(directory_).save(store_, &written).ok()) << "another run goes on in turn";
  EXPECT_NE(contents(a()), first);
  EXPECT_EQ(load().restored, 2U);
  EXPECT_EQ(get(), 3U);
}

TEST_F(Retain, Newest_copy_cut_at_any_byte_falls_back_to_the_other) {
  save_two();
  const auto sound = contents(b());
  for (std::size_t size = 0; size < sound.size(); ++size) {
    replace(b(), {sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)});
    const RetainReport report = load();
    EXPECT_EQ(report.restored, 2U);
    EXPECT_THAT(report.notes, ElementsAre(HasSubstr("retain.b: "))) << size;
    EXPECT_EQ(get(), 1U) << size;
  }
  replace(b(), sound);
  EXPECT_THAT(load().notes, IsEmpty());
  EXPECT_EQ(get(), 2U);
}

TEST_F(Retain, Any_flipped_bit_is_noticed) {
  save_two();
  auto bytes = contents(b());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
      replace(b(), bytes);
      EXPECT_EQ(load().notes.size(), 1U) << i;
      EXPECT_EQ(get(), 1U) << i;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
    }
  }
}

TEST_F(Retain, Both_copies_damaged_means_initial_values_and_two_notes) {
  save_two();
  replace(a(), {1, 2, 3});
  replace(b(), {});
  const RetainReport report = load();
  EXPECT_EQ(report.restored, 0U);
  EXPECT_EQ(report.notes.size(), 2U);
  EXPECT_EQ(get(), 0U);
  set(9);
  ASSERT_TRUE(RetainFile(directory_).save(store_).ok());
  EXPECT_EQ(load().restored, 2U);
}

TEST_F(Retain, Damaged_copy_is_the_one_replaced) {
  save_two();
  auto bytes = contents(b());
  bytes.back() ^= 1U;
  replace(b(), bytes);
  set(5);
  ASSERT_TRUE(RetainFile(directory_).save(store_).ok());
  EXPECT_THAT(load().notes, IsEmpty());
  EXPECT_EQ(get(), 5U);
}

TEST_F(Retain, Values_of_a_changed_type_are_carried_and_losses_are_said) {
  set(70'000);
  ASSERT_TRUE(RetainFile(directory_).save(store_).ok());
  schema::Schema changed = schema_with(schema::Base::Int64);
  changed.variables[1] = variable("a::offsets", array_type(schema::Base::Float, 3), true);
  const TestNode other("retain2");
  auto wider = Store::create(other.name(), changed);
  ASSERT_TRUE(wider.ok());
  RetainFile sut(directory_);
  const auto report = sut.load(*wider);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->restored, 2U);
  const std::string kept = (directory_ / "retain.before.1").string();
  EXPECT_THAT(report->lost, ElementsAre("a::offsets: had 12 elements, has 3; 3 are kept from the first on",
                                        "the previous values are kept in " + kept));
  EXPECT_EQ(sut.last_report(), report->lost) << "for those who look later";
  EXPECT_EQ(contents(kept), contents(a()));
  std::vector<std::uint8_t> value(8);
  ASSERT_TRUE(wider->read(*wider->find(hash("a::count")), 0, value).ok());
  EXPECT_EQ(value, bytes_of(std::int64_t{70'000}));
  ASSERT_TRUE(sut.save(*wider).ok());
  auto again = RetainFile(directory_).load(*wider);
  ASSERT_TRUE(again.ok());
  EXPECT_THAT(again->lost, IsEmpty());
  EXPECT_THAT(sut.last_report(), IsEmpty()) << "of the last start only";
  EXPECT_TRUE(std::filesystem::exists(kept));
}

TEST_F(Retain, Of_a_store_with_newer_values_only_those_of_another_type_are_loaded) {
  save_two();
  schema::Schema changed = schema_with(schema::Base::UInt32);
  changed.variables[1] = variable("a::offsets", array_type(schema::Base::Double, 20), true);
  const TestNode other("retain4");
  auto carried = Store::create(other.name(), changed);
  ASSERT_TRUE(carried.ok());
  ASSERT_TRUE(carried->write(*carried->find(hash("a::count")), 0, bytes_of(std::uint32_t{9})).ok());
  ASSERT_TRUE(RetainFile(directory_).load(*carried, true).ok());
  std::vector<std::uint8_t> count(4);
  std::vector<std::uint8_t> offset(8);
  ASSERT_TRUE(carried->read(*carried->find(hash("a::count")), 0, count).ok());
  ASSERT_TRUE(carried->read(*carried->find(hash("a::offsets")), 16, offset).ok());
  EXPECT_EQ(count, bytes_of(std::uint32_t{9}));
  EXPECT_EQ(offset, bytes_of(1.0));
}

TEST_F(Retain, Values_of_variables_that_are_gone_are_kept_and_named) {
  save_two();
  schema::Schema changed = schema_with(schema::Base::UInt32);
  changed.variables[1].retain = false;
  changed.variables[0].unit = "mm";
  const TestNode other("retain2");
  auto store = Store::create(other.name(), changed);
  ASSERT_TRUE(store.ok());
  const auto report = RetainFile(directory_).load(*store);
  ASSERT_TRUE(report.ok());
  EXPECT_THAT(report->lost, ElementsAre(HasSubstr("a::count: its unit was '', is 'mm', starts with its initial value"),
                                        HasSubstr("retain.before.2")));
  EXPECT_THAT(report->kept, ElementsAre("a::offsets")) << "declared, but not retain";
  schema::Schema less = schema_with(schema::Base::UInt32);
  less.variables.erase(less.variables.begin() + 1);
  auto smaller = Store::create(other.name(), less);
  ASSERT_TRUE(smaller.ok());
  const auto second = RetainFile(directory_).load(*smaller);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(second->restored, 1U);
  EXPECT_THAT(second->lost, IsEmpty()) << "nothing is: it comes back when it is declared again";
  EXPECT_THAT(second->kept, ElementsAre("a::offsets"));
  EXPECT_THAT(RetainFile(directory_).last_report(),
              ElementsAre("values are kept for variables that this configuration does not declare retain: a::offsets"));
}

TEST_F(Retain, Values_of_a_project_survive_another_one_of_the_same_node) {
  save_two();
  schema::Schema other_project;
  other_project.variables.push_back(variable("b::hours", scalar_type(schema::Base::Double), true));
  for (int i = 0; i < 7; ++i) {
    other_project.variables.push_back(variable("b::n" + std::to_string(i), scalar_type(schema::Base::Int16), true));
  }
  const TestNode node("retain5");
  auto other = Store::create(node.name(), other_project);
  ASSERT_TRUE(other.ok());
  for (const double hours : {1.5, 2.5, 3.5}) {  // runs, each of which saves several times: both copies are replaced
    RetainFile sut(directory_);
    ASSERT_TRUE(sut.load(*other).ok());
    EXPECT_EQ(other->write(*other->find(hash("b::hours")), 0, bytes_of(hours)).ok(), true);
    ASSERT_TRUE(sut.save(*other).ok());
    EXPECT_EQ(other->write(*other->find(hash("b::hours")), 0, bytes_of(hours + 0.25)).ok(), true);
    bool written = false;
    ASSERT_TRUE(sut.save(*other, &written).ok());
    EXPECT_TRUE(written);
    ASSERT_TRUE(sut.save(*other, &written).ok());
    EXPECT_FALSE(written) << "nothing has changed";
  }
  const RetainReport first = load();
  EXPECT_EQ(first.restored, 2U);
  EXPECT_EQ(get(), 2U);
  EXPECT_THAT(first.lost, IsEmpty());
  EXPECT_THAT(first.kept_line(), testing::EndsWith("retain: b::hours, b::n0, b::n1, b::n2, b::n3 and 3 more"));
  ASSERT_TRUE(RetainFile(directory_).save(store_).ok());
  const auto back = RetainFile(directory_).load(*other);
  ASSERT_TRUE(back.ok());
  std::vector<std::uint8_t> hours(8);
  ASSERT_TRUE(other->read(*other->find(hash("b::hours")), 0, hours).ok());
  EXPECT_EQ(hours, bytes_of(3.75));
}

TEST_F(Retain, Kept_values_are_carried_to_another_type_when_they_are_declared_again) {
  save_two();
  const TestNode node("retain6");
  schema::Schema nothing_of_it;
  nothing_of_it.variables.push_back(variable("b::hours", scalar_type(schema::Base::Double), true));
  auto other = Store::create(node.name(), nothing_of_it);
  ASSERT_TRUE(other.ok());
  ASSERT_TRUE(RetainFile(directory_).save(*other).ok());
  auto wider = Store::create(TestNode("retain7").name(), schema_with(schema::Base::Int64));
  ASSERT_TRUE(wider.ok());
  const auto report = RetainFile(directory_).load(*wider);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->restored, 2U);
  std::vector<std::uint8_t> value(8);
  ASSERT_TRUE(wider->read(*wider->find(hash("a::count")), 0, value).ok());
  EXPECT_EQ(value, bytes_of(std::int64_t{2}));
}

TEST_F(Retain, Files_without_types_are_read) {
  save_two();
  auto bytes = contents(b());
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 32, sizeof length);
  bytes.erase(bytes.begin() + 32, bytes.begin() + 36 + length);
  bytes[8] = 1;  // the version
  const std::uint64_t payload = bytes.size() - 32;
  std::memcpy(bytes.data() + 24, &payload, sizeof payload);
  const std::uint32_t checksum = crc32c(std::span(bytes).subspan(16));
  std::memcpy(bytes.data() + 12, &checksum, sizeof checksum);
  replace(b(), bytes);
  const RetainReport report = load();
  EXPECT_EQ(report.restored, 2U);
  EXPECT_THAT(report.notes, IsEmpty());
  EXPECT_EQ(get(), 2U);
}

TEST_F(Retain, Full_disk_is_an_error_that_keeps_both_copies) {
  save_two();
  const auto before_a = contents(a());
  const auto before_b = contents(b());
  set(3);
  indurop::test::Forked child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100, 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const Status status = RetainFile(directory_).save(store_);
    return !status.ok() && status.error().code == Errc::NoSpace ? 0 : 1;
  });
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(contents(a()), before_a);
  EXPECT_EQ(contents(b()), before_b);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 2);
}

TEST_F(Retain, Directory_that_cannot_be_made_is_an_error) {
  std::ofstream(directory_ / "file") << "x";
  set(1);
  EXPECT_FALSE(RetainFile(directory_ / "file" / "node").save(store_).ok());
}

TEST_F(Retain, Erased_values_do_not_come_back) {
  save_two();
  RetainFile sut(directory_);
  ASSERT_TRUE(sut.erase().ok());
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
  EXPECT_EQ(load().restored, 0U);
  EXPECT_TRUE(RetainFile(directory_ / "never").erase().ok());
}

TEST_F(Retain, Nothing_to_retain_writes_no_file) {
  const TestNode other("retain3");
  auto store = Store::create(other.name(), schema::Schema{});
  ASSERT_TRUE(store.ok());
  EXPECT_TRUE(RetainFile(directory_).save(*store).ok());
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST(StateDirectory, Follows_the_environment) {
  ::setenv("INDUROP_STATE_DIR", "/tmp/somewhere", 1);
  EXPECT_EQ(state_directory("cell"), "/tmp/somewhere/cell");
  ::unsetenv("INDUROP_STATE_DIR");
  if (::geteuid() == 0) {
    EXPECT_EQ(state_directory("cell"), "/var/lib/indurop/cell");
    return;
  }
  ::setenv("XDG_STATE_HOME", "/tmp/state", 1);
  EXPECT_EQ(state_directory("cell"), "/tmp/state/indurop/cell");
  ::unsetenv("XDG_STATE_HOME");
  ::setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(state_directory("cell"), "/home/someone/.local/state/indurop/cell");
}

}  // namespace
}  // namespace indurop::vars
