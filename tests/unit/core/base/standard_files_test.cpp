// SPDX-License-Identifier: Apache-2.0
#include "core/base/standard_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <thread>

namespace indurop::base {
namespace {

std::string file_at(int number) {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(number), error).string();
}

// Closes these files first. Ends with 0 if exactly they are /dev/null then, and the next one has none of their numbers.
[[noreturn]] void open_without(std::initializer_list<int> closed) {
  bool good = true;
  for (const int file : {0, 1, 2}) {
    (void)::dup2(::open("/dev/zero", O_RDWR), file);
  }
  for (const int file : closed) {
    (void)::close(file);
  }
  open_standard_files();
  for (const int file : {0, 1, 2}) {
    const bool was_closed = std::find(closed.begin(), closed.end(), file) != closed.end();
    good = good && file_at(file) == (was_closed ? "/dev/null" : "/dev/zero");
  }
  std::_Exit(good && ::open("/dev/zero", O_RDONLY) > 2 ? 0 : 1);
}

TEST(StandardFiles, Are_opened_if_they_are_closed) {
  EXPECT_EXIT(open_without({}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({1}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({2}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0, 2}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0, 1, 2}), ::testing::ExitedWithCode(0), "");
}

// A pipe of one page as standard output and error, which nothing reads; `fill` makes it full.
struct Unread {
  explicit Unread(bool fill) {
    std::array<int, 2> ends{-1, -1};
    if (::pipe(ends.data()) != 0 || ::fcntl(ends[1], F_SETPIPE_SZ, 4096) < 0) {
      std::_Exit(2);
    }
    read = ends[0];
    (void)::dup2(ends[1], STDOUT_FILENO);
    (void)::dup2(ends[1], STDERR_FILENO);
    const std::string page(fill ? 4096 : 0, '.');
    (void)!::write(STDERR_FILENO, page.data(), page.size());
  }
  std::string content() const {
    std::string text(8192, '\0');
    const ssize_t size = ::read(read, text.data(), text.size());
    return text.substr(0, size < 0 ? 0 : static_cast<std::size_t>(size));
  }
  int read = -1;
};

TEST(ReportLine, Is_written_as_one_line) {
  EXPECT_EXIT(
      {
        const Unread sut(false);
        report_line("who:", "what");
        std::_Exit(sut.content() == "who: what\n" ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(ReportLine, Is_dropped_and_counted_while_nothing_reads) {
  EXPECT_EXIT(
      {
        const Unread sut(true);
        report_line("who:", "first");
        report_line("who:", "second");
        (void)sut.content();
        report_line("who:", "third");
        std::_Exit(sut.content() == "who: warning: 2 messages were dropped: standard error was not read\nwho: third\n"
                       ? 0
                       : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(PrintWithin, Prints_all_or_returns_false) {
  constexpr std::chrono::milliseconds kPatience{1};
  EXPECT_EXIT(
      {
        const Unread sut(false);
        const bool all = print_within(kPatience, "a\n") && sut.content() == "a\n";
        const bool too_much = print_within(kPatience, std::string(10'000, 'x'));
        std::_Exit(all && !too_much ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(FlushStandardOutput, Waits_for_no_thread_that_prints) {
  EXPECT_EXIT(
      {
        ::flockfile(stdout);
        bool flushed = true;
        std::thread([&flushed] { flushed = flush_standard_output(std::chrono::milliseconds(1)); }).join();
        std::_Exit(flushed ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace indurop::base
