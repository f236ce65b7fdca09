// SPDX-License-Identifier: Apache-2.0
// indurop-pools as a child of an agent: when it is started, what ends it, what is said about it. The program is a
// script.

#include "deploy/agent/board_pools.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <optional>

#include "core/base/json.h"
#include "core/base/read_file.h"
#include "deploy/words/node_texts.h"
#include "store/vars/retain.h"
#include "tests/support/wait_until.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using test::wait_until;
using testing::HasSubstr;

class BoardPoolsTest : public testing::Test {
 protected:
  BoardPoolsTest() {
    fs::create_directories(folder_ / "state/a");
    ::setenv("INDUROP_STATE_DIR", (folder_ / "state").c_str(), 1);
    script("while :; do sleep 0.01; done");
    begin();
  }
  ~BoardPoolsTest() override {
    sut_.reset();
    ::unsetenv("INDUROP_STATE_DIR");
    fs::remove_all(folder_);
  }

  [[nodiscard]] fs::path program() const { return folder_ / "indurop-pools"; }
  // Appends how it was called to a file, then does that.
  void script(const std::string& line) const {
    const fs::path made = folder_ / "new";
    std::ofstream out(made);
    out << "#!/bin/sh\necho \"$@\" >> " << (folder_ / "calls").string() << "\n" << line << "\n";
    out.close();
    fs::permissions(made, fs::perms::owner_all);
    fs::rename(made, program());
  }
  void begin() {
    sut_.emplace("a", program(), std::vector<std::string>{"--quiet"}, true,
                 BoardPools::Limits{milliseconds(100), milliseconds(350), milliseconds(60'000), milliseconds(200)},
                 log_);
  }
  fs::path manifest(const std::string& name, const std::string& pools) const {
    const fs::path file = folder_ / name;
    std::ofstream(file) << "<plant name=\"p\"><board name=\"a\"/><board name=\"b\"/>" << pools << "</plant>";
    return file;
  }
  static std::string content_of(const fs::path& file) {
    const auto read = base::read_file(file);
    return read ? *read : "";
  }
  [[nodiscard]] std::string calls() const { return content_of(folder_ / "calls"); }
  [[nodiscard]] long number_of_calls() const {
    const std::string all = calls();
    return std::count(all.begin(), all.end(), '\n');
  }
  void step() { sut_->step(manifest_, node_runs_, now_); }
  [[nodiscard]] base::Json text() const { return base::Json::parse(sut_->text()).value_or(base::Json()); }
  [[nodiscard]] std::string state() const {
    std::string word;
    (void)base::read(text(), "state", word);
    return word;
  }
  [[nodiscard]] pid_t pid() const {
    std::int64_t pid = 0;
    (void)base::read(text(), "pid", pid);
    return static_cast<pid_t>(pid);
  }
  bool wait_for_calls(long number) {
    return wait_until([&] {
      step();
      return number_of_calls() == number;
    });
  }
  // Kills the program, and waits until that is noticed.
  void die() {
    const pid_t before = pid();
    ASSERT_GT(before, 0);
    ::kill(before, SIGKILL);
    EXPECT_TRUE(wait_until([&] {
      step();
      return pid() == 0;
    }));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("board_pools_test." + std::to_string(::getpid()));
  base::Log log_{"test", "a", true};
  fs::path manifest_;
  bool node_runs_ = true;
  rt::MonoTime now_ = rt::MonoClock::now();
  std::optional<BoardPools> sut_;
  const std::string sent_ = R"(<pool name="n::eye" from="a" to="b" every="1s"/>)";
};

TEST_F(BoardPoolsTest, Runs_with_what_the_manifest_says_once_the_node_runs) {
  manifest_ = manifest("one.xml", sent_);
  node_runs_ = false;
  step();
  EXPECT_EQ(pid(), 0);
  EXPECT_EQ(state(), "starting");
  node_runs_ = true;
  ASSERT_TRUE(wait_for_calls(1));
  EXPECT_EQ(calls(), "--node a --plant p --domain 0 --send n::eye@1000000000ns --one-host --quiet\n");
  EXPECT_EQ(state(), "running");
  EXPECT_THAT(sut_->text(), HasSubstr(R"("pools":[{"pool":"n::eye","text":"sent to b, at most every 1 s"}])"));
  EXPECT_EQ(content_of(pools_file(vars::state_directory("a"))), sut_->text());
}

TEST_F(BoardPoolsTest, A_board_without_pools_has_no_program) {
  manifest_ = manifest("none.xml", R"(<pool name="n::eye" from="b" to="c"/><board name="c"/>)");
  step();
  EXPECT_EQ(pid(), 0);
  EXPECT_EQ(sut_->text(), "");
  EXPECT_FALSE(fs::exists(pools_file(vars::state_directory("a"))));
}

TEST_F(BoardPoolsTest, Goes_on_through_a_restart_of_the_node_and_another_manifest_with_the_same_pools) {
  manifest_ = manifest("one.xml", sent_);
  ASSERT_TRUE(wait_for_calls(1));
  const pid_t first = pid();
  node_runs_ = false;
  step();
  manifest_ = manifest("two.xml", sent_ + "<lease>1s</lease>");
  step();
  node_runs_ = true;
  step();
  EXPECT_EQ(pid(), first);
}

TEST_F(BoardPoolsTest, Other_pools_end_it_and_start_it_again) {
  manifest_ = manifest("one.xml", sent_);
  ASSERT_TRUE(wait_for_calls(1));
  const pid_t first = pid();
  manifest_ = manifest("two.xml", R"(<pool name="n::eye" from="b" to="a"/>)");
  ASSERT_TRUE(wait_for_calls(2));
  EXPECT_NE(pid(), first);
  EXPECT_THAT(calls(), HasSubstr("--receive n::eye"));
  EXPECT_EQ(sut_->problem(), "");
  manifest_.clear();  // the node stays down
  EXPECT_TRUE(wait_until([&] {
    step();
    return ::kill(first, 0) != 0 && sut_->text().empty();
  }));
}

TEST_F(BoardPoolsTest, A_program_that_dies_is_started_again_with_longer_and_longer_pauses) {
  manifest_ = manifest("one.xml", sent_);
  ASSERT_TRUE(wait_for_calls(1));
  long calls = 1;
  for (const int pause : {100, 200, 350, 350}) {
    die();
    EXPECT_THAT(sut_->problem(), HasSubstr("indurop-pools was ended by signal 9 (Killed); it is started again"));
    now_ += milliseconds(pause - 1);
    step();
    EXPECT_EQ(pid(), 0) << pause;
    now_ += milliseconds(1);
    ASSERT_TRUE(wait_for_calls(++calls)) << pause;
  }
  now_ += std::chrono::minutes(1);
  step();
  EXPECT_EQ(sut_->problem(), "") << "it has lived for a while";
  die();
  now_ += milliseconds(100);
  ASSERT_TRUE(wait_for_calls(++calls)) << "the first pause again";
}

TEST_F(BoardPoolsTest, Its_last_error_is_the_reason) {
  script("echo 'indurop-pools: error: these keys do not permit it' >&2; exit 1");
  manifest_ = manifest("one.xml", sent_);
  EXPECT_TRUE(wait_until([&] {
    step();
    return !sut_->problem().empty();
  }));
  EXPECT_EQ(sut_->problem(), "indurop-pools ended with exit code 1: these keys do not permit it; it is started again");
}

TEST_F(BoardPoolsTest, A_missing_program_is_reported_and_tried_again) {
  fs::remove(program());
  manifest_ = manifest("one.xml", sent_);
  step();
  EXPECT_THAT(sut_->problem(), HasSubstr("is missing; install all of the package indurop"));
  script("while :; do sleep 0.01; done");
  now_ += milliseconds(100);
  EXPECT_TRUE(wait_for_calls(1));
}

TEST_F(BoardPoolsTest, One_that_does_not_end_is_killed) {
  script("trap '' TERM\nwhile :; do sleep 0.01; done");
  manifest_ = manifest("one.xml", sent_);
  ASSERT_TRUE(wait_for_calls(1));
  const pid_t first = pid();
  manifest_.clear();
  step();
  now_ += milliseconds(200);
  EXPECT_TRUE(wait_until([&] {
    step();
    return ::kill(first, 0) != 0;
  }));
}

TEST_F(BoardPoolsTest, Ends_with_its_agent) {
  manifest_ = manifest("one.xml", sent_);
  ASSERT_TRUE(wait_for_calls(1));
  const pid_t first = pid();
  sut_->end();
  EXPECT_NE(::kill(first, 0), 0);
  EXPECT_FALSE(fs::exists(pools_file(vars::state_directory("a"))));
}

}  // namespace
}  // namespace indurop::deploy
