// SPDX-License-Identifier: Apache-2.0
#include "core/base/line_journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <barrier>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "folder.h"

namespace indurop::base {
namespace {

class LineJournals : public FolderTest {
 protected:
  [[nodiscard]] LineJournal journal(std::uintmax_t max_bytes) const {
    return {at("deep/journal"), max_bytes, 0600, Durable::No};
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    each_line(at("deep/journal"), [&all](std::string_view line) { all.emplace_back(line); });
    return all;
  }
};

TEST_F(LineJournals, Lines_come_back_in_their_order) {
  EXPECT_TRUE(lines().empty());
  const std::vector<std::string> written{"one", "", "three"};
  for (const std::string& line : written) {
    ASSERT_EQ(append_line(journal(1000), line), "");
  }
  EXPECT_EQ(lines(), written);
}

TEST_F(LineJournals, A_file_that_has_grown_is_put_aside_and_the_one_before_it_goes) {
  // Lines of ten bytes: the fourth finds a file beyond 25 and begins a new one.
  for (const char* line : {"line    1", "line    2", "line    3", "line    4"}) {
    ASSERT_EQ(append_line(journal(25), line), "");
  }
  EXPECT_EQ(content("deep/journal.1"), "line    1\nline    2\nline    3\n");
  EXPECT_EQ(content("deep/journal"), "line    4\n");
  EXPECT_EQ(lines(), (std::vector<std::string>{"line    1", "line    2", "line    3", "line    4"}));
  for (const char* line : {"line    5", "line    6", "line    7"}) {
    ASSERT_EQ(append_line(journal(25), line), "");
  }
  EXPECT_EQ(lines(), (std::vector<std::string>{"line    4", "line    5", "line    6", "line    7"}));
}

TEST_F(LineJournals, Writers_at_the_same_time_put_a_file_aside_once) {
  constexpr int kWriters = 8;
  constexpr int kRounds = 300;
  for (int round = 0; round < kRounds; ++round) {
    std::filesystem::remove_all(at("deep"));
    ASSERT_EQ(append_line(journal(1000), "an old line which is longer than the journal may be"), "");
    std::barrier<> all(kWriters);
    std::vector<std::thread> writers;
    for (int i = 0; i < kWriters; ++i) {
      writers.emplace_back([this, &all] {
        all.arrive_and_wait();
        EXPECT_EQ(append_line(journal(40), "new"), "");
      });
    }
    for (std::thread& writer : writers) {
      writer.join();
    }
    ASSERT_EQ(lines().size(), kWriters + 1U) << "round " << round;
  }
}

TEST_F(LineJournals, A_line_that_was_cut_anywhere_does_not_damage_the_next_one) {
  const std::string whole = "first\nsecond\n";
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    ASSERT_EQ(append_line(journal(1000), "creates the folder"), "");
    write("deep/journal", whole.substr(0, size));
    ASSERT_EQ(append_line(journal(1000), "next"), "");
    const std::vector<std::string> found = lines();
    EXPECT_EQ(found.back(), "next") << "cut at byte " << size;
    EXPECT_EQ(size >= 5, found.front() == "first") << "cut at byte " << size;
  }
}

TEST_F(LineJournals, A_full_disk_is_said_and_leaves_the_lines_before_and_after_it) {
  ASSERT_EQ(append_line(journal(1000), "before"), "");
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit full = usual;
  full.rlim_cur = 10;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  EXPECT_EQ(append_line(journal(1000), "too long for it"), "No space left on device");
  EXPECT_EQ(append_line(journal(1000), "and this"), "File too large");
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &usual), 0);
  ASSERT_EQ(append_line(journal(1000), "after"), "");
  EXPECT_EQ(lines(), (std::vector<std::string>{"before", "too", "after"}));
}

TEST_F(LineJournals, Says_why_a_line_cannot_be_kept) {
  write("deep", "a file where the folder should be");
  EXPECT_EQ(append_line(journal(1000), "line"), "Not a directory");
}

}  // namespace
}  // namespace indurop::base
