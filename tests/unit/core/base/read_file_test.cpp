// SPDX-License-Identifier: Apache-2.0
#include "core/base/read_file.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>

#include "folder.h"

namespace indurop::base {
namespace {

using Kind = FileProblem::Kind;
using ::testing::HasSubstr;

class ReadFile : public FolderTest {};

TEST_F(ReadFile, Files_of_all_sizes_come_back_as_they_are) {
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i) {
      text[i] = static_cast<char>(i * 7 % 256);
    }
    write("file", text);
    const auto sut = read_file(at("file"));
    ASSERT_TRUE(sut.ok());
    EXPECT_EQ(*sut, text);
    EXPECT_EQ(open_file(at("file"))->size, size);
  }
}

TEST_F(ReadFile, A_file_of_the_kernel_that_says_it_is_empty_is_read) {
  const auto sut = read_file("/proc/self/status");
  ASSERT_TRUE(sut.ok());
  EXPECT_THAT(*sut, HasSubstr("Pid:"));
}

TEST_F(ReadFile, The_limit_is_the_last_size_that_is_taken) {
  for (const std::size_t most : {0U, 1U, 99U, 65536U, 100000U}) {
    write("file", std::string(most, 'x'));
    EXPECT_TRUE(read_file(at("file"), most).ok()) << most;
    write("file", std::string(most + 1, 'x'));
    const auto sut = read_file(at("file"), most);
    ASSERT_FALSE(sut.ok()) << most;
    EXPECT_EQ(sut.error().kind, Kind::TooLarge);
  }
  write("file", std::string((4U << 20U) + 1, 'x'));
  EXPECT_EQ(read_file(at("file"), 4U << 20U).error().text, "it is larger than 4 MiB");
}

TEST_F(ReadFile, What_is_not_there_is_said_with_the_systems_reason) {
  const auto sut = read_file(at("none"));
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().kind, Kind::System);
  EXPECT_EQ(sut.error().sys_errno, ENOENT);
  EXPECT_EQ(sut.error().text, "No such file or directory");
}

TEST_F(ReadFile, A_pipe_without_a_writer_does_not_block) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const auto sut = read_file(at("pipe"));
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().kind, Kind::NotRegular);
  EXPECT_EQ(sut.error().text, "it is a pipe, not a file");
}

TEST_F(ReadFile, Devices_sockets_and_folders_are_refused) {
  EXPECT_EQ(read_file("/dev/zero").error().text, "it is a device, not a file");
  EXPECT_EQ(read_file("/dev/null").error().kind, Kind::NotRegular);
  EXPECT_EQ(read_file(folder_).error().kind, Kind::Directory);
  EXPECT_EQ(read_file(folder_).error().text, "it is a directory, not a file");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, at("socket").c_str(), sizeof(address.sun_path) - 1);
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM, 0));
  ASSERT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(read_file(at("socket")).error().text, "it is a socket, not a file");
}

TEST_F(ReadFile, A_link_is_followed_one_in_a_circle_is_refused) {
  write("file", "text");
  std::filesystem::create_symlink("file", at("link"));
  EXPECT_EQ(*read_file(at("link")), "text");
  std::filesystem::create_symlink("circle", at("circle"));
  EXPECT_EQ(read_file(at("circle")).error().sys_errno, ELOOP);
}

}  // namespace
}  // namespace indurop::base
