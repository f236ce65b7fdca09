// SPDX-License-Identifier: Apache-2.0
// Blocks that other programs created, copied or cut.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "store/vars/node_lock.h"
#include "store/vars/nodes.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"
#include "test_schema.h"
#include "tests/support/forked.h"
#include "tests/support/wait_until.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::TestNode;

schema::Schema schema_of_a_few() {
  schema::Schema schema;
  for (const char* name : {"a", "b", "c"}) {
    schema::Variable variable;
    variable.name = name;
    variable.kind = abi::Kind::Ring;
    variable.type.base = schema::Base::Double;
    variable.type.element_size = 8;
    variable.type.align = 8;
    variable.type.dims = {1000};
    variable.type_hash = schema::hash_of(variable.type);
    schema.variables.push_back(variable);
  }
  return schema;
}

std::string lock_path(const TestNode& node) {
  return std::string(kShmDirectory) + "/" + lock_file(node.name());
}

TEST(Strangers, A_copied_block_does_not_run) {
  const TestNode node("genuine");
  const TestNode copy("copy");
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node.name(), holder);
  ASSERT_TRUE(lock.ok() && Store::create(node.name(), schema_of_a_few()).ok());
  std::filesystem::copy_file(node.path(), copy.path());
  EXPECT_EQ(running_node(node.name()), ::getpid());
  EXPECT_EQ(running_node(copy.name()), 0);
  std::filesystem::copy_file(lock_path(node), lock_path(copy));
  EXPECT_EQ(running_node(copy.name()), 0) << "the text of a lock is no lock";
}

TEST(Strangers, A_lock_shows_no_process_of_another_user) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "needs root to give a file away";
  }
  const TestNode node("given");
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node.name(), holder);
  ASSERT_TRUE(lock.ok());
  ASSERT_EQ(::chown(lock_path(node).c_str(), 65534, 65534), 0);
  EXPECT_EQ(running_node(node.name()), 0);
}

TEST(Strangers, A_user_without_access_to_the_lock_sees_who_runs) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  const TestNode node("closed");
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node.name(), holder);
  const auto store = Store::create(node.name(), schema_of_a_few());
  ASSERT_TRUE(lock.ok() && store.ok());
  Forked unprivileged(
      [&] { return ::setgid(65534) == 0 && ::setuid(65534) == 0 && running_node(node.name()) == ::getppid() ? 0 : 1; });
  EXPECT_EQ(unprivileged.wait(), 0);
}

TEST(Strangers, Are_listed_only_if_asked_for) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "needs root to give a file away";
  }
  const TestNode node("foreign");
  ASSERT_TRUE(Store::create(node.name(), schema_of_a_few()).ok());
  EXPECT_THAT(list_nodes(), ::testing::Contains(node.name()));
  ASSERT_EQ(::chown(node.path().c_str(), 65534, 65534), 0);
  EXPECT_THAT(list_nodes(), ::testing::Not(::testing::Contains(node.name())));
  EXPECT_THAT(list_nodes(Nodes::All), ::testing::Contains(node.name()));
  EXPECT_EQ(owner_of(node.name()), 65534U);
  ASSERT_EQ(::chown(node.path().c_str(), 65534, ::getegid()), 0);
  EXPECT_THAT(list_nodes(), ::testing::Contains(node.name())) << "one of our group";
}

TEST(Strangers, One_name_is_found_as_in_the_list_of_all) {
  const TestNode block("block");
  const TestNode bare("bare");
  const TestNode ended("ended");
  std::ofstream(block.path()) << "x";
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(bare.name(), holder);
  ASSERT_TRUE(lock.ok());
  std::ofstream(lock_path(ended)) << "1 1\n";
  for (const Nodes which : {Nodes::Near, Nodes::All}) {
    const auto all = list_nodes(which);
    for (const std::string& name : {block.name(), bare.name(), ended.name(), std::string("no_such_node"), std::string(),
                                    block.name() + ".run", std::string("../x"), bare.name() + ".lock"}) {
      EXPECT_EQ(has_node(name, which), std::find(all.begin(), all.end(), name) != all.end()) << name;
    }
  }
  EXPECT_TRUE(has_node(block.name()) && has_node(bare.name()) && !has_node(ended.name()));
  if (::geteuid() == 0) {
    ASSERT_EQ(::chown(block.path().c_str(), 12345, 12345), 0);
    EXPECT_TRUE(!has_node(block.name()) && has_node(block.name(), Nodes::All));
  }
}

TEST(Strangers, A_block_that_is_cut_is_read_without_harm_and_never_as_zeros) {
  const TestNode node("cut");
  auto made = Store::create(node.name(), schema_of_a_few());
  ASSERT_TRUE(made.ok());
  for (const Mode mode : {Mode::ReadOnly, Mode::ReadWrite}) {
    const auto sut = Store::attach(node.name(), mode);
    ASSERT_TRUE(sut.ok());
    EXPECT_EQ(sut->named(), ShmFile::Named::Whole);
    const auto size = static_cast<off_t>(std::filesystem::file_size(node.path()));
    const off_t rest = mode == Mode::ReadOnly ? size - 40'000 : 0;
    ASSERT_EQ(::truncate(node.path().c_str(), rest), 0);
    EXPECT_EQ(sut->named(), ShmFile::Named::Cut);
    bool dead = false;
    for (const DirectoryEntry& entry : sut->directory()) {
      std::vector<std::uint8_t> value(entry.value_size);
      const Status read = sut->read(entry, 0, value);
      dead = dead || read.error().code == Errc::Dead;
      EXPECT_TRUE(read.ok() || read.error().code == Errc::Dead);
    }
    EXPECT_TRUE(dead);
    EXPECT_TRUE(sut->lost());
    EXPECT_TRUE(sut->retired()) << "every reader attaches again";
    EXPECT_FALSE(Store::attach(node.name(), mode).ok());
    std::filesystem::remove(node.path());
    EXPECT_EQ(sut->named(), ShmFile::Named::Gone);
    ASSERT_TRUE(Store::create(node.name(), schema_of_a_few()).ok());
  }
}

TEST(Strangers, A_file_of_holes_is_refused_whatever_size_it_claims) {
  const TestNode node("holes");
  std::ofstream(node.path()) << "";
  ASSERT_EQ(::truncate(node.path().c_str(), off_t{1} << 40U), 0);
  EXPECT_EQ(ShmFile::open(block_file(node.name()), Mode::ReadOnly).error().code, Errc::Corrupt);
  EXPECT_EQ(ShmCopy::of(block_file(node.name())).error().code, Errc::Corrupt);
}

TEST(Strangers, Files_of_zeros_are_not_waited_for) {
  const TestNode node("zeros");
  std::ofstream(node.path()) << std::string(8192, '\0');
  rusage before{};
  rusage after{};
  ASSERT_EQ(::getrusage(RUSAGE_THREAD, &before), 0);
  constexpr int kTimes = 100;
  for (int i = 0; i < kTimes; ++i) {
    EXPECT_EQ(Store::attach(node.name(), Mode::ReadOnly).error().code, Errc::Busy);
  }
  ASSERT_EQ(::getrusage(RUSAGE_THREAD, &after), 0);
  EXPECT_LT(after.ru_nvcsw - before.ru_nvcsw, kTimes) << "it has slept";
}

TEST(Strangers, A_name_whose_files_were_removed_is_still_taken) {
  const TestNode node("removed");
  pid_t holder = 0;
  auto lock = NodeLock::acquire(node.name(), holder);
  ASSERT_TRUE(lock.ok());
  EXPECT_TRUE(lock->named(node.name()));
  std::filesystem::remove(lock_path(node));
  EXPECT_FALSE(lock->named(node.name()));
  Forked second([&] {
    pid_t seen = 0;
    const auto other = NodeLock::acquire(node.name(), seen);
    return !other.ok() && other.error().code == Errc::Busy && seen == ::getppid() ? 0 : 1;
  });
  EXPECT_EQ(second.wait(), 0);
  EXPECT_TRUE(indurop::test::wait_until([&] { return lock->make_again(node.name()); }));
  EXPECT_TRUE(lock->named(node.name()));
  EXPECT_EQ(running_node(node.name()), ::getpid());
  EXPECT_THAT(list_nodes(), ::testing::Contains(node.name())) << "it runs without a block";
}

}  // namespace
}  // namespace indurop::vars
