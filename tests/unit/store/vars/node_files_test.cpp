// SPDX-License-Identifier: Apache-2.0
// The node's lock and the file of a run.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <atomic>
#include <filesystem>

#include "store/vars/node_lock.h"
#include "store/vars/process.h"
#include "store/vars/run_file.h"
#include "test_schema.h"
#include "tests/support/forked.h"
#include "tests/support/wait_until.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::TestNode;

TEST(NodeLock, A_second_process_gets_the_name_of_the_holder) {
  const TestNode node("busy");
  pid_t holder = 0;
  const auto first = NodeLock::acquire(node.name(), holder);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(running_node(node.name()), ::getpid());
  Forked other([&] {
    pid_t seen = 0;
    const auto second = NodeLock::acquire(node.name(), seen);
    return !second.ok() && second.error().code == Errc::Busy && seen == ::getppid() ? 0 : 1;
  });
  EXPECT_EQ(other.wait(), 0);
}

TEST(NodeLock, Is_free_after_its_holder_ends) {
  const TestNode node("again");
  pid_t holder = 0;
  ASSERT_TRUE(NodeLock::acquire(node.name(), holder).ok());
  EXPECT_EQ(running_node("t-never-ran"), 0);
  EXPECT_TRUE(NodeLock::acquire(node.name(), holder).ok());
}

TEST(NodeLock, Survives_a_killed_holder) {
  const TestNode node("killed");
  Forked other([&] {
    pid_t seen = 0;
    const auto lock = NodeLock::acquire(node.name(), seen);
    while (lock.ok()) {
      ::pause();
    }
    return 1;
  });
  ASSERT_TRUE(indurop::test::wait_until([&] { return running_node(node.name()) == other.pid(); }));
  other.kill_and_wait();
  EXPECT_EQ(running_node(node.name()), 0);
  pid_t holder = 0;
  EXPECT_TRUE(NodeLock::acquire(node.name(), holder).ok());
}

TEST(NodeLock, Is_not_fooled_by_the_text_of_a_dead_holder) {
  const TestNode node("stale");
  pid_t holder = 0;
  ASSERT_TRUE(NodeLock::acquire(node.name(), holder).ok());
  EXPECT_EQ(running_node(node.name()), 0) << "the text is only a hint, the lock counts";
  EXPECT_TRUE(NodeLock::acquire(node.name(), holder).ok());
}

TEST(NodeLock, Two_removers_and_starters_never_hold_it_at_once) {
  const TestNode node("race");
  auto* holders =
      static_cast<std::atomic<int>*>(::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  const auto contend = [&] {
    for (int i = 0; i < 300; ++i) {
      pid_t seen = 0;
      const auto lock = NodeLock::acquire(node.name(), seen);
      if (!lock.ok()) {
        continue;
      }
      if (holders->fetch_add(1) != 0) {
        return 1;
      }
      holders->fetch_sub(1);
      if (i % 2 == 0) {
        // From here on a newcomer makes a file of its own: removing is the last thing a holder may do.
        static_cast<void>(remove_shm_file(lock_file(node.name())));
      }
    }
    return 0;
  };
  Forked one(contend);
  Forked two(contend);
  Forked three(contend);
  EXPECT_EQ(one.wait() + two.wait() + three.wait(), 0);
  ::munmap(holders, 4096);
}

TEST(NodeLock, Keeps_others_out_by_its_rights) {
  const TestNode node("rights");
  pid_t holder = 0;
  ASSERT_TRUE(NodeLock::acquire(node.name(), holder).ok());
  struct stat info {};
  ASSERT_EQ(::stat((std::string(kShmDirectory) + "/" + lock_file(node.name())).c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777U, 0660U);
}

TEST(Process, Alive_means_same_start_time) {
  const std::uint64_t start = process_start_time(::getpid());
  EXPECT_NE(start, 0U);
  EXPECT_TRUE(process_alive(::getpid(), start));
  EXPECT_FALSE(process_alive(::getpid(), start + 1));
  EXPECT_FALSE(process_alive(0, 0));
  Forked child([] { return 0; });
  EXPECT_TRUE(indurop::test::wait_until([&] { return !process_alive(child.pid(), process_start_time(child.pid())); }))
      << "a zombie does not live";
}

constexpr std::uint64_t kMagicOfRun = 0x1122334455667788;

TEST(RunFile, Is_visible_once_its_magic_is_stored) {
  const TestNode node("run");
  EXPECT_EQ(RunFile::open(node.name(), Mode::ReadOnly, kMagicOfRun, 64).error().code, Errc::NotFound);
  const auto sut = RunFile::create(node.name(), 100'000);
  ASSERT_TRUE(sut.ok());
  auto* words = static_cast<std::uint64_t*>(sut->data());
  EXPECT_EQ(words[12'499], 0U);
  EXPECT_EQ(RunFile::open(node.name(), Mode::ReadOnly, kMagicOfRun, 64).error().code, Errc::Busy);
  words[1] = 42;
  __atomic_store_n(words, kMagicOfRun, __ATOMIC_RELEASE);
  const auto reader = RunFile::open(node.name(), Mode::ReadOnly, kMagicOfRun, 100'000);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(static_cast<const std::uint64_t*>(reader->data())[1], 42U);
  EXPECT_EQ(reader->size(), 100'000U);
  EXPECT_EQ(RunFile::open(node.name(), Mode::ReadOnly, kMagicOfRun + 1, 64).error().code, Errc::Corrupt);
  EXPECT_EQ(RunFile::open(node.name(), Mode::ReadOnly, kMagicOfRun, 100'001).error().code, Errc::Corrupt);
  sut->prefault();
  reader->prefault();
}

TEST(RunFile, New_run_starts_from_zero_and_leaves_the_old_one_to_its_users) {
  const TestNode node("rerun");
  const auto older = RunFile::create(node.name(), 4096);
  ASSERT_TRUE(older.ok());
  __atomic_store_n(static_cast<std::uint64_t*>(older->data()), kMagicOfRun, __ATOMIC_RELEASE);
  const auto sut = RunFile::create(node.name(), 8192);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(*static_cast<std::uint64_t*>(sut->data()), 0U);
  EXPECT_EQ(*static_cast<std::uint64_t*>(older->data()), kMagicOfRun);
}

}  // namespace
}  // namespace indurop::vars
