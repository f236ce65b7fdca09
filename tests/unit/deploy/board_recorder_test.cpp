// SPDX-License-Identifier: Apache-2.0
// A recording for a client on another host: what ends it, what remains of it, what it rejects. The recorder is a
// script.

#include "deploy/agent/board_recorder.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "store/vars/retain.h"
#include "store/vars/store.h"
#include "tests/support/wait_until.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::deploy {
namespace {

using test::wait_until;
using testing::HasSubstr;

class Board_recorder : public testing::Test {
 protected:
  Board_recorder() : store_(vars::Store::create(node_.name(), schema()).value()) {
    std::filesystem::create_directories(folder_);
    ::setenv("INDUROP_STATE_DIR", (folder_ / "state").c_str(), 1);
    script(R"(trap 'echo end >> "$file"; exit 130' INT)");
    make();
  }
  ~Board_recorder() override {
    sut_.reset();
    ::unsetenv("INDUROP_STATE_DIR");
    std::filesystem::remove_all(folder_);
  }
  static schema::Schema schema() {
    schema::Schema made;
    made.variables.push_back(vars::test::variable("cell::speed", vars::test::scalar_type(schema::Base::Double)));
    made.variables.push_back(vars::test::variable("cell::torque", vars::test::scalar_type(schema::Base::Double)));
    return made;
  }
  // Says how it was called in the file that it writes, and runs until something ends it.
  void script(const std::string& line) const {
    std::ofstream out(program());
    out << "#!/bin/sh\nfile=$5\n" << line << "\necho \"$@\" > \"$file\"\nwhile :; do sleep 0.01; done\n";
    out.close();
    std::filesystem::permissions(program(), std::filesystem::perms::owner_all);
  }
  void make(BoardRecorder::Limits limits = {std::chrono::seconds(15), 1U << 30U, 0}) {
    sut_.emplace(node_.name(), program(), limits, log_);
  }
  [[nodiscard]] std::filesystem::path program() const { return folder_ / "recorder"; }
  [[nodiscard]] std::filesystem::path left() const { return vars::state_directory(node_.name()) / "recordings"; }
  [[nodiscard]] std::string text(const std::string& name) const {
    std::ifstream in(left() / (name + ".mcap"));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  BoardRecorder::Answer give(Action action, const std::string& target, const std::string& host = "desk") {
    Command command;
    command.action = action;
    command.target = target;
    command.host = host;
    auto answer = sut_->begin(command, now_);
    EXPECT_TRUE(wait_until([&] {
      sut_->step(now_);
      if (const auto done = answer.outcome == Outcome::UnderWay ? sut_->poll(action) : std::nullopt) {
        answer = *done;
      }
      return answer.outcome != Outcome::UnderWay;
    }));
    return answer;
  }
  // Until it has ended on its own.
  std::string why_it_ended(const std::string& name) {
    std::string why;
    EXPECT_TRUE(wait_until([&] {
      now_ += std::chrono::seconds(1);
      sut_->step(now_);
      const auto answer = give(Action::Record, name + "\nnow");
      why = answer.text;
      return answer.outcome == Outcome::Failed;
    }));
    return why;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("board_recorder_test." + std::to_string(::getpid()) + "." +
                                                testing::UnitTest::GetInstance()->current_test_info()->name());
  vars::test::TestNode node_{"recorded"};
  vars::Store store_;
  base::Log log_{"test", "board", true};
  rt::MonoTime now_ = rt::MonoClock::now();
  std::optional<BoardRecorder> sut_;
};

TEST_F(Board_recorder, Records_until_it_is_commanded_to_end_and_keeps_the_file_until_it_is_discarded) {
  EXPECT_EQ(give(Action::Record, "one\npast").outcome, Outcome::Done);
  EXPECT_EQ(give(Action::Record, "one\npast").outcome, Outcome::Unchanged) << "it goes on";
  EXPECT_EQ(give(Action::EndRecord, "one").outcome, Outcome::Done);
  EXPECT_EQ(text("one"), "record --node " + node_.name() + " -o " + (left() / "one.mcap").string() + " --past\nend\n");
  EXPECT_THAT(recordings_text(node_.name()), HasSubstr(R"("name":"one")"));
  EXPECT_EQ(recording_file(node_.name(), "one"), left() / "one.mcap");
  EXPECT_EQ(give(Action::DropRecord, "one").outcome, Outcome::Done);
  EXPECT_EQ(recordings_text(node_.name()), R"({"recordings":[]})");
}

TEST_F(Board_recorder, Says_which_names_nothing_has_and_records_the_others) {
  const auto some = give(Action::Record, "one\nnow\nnothing\ncell::*\nx::*");
  EXPECT_EQ(some.outcome, Outcome::Done);
  EXPECT_EQ(some.text, "nothing\nx::*");
  EXPECT_THAT(text("one"), testing::EndsWith("one.mcap cell::*\n"));
  give(Action::EndRecord, "one");
  EXPECT_EQ(give(Action::Record, "two\nnow\nnothing").text, "nothing");
  EXPECT_EQ(recording_file(node_.name(), "two"), std::nullopt) << "there is nothing to record";
}

TEST_F(Board_recorder, Ends_when_no_client_requests_it_any_more) {
  give(Action::Record, "one\nnow");
  now_ += std::chrono::seconds(14);
  give(Action::Record, "one\nnow");
  now_ += std::chrono::seconds(14);
  sut_->step(now_);
  EXPECT_EQ(give(Action::Record, "one\nnow").outcome, Outcome::Unchanged);
  now_ += std::chrono::seconds(16);
  sut_->step(now_);
  EXPECT_EQ(why_it_ended("one"), "desk did not report for 15 s");
  EXPECT_THAT(text("one"), HasSubstr("end")) << "it could close its file";
  EXPECT_EQ(give(Action::EndRecord, "one").text, "desk did not report for 15 s");
}

TEST_F(Board_recorder, Leaves_room_on_the_disk) {
  make({std::chrono::seconds(15), 10, 0});
  give(Action::Record, "one\nnow");
  EXPECT_EQ(why_it_ended("one"), "it reached the limit of 0 MB");
  make({std::chrono::seconds(15), 1U << 30U, std::uint64_t{1} << 60U});
  EXPECT_THAT(give(Action::Record, "two\nnow").text, HasSubstr("left on its disk"));
  EXPECT_EQ(recordings_text(node_.name()), R"({"recordings":[]})") << "the one before made room";
}

TEST_F(Board_recorder, Reports_what_its_recorder_reported) {
  script("echo 'indurop: error: 3 runs of main are missing'; exit 1");
  EXPECT_EQ(give(Action::Record, "one\nnow").text, "3 runs of main are missing");
  script("trap 'echo indurop: error: 3 runs of main are missing; exit 1' INT");
  give(Action::Record, "two\nnow");
  const auto lost = give(Action::EndRecord, "two");
  EXPECT_EQ(lost.outcome, Outcome::Failed);
  EXPECT_EQ(lost.text, "3 runs of main are missing");
  script("kill -9 $$");
  EXPECT_EQ(give(Action::Record, "three\nnow").text, "its recorder ended with exit code 137");
  std::filesystem::remove(program());
  EXPECT_EQ(give(Action::Record, "four\nnow").outcome, Outcome::Failed);
}

TEST_F(Board_recorder, Serves_one_at_a_time) {
  give(Action::Record, "one\nnow", "desk");
  EXPECT_EQ(give(Action::Record, "two\nnow", "laptop").text, "it is being recorded for desk");
  EXPECT_EQ(give(Action::EndRecord, "two", "laptop").outcome, Outcome::Refused);
  EXPECT_EQ(give(Action::DropRecord, "two", "laptop").outcome, Outcome::Refused);
  EXPECT_EQ(give(Action::EndRecord, "one").outcome, Outcome::Done);
  EXPECT_EQ(give(Action::Record, "two\nnow", "laptop").outcome, Outcome::Done);
  EXPECT_EQ(recording_file(node_.name(), "one"), std::nullopt) << "the disk is the board's";
}

TEST_F(Board_recorder, Takes_no_options_and_no_paths) {
  for (const char* target : {"", "one", "../one\nnow", "a/b\nnow", "\nnow", "one\nnow\n-o", "one\nnow\n--node=x"}) {
    EXPECT_EQ(give(Action::Record, target).outcome, Outcome::Refused) << target;
  }
  EXPECT_FALSE(std::filesystem::exists(left()));
  give(Action::Record, "one\nnow");
  for (const char* name : {"", "..", "../recordings/one", "one.mcap", "one.log", "/etc/passwd"}) {
    EXPECT_EQ(recording_file(node_.name(), name), std::nullopt) << name;
  }
}

TEST_F(Board_recorder, Ends_with_its_agent) {
  give(Action::Record, "one\nnow");
  sut_.reset();
  EXPECT_TRUE(wait_until([&] { return text("one").ends_with("end\n"); }));
}

}  // namespace
}  // namespace indurop::deploy
