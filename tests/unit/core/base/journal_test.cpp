// SPDX-License-Identifier: Apache-2.0
// Entries of the journal, read by the rules of its protocol: "NAME=value\n", or "NAME\n", the length in 64 bits, little
// endian, the value, "\n". That journald itself understands them is shown on a machine with systemd
// (tests/integration/target).
#include "core/base/journal.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>

#include "core/base/log.h"

namespace indurop::base {
namespace {

using Entry = std::map<std::string, std::string>;

Entry parse(std::string_view bytes) {
  Entry entry;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find_first_of("=\n");
    const std::string name(bytes.substr(0, end));
    const bool measured = bytes.at(end) == '\n';
    bytes.remove_prefix(end + 1);
    std::size_t length = bytes.find('\n');
    if (measured) {
      std::uint64_t size = 0;  // this machine is little endian
      std::memcpy(&size, bytes.data(), sizeof size);
      bytes.remove_prefix(sizeof size);
      length = size;
    }
    entry[name] = bytes.substr(0, length);
    EXPECT_EQ(bytes.at(length), '\n');
    bytes.remove_prefix(length + 1);
  }
  return entry;
}

// A journal of our own, which can be closed and opened.
class JournalTest : public testing::Test {
 protected:
  JournalTest() { open(); }
  ~JournalTest() override { std::filesystem::remove(path_); }

  void open() {
    std::filesystem::remove(path_);
    socket_ = Descriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  void close() { socket_ = Descriptor(); }
  // The next entry; empty: there is none.
  Entry received() {
    std::array<char, 4096> bytes{};
    const ssize_t got = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    return parse({bytes.data(), got > 0 ? static_cast<std::size_t>(got) : 0});
  }

  std::string path_ = std::filesystem::temp_directory_path() / ("journal-" + std::to_string(::getpid()));
  Descriptor socket_;
};

TEST_F(JournalTest, A_message_of_a_module_has_its_name_in_a_field) {
  const Log sut("indurop-node", "sensor", false, std::make_shared<Journal>(path_));
  sut.about("main").warning("module {}: 3 overruns", "main");
  EXPECT_EQ(received(), (Entry{{"MESSAGE", "module main: 3 overruns"},
                               {"PRIORITY", "4"},
                               {"SYSLOG_IDENTIFIER", "indurop-node"},
                               {"INDUROP_BOARD", "sensor"},
                               {"INDUROP_MODULE", "main"}}));
  sut.info("ready");
  EXPECT_EQ(received(), (Entry{{"MESSAGE", "ready"},
                               {"PRIORITY", "6"},
                               {"SYSLOG_IDENTIFIER", "indurop-node"},
                               {"INDUROP_BOARD", "sensor"}}));
}

TEST_F(JournalTest, Errors_are_lines_as_well_and_nothing_else_is) {
  const Log sut("indurop-node", "sensor", false, std::make_shared<Journal>(path_));
  testing::internal::CaptureStderr();
  sut.info("ready");
  sut.warning("late");
  sut.error("gone");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "indurop-node[sensor]: error: gone\n");
}

TEST_F(JournalTest, A_value_of_several_lines_arrives_whole) {
  const std::array<Journal::Field, 1> fields{{{"TEXT", "MESSAGE=another\n\nPRIORITY=0\n"}}};
  Journal(path_).write(Journal::Priority::Info, "two\nlines", fields);
  EXPECT_EQ(received(),
            (Entry{{"MESSAGE", "two\nlines"}, {"PRIORITY", "6"}, {"TEXT", "MESSAGE=another\n\nPRIORITY=0\n"}}));
}

TEST_F(JournalTest, What_is_lost_while_there_is_no_journal_is_counted) {
  const Journal sut(path_);
  close();
  sut.write(Journal::Priority::Info, "one", {});
  sut.write(Journal::Priority::Info, "two", {});
  open();
  sut.write(Journal::Priority::Info, "three", {});
  EXPECT_EQ(received()["MESSAGE"], "three");
  EXPECT_EQ(received()["MESSAGE"], "2 messages were lost before: the journal did not take them");
  sut.write(Journal::Priority::Info, "four", {});
  EXPECT_EQ(received()["MESSAGE"], "four");
  EXPECT_EQ(received(), Entry());
}

TEST_F(JournalTest, A_journal_that_reads_nothing_stops_no_writer) {
  const Journal sut(path_);
  for (int i = 0; i < 100'000; ++i) {
    sut.write(Journal::Priority::Info, "much", {});
  }
  EXPECT_EQ(received()["MESSAGE"], "much");
}

TEST(StderrIsJournal, Is_recognized_by_device_and_inode) {
  struct stat file {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &file), 0);
  ::unsetenv("JOURNAL_STREAM");
  EXPECT_FALSE(stderr_is_journal());
  ::setenv("JOURNAL_STREAM", (std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino)).c_str(), 1);
  EXPECT_TRUE(stderr_is_journal());
  ::setenv("JOURNAL_STREAM", "1:1", 1);
  EXPECT_FALSE(stderr_is_journal());
  ::unsetenv("JOURNAL_STREAM");
}

}  // namespace
}  // namespace indurop::base
