// SPDX-License-Identifier: Apache-2.0
#include "core/base/replace_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <thread>
#include <vector>

#include "core/base/descriptor.h"
#include "folder.h"
#include "tests/support/forked.h"

namespace indurop::base {
namespace {

using Kind = FileProblem::Kind;
namespace fs = std::filesystem;

class ReplaceFile : public FolderTest {
 protected:
  [[nodiscard]] mode_t mode_of(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::stat(at(name).c_str(), &status), 0);
    return status.st_mode & 07777U;
  }
};

TEST_F(ReplaceFile, A_new_file_has_the_content_and_the_mode_less_the_umask) {
  const mode_t before = ::umask(027);
  EXPECT_TRUE(replace_file(at("new"), "text", Durable::No).ok());
  EXPECT_TRUE(replace_file(at("secret"), "text", Durable::Yes, 0600).ok());
  ::umask(before);
  EXPECT_EQ(content("new"), "text");
  EXPECT_EQ(mode_of("new"), 0640U);
  EXPECT_EQ(mode_of("secret"), 0600U);
  EXPECT_EQ(names(), 2);
}

TEST_F(ReplaceFile, Content_of_all_sizes_replaces_what_was_there) {
  for (const Durable durable : {Durable::No, Durable::Yes}) {
    for (const std::size_t size : {300000U, 0U, 1U, 65536U}) {
      const std::string text(size, static_cast<char>('a' + size % 26));
      ASSERT_TRUE(replace_file(at("file"), text, durable).ok());
      EXPECT_EQ(content("file"), text);
    }
  }
  EXPECT_EQ(names(), 1);
}

TEST_F(ReplaceFile, The_mode_of_the_old_file_stays) {
  write("file", "old");
  for (const mode_t mode : {0600U, 0755U, 0664U, 0444U}) {
    ASSERT_EQ(::chmod(at("file").c_str(), mode), 0);
    ASSERT_TRUE(replace_file(at("file"), "new", Durable::No).ok());
    EXPECT_EQ(mode_of("file"), mode);
  }
}

TEST_F(ReplaceFile, Files_of_the_user_next_to_it_are_left_alone) {
  for (const char* name : {"file.tmp", "file.new", ".file.tmp"}) {
    write(name, "of the user");
  }
  ASSERT_TRUE(replace_file(at("file"), "text", Durable::Yes).ok());
  for (const char* name : {"file.tmp", "file.new", ".file.tmp"}) {
    EXPECT_EQ(content(name), "of the user");
  }
}

TEST_F(ReplaceFile, A_name_as_long_as_names_can_be_works) {
  const std::string name(255, 'n');
  ASSERT_TRUE(replace_file(at(name), "text", Durable::No).ok());
  EXPECT_EQ(content(name), "text");
}

TEST_F(ReplaceFile, A_reader_has_the_old_content_or_the_new_one) {
  const std::string one(50000, '1');
  const std::string two(70000, '2');
  ASSERT_TRUE(replace_file(at("file"), one, Durable::No).ok());
  std::thread writer([&] {
    for (int i = 0; i < 100; ++i) {
      EXPECT_TRUE(replace_file(at("file"), i % 2 == 0 ? two : one, Durable::No).ok());
    }
  });
  for (int i = 0; i < 100; ++i) {
    const std::string found = content("file");
    EXPECT_TRUE(found == one || found == two) << found.size();
  }
  writer.join();
}

TEST_F(ReplaceFile, A_link_stays_and_its_target_gets_the_content) {
  fs::create_directory(at("inside"));
  write("inside/target", "old");
  fs::create_symlink("inside/target", at("link"));
  fs::create_symlink("link", at("link of link"));
  ASSERT_TRUE(replace_file(at("link of link"), "new", Durable::Yes).ok());
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(content("inside/target"), "new");
  fs::create_symlink("inside/not yet", at("dangling"));
  ASSERT_TRUE(replace_file(at("dangling"), "new", Durable::No).ok());
  EXPECT_EQ(content("inside/not yet"), "new");
}

TEST_F(ReplaceFile, A_pipe_is_written_to_and_not_replaced) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const auto unread = replace_file(at("pipe"), "text", Durable::Yes);
  ASSERT_FALSE(unread.ok());
  EXPECT_EQ(unread.error().text, "no process reads this pipe");
  const Descriptor reader(::open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK));
  ASSERT_TRUE(replace_file(at("pipe"), "text", Durable::Yes).ok());
  std::array<char, 10> got{};
  EXPECT_EQ(::read(reader.get(), got.data(), got.size()), 4);
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

TEST_F(ReplaceFile, A_link_to_a_device_leaves_both_as_they_are) {
  fs::create_symlink("/dev/null", at("null"));
  EXPECT_TRUE(replace_file(at("null"), "text", Durable::Yes).ok());
  EXPECT_TRUE(fs::is_symlink(at("null")));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(ReplaceFile, Standard_output_by_its_name_goes_on_where_it_is) {
  const Descriptor kept(::dup(STDOUT_FILENO));
  {
    const Descriptor file(::open(at("out").c_str(), O_WRONLY | O_CREAT, 0600));
    ASSERT_GE(::dup2(file.get(), STDOUT_FILENO), 0);
  }
  const bool first = ::write(STDOUT_FILENO, "first ", 6) == 6;
  const bool replaced = replace_file("/dev/stdout", "second", Durable::No).ok();
  ::dup2(kept.get(), STDOUT_FILENO);
  EXPECT_TRUE(first && replaced);
  EXPECT_EQ(content("out"), "first second");
}

TEST_F(ReplaceFile, Folders_and_missing_folders_are_errors) {
  EXPECT_EQ(replace_file(folder_, "text", Durable::No).error().kind, Kind::Directory);
  EXPECT_EQ(replace_file(at("none") / "file", "text", Durable::No).error().sys_errno, ENOENT);
  write("file", "old");
  EXPECT_EQ(replace_file(at("file") / "inside", "text", Durable::No).error().sys_errno, ENOTDIR);
  EXPECT_EQ(content("file"), "old");
}

TEST_F(ReplaceFile, What_cannot_be_written_whole_leaves_the_old_content_and_no_remains) {
  write("file", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto sut = replace_file(at("file"), std::string(5000, 'x'), Durable::Yes);
  const auto created = create_file(at("other"), std::string(5000, 'x'), 0600);
  ::setrlimit(RLIMIT_FSIZE, &before);
  (void)std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().sys_errno, EFBIG);
  EXPECT_FALSE(created.ok());
  EXPECT_EQ(content("file"), "old");
  EXPECT_EQ(names(), 1);
}

TEST_F(ReplaceFile, A_full_disk_is_an_error_and_leaves_the_old_content) {
  fs::create_directory(at("disk"));
  if (::mount("none", at("disk").c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "mounting a small disk needs root";
  }
  write("disk/file", "old");
  const auto sut = replace_file(at("disk/file"), std::string(200000, 'x'), Durable::Yes);
  const std::string found = content("disk/file");
  const auto left = std::distance(fs::directory_iterator(at("disk")), fs::directory_iterator());
  ::umount(at("disk").c_str());
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().sys_errno, ENOSPC);
  EXPECT_EQ(found, "old");
  EXPECT_EQ(left, 1);
}

TEST_F(ReplaceFile, A_kill_at_any_moment_leaves_no_half_file) {
  const std::string one(200000, '1');
  const std::string two(200000, '2');
  ASSERT_TRUE(replace_file(at("file"), one, Durable::No).ok());
  for (int round = 0; round < 10; ++round) {
    std::array<int, 2> begun{};
    ASSERT_EQ(::pipe(begun.data()), 0);
    test::Forked child([&]() -> int {
      (void)!::write(begun[1], "b", 1);
      for (int i = 0;; ++i) {
        (void)replace_file(at("file"), i % 2 == 0 ? two : one, Durable::No);
      }
    });
    char byte = 0;
    ASSERT_EQ(::read(begun[0], &byte, 1), 1);
    ::close(begun[0]);
    ::close(begun[1]);
    child.kill_and_wait();
    const std::string found = content("file");
    EXPECT_TRUE(found == one || found == two);
  }
}

TEST_F(ReplaceFile, A_file_that_must_be_new_is_never_replaced) {
  const mode_t before = ::umask(0);
  EXPECT_TRUE(create_file(at("key"), "secret", 0600).ok());
  ::umask(before);
  EXPECT_EQ(mode_of("key"), 0600U);
  EXPECT_EQ(create_file(at("key"), "other", 0600).error().sys_errno, EEXIST);
  EXPECT_EQ(content("key"), "secret");
  fs::create_symlink("elsewhere", at("link"));
  EXPECT_EQ(create_file(at("link"), "other", 0600).error().sys_errno, EEXIST);
  EXPECT_FALSE(fs::exists(at("elsewhere")));
  EXPECT_EQ(names(), 2);
}

}  // namespace
}  // namespace indurop::base
