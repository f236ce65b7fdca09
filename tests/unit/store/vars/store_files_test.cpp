// SPDX-License-Identifier: Apache-2.0
// What the store does about files it did not expect: damaged, foreign, forbidden, too large.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "store/vars/node_lock.h"
#include "store/vars/store.h"
#include "test_schema.h"
#include "tests/support/forked.h"
#include "tests/support/unprivileged.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

schema::Schema small_schema() {
  schema::Schema schema;
  schema.variables.push_back(variable("a::tick", scalar_type(schema::Base::UInt32)));
  schema.variables.push_back(variable("a::joints", array_type(schema::Base::Double, 30)));
  return schema;
}

Errc attach_code(const std::string& node, Mode mode) {
  const auto store = Store::attach(node, mode);
  return store.ok() ? Errc::Ok : store.error().code;
}

bool exists(const std::string& file) {
  return std::filesystem::exists(std::filesystem::symlink_status(std::string(kShmDirectory) + "/" + file));
}

void overwrite(const std::string& path, std::size_t offset, const std::vector<std::uint8_t>& bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_EQ(::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset)), static_cast<ssize_t>(bytes.size()));
  ::close(file);
}

TEST(StoreFiles, Missing_block_is_not_found) {
  EXPECT_EQ(attach_code("t-missing", Mode::ReadOnly), Errc::NotFound);
}

TEST(StoreFiles, Node_names_that_are_paths_are_refused) {
  for (const std::string name :
       {"", "..", "a/b", "a.b", "a b", "\xC3\xA4", "x23456789012345678901234567890123456789ab"}) {
    EXPECT_EQ(attach_code(name, Mode::ReadOnly), Errc::InvalidArgument) << name;
    EXPECT_EQ(Store::create(name, small_schema()).error().code, Errc::InvalidArgument) << name;
    EXPECT_EQ(remove_node(name).error().code, Errc::InvalidArgument) << name;
  }
}

TEST(StoreFiles, Empty_file_of_a_killed_creator_is_corrupt_and_replaced) {
  const TestNode node("empty");
  std::ofstream(node.path()).close();
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::Corrupt);
  const auto sut = Store::create(node.name(), small_schema());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::Fresh);
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::Ok);
}

TEST(StoreFiles, Foreign_contents_are_corrupt_and_replaced) {
  const TestNode node("foreign");
  std::ofstream(node.path()) << std::string(10'000, 'x');
  EXPECT_EQ(attach_code(node.name(), Mode::ReadOnly), Errc::Corrupt);
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Fresh);
}

TEST(StoreFiles, Truncated_block_is_corrupt_and_replaced) {
  const TestNode node("truncated");
  ASSERT_TRUE(Store::create(node.name(), small_schema()).ok());
  const auto size = std::filesystem::file_size(node.path());
  for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{64}, std::uintmax_t{1}}) {
    std::filesystem::resize_file(node.path(), left);
    EXPECT_EQ(attach_code(node.name(), Mode::ReadOnly), Errc::Corrupt) << left;
  }
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Fresh);
}

TEST(StoreFiles, A_block_of_another_version_is_reported_and_replaced) {
  const TestNode node("version");
  ASSERT_TRUE(Store::create(node.name(), small_schema()).ok());
  overwrite(node.path(), offsetof(BlockHeader, abi), bytes_of<std::uint32_t>(abi::kVersion + 1));
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::VersionMismatch);
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Fresh);
}

TEST(StoreFiles, Block_with_an_unusable_lock_is_replaced_and_its_values_kept) {
  const TestNode node("lock");
  std::uint64_t offset = 0;
  {
    auto store = Store::create(node.name(), small_schema());
    ASSERT_TRUE(store.ok());
    const DirectoryEntry& joints = *store->find(hash("a::joints"));
    offset = joints.offset + offsetof(abi::RingHeader, lock);
    ASSERT_TRUE(store->write(joints, 0, bytes_of(2.5)).ok());
  }
  overwrite(node.path(), offset, bytes_of<std::uint32_t>(0x3FFFFFF0));
  auto client = Store::attach(node.name(), Mode::ReadWrite);
  ASSERT_TRUE(client.ok());
  const auto sut = Store::create(node.name(), small_schema());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::CarriedOver);
  EXPECT_TRUE(client->retired());
  std::vector<std::uint8_t> value(8);
  ASSERT_TRUE(sut->read(*sut->find(hash("a::joints")), 0, value).ok());
  EXPECT_EQ(value, bytes_of(2.5));
}

TEST(StoreFiles, Unfinished_file_of_a_killed_creator_is_in_nobodys_way) {
  const TestNode node("tmp");
  std::ofstream(node.path() + ".tmp") << "half";
  EXPECT_TRUE(Store::create(node.name(), small_schema()).ok());
  EXPECT_FALSE(exists(block_file(node.name()) + ".tmp"));
}

TEST(StoreFiles, Unfinished_file_is_removed_when_the_block_is_adopted) {
  const TestNode node("tmp2");
  ASSERT_TRUE(Store::create(node.name(), small_schema()).ok());
  std::ofstream(node.path() + ".tmp") << "half";
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Adopted);
  EXPECT_FALSE(exists(block_file(node.name()) + ".tmp"));
}

TEST(StoreFiles, Retired_block_without_a_successor_is_used_again) {
  const TestNode node("retired");
  ASSERT_TRUE(Store::create(node.name(), small_schema()).ok());
  overwrite(node.path(), offsetof(BlockHeader, state), bytes_of(BlockState::Retired));
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::Busy);
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Adopted);
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::Ok);
}

TEST(StoreFiles, Symbolic_links_are_not_followed) {
  const TestNode node("link");
  const TestNode target("target");
  ASSERT_TRUE(Store::create(target.name(), small_schema()).ok());
  std::filesystem::create_symlink(target.path(), node.path());
  EXPECT_EQ(attach_code(node.name(), Mode::ReadOnly), Errc::PermissionDenied);
  EXPECT_EQ(Store::create(node.name(), small_schema()).error().code, Errc::PermissionDenied);
}

TEST(StoreFiles, What_is_not_a_file_is_corrupt) {
  const TestNode node("fifo");
  ASSERT_EQ(::mkfifo(node.path().c_str(), 0600), 0);
  EXPECT_EQ(attach_code(node.name(), Mode::ReadOnly), Errc::Corrupt);
  EXPECT_EQ(Store::create(node.name(), small_schema())->origin(), Origin::Fresh);
}

TEST(StoreFiles, Full_memory_is_an_error_and_leaves_nothing) {
  const TestNode node("full");
  schema::Schema huge = small_schema();
  for (int i = 0; i < 2000; ++i) {
    huge.variables.push_back(variable("a::huge" + std::to_string(i), array_type(schema::Base::Char, 4'000'000'000U)));
  }
  const auto sut = Store::create(node.name(), huge);
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().code, Errc::NoSpace);
  EXPECT_FALSE(exists(block_file(node.name())));
  EXPECT_FALSE(exists(block_file(node.name()) + ".tmp"));
}

TEST(StoreFiles, Full_memory_keeps_the_older_block_in_use) {
  const TestNode node("full2");
  auto older = Store::create(node.name(), small_schema());
  ASSERT_TRUE(older.ok());
  Forked other([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    schema::Schema changed = small_schema();
    changed.variables.pop_back();
    const auto sut = Store::create(node.name(), changed);
    return !sut.ok() && sut.error().code == Errc::NoSpace ? 0 : 1;
  });
  EXPECT_EQ(other.wait(), 0);
  EXPECT_FALSE(older->retired());
  EXPECT_EQ(attach_code(node.name(), Mode::ReadWrite), Errc::Ok);
  EXPECT_FALSE(exists(block_file(node.name()) + ".tmp"));
}

TEST(StoreFiles, Rights_do_not_depend_on_the_umask) {
  const TestNode node("umask");
  const mode_t before = ::umask(077);
  ASSERT_TRUE(Store::create(node.name(), small_schema()).ok());
  EXPECT_EQ(::umask(before), 077U) << "the process's umask must be as it was";
  struct stat info {};
  ASSERT_EQ(::stat(node.path().c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777U, kShmMode);
}

TEST(StoreFiles, Another_user_reads_but_may_not_write_create_or_remove) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  const TestNode node("user");
  const auto store = Store::create(node.name(), small_schema());
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node.name(), holder);
  ASSERT_TRUE(store.ok() && lock.ok());
  Forked other([&] {
    if (!indurop::test::become_unprivileged() || attach_code(node.name(), Mode::ReadOnly) != Errc::Ok) {
      return 1;
    }
    if (attach_code(node.name(), Mode::ReadWrite) != Errc::PermissionDenied) {
      return 2;
    }
    schema::Schema changed = small_schema();
    changed.variables.pop_back();
    if (Store::create(node.name(), changed).error().code != Errc::PermissionDenied) {
      return 3;
    }
    pid_t seen = 0;
    if (NodeLock::acquire(node.name(), seen).error().code != Errc::PermissionDenied) {
      return 4;
    }
    if (remove_node(node.name()).error().code != Errc::PermissionDenied) {
      return 5;
    }
    return running_node(node.name()) == ::getppid() ? 0 : 6;
  });
  EXPECT_EQ(other.wait(), 0);
}

TEST(StoreFiles, Block_planted_by_another_user_is_not_adopted) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  const TestNode node("planted");
  Forked other([&] {
    if (!indurop::test::become_unprivileged()) {
      return 1;
    }
    auto store = Store::create(node.name(), small_schema());
    return store.ok() && store->write(*store->find(hash("a::tick")), 0, bytes_of<std::uint32_t>(666)).ok() ? 0 : 2;
  });
  ASSERT_EQ(other.wait(), 0);
  const auto sut = Store::create(node.name(), small_schema());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::Fresh);
}

TEST(StoreFiles, Last_heartbeats_are_reported_without_the_store) {
  const TestNode node("beat");
  EXPECT_EQ(last_beat(node.name()).error().code, Errc::NotFound);
  auto sut = Store::create(node.name(), small_schema());
  ASSERT_TRUE(sut.ok());
  const auto made = last_beat(node.name());
  ASSERT_TRUE(made.ok()) << "a node signs in with its first";
  EXPECT_LE(rt::MonoClock::now() - *made, std::chrono::hours{1});
  const auto time = rt::mono_time(123456789);
  sut->beat(time);
  EXPECT_EQ(last_beat(node.name()).value(), time);
}

TEST(StoreFiles, Nodes_are_listed_and_removed) {
  const TestNode one("list-a");
  const TestNode two("list-b");
  ASSERT_TRUE(Store::create(one.name(), small_schema()).ok());
  ASSERT_TRUE(Store::create(two.name(), small_schema()).ok());
  EXPECT_THAT(list_nodes(), testing::IsSupersetOf({one.name(), two.name()}));
  auto client = Store::attach(one.name(), Mode::ReadWrite);
  ASSERT_TRUE(client.ok());
  EXPECT_TRUE(remove_node(one.name()).ok());
  EXPECT_TRUE(client->retired());
  EXPECT_THAT(list_nodes(), testing::Not(testing::Contains(one.name())));
  EXPECT_FALSE(exists(lock_file(one.name())));
  EXPECT_TRUE(remove_node(one.name()).ok()) << "nothing to remove is no error";
}

}  // namespace
}  // namespace indurop::vars
