// SPDX-License-Identifier: Apache-2.0
// What the audit log of a board's host says of commands, whatever their texts say.

#include "deploy/agent/board_audit.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "store/operate/audit.h"

namespace indurop::deploy {
namespace {

class BoardAudit : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "audit-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    ::setenv("INDUROP_STATE_DIR", name.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("INDUROP_STATE_DIR");
    std::filesystem::remove_all(folder_);
  }
  static Command command(Action action, const std::string& target) {
    Command made;
    made.board = "a";
    made.action = action;
    made.target = target;
    made.host = "desk";
    return made;
  }
  static std::vector<operate::AuditEntry> entries() { return operate::read_audit(operate::usual_audit_file(), 100); }

  std::filesystem::path folder_;
};

TEST_F(BoardAudit, No_text_of_a_command_keeps_it_out_of_the_log) {
  const std::string renewing = "0 {\"renew\":true,\"who\":\"the boss\",\"reason\":\"why\"}\n";
  for (const auto& [action, line, word] : {std::tuple(Action::SetLock, "all", "lock"),
                                           {Action::StopModule, "m", "stop"},
                                           {Action::Set, "x=1", "set"},
                                           {Action::Unforce, "x", "unforce"},
                                           {Action::AckAlarms, "x", "acknowledge alarms"}}) {
    ASSERT_EQ(note_command(command(action, renewing + line), "anna", "done"), "");
    const auto all = entries();
    ASSERT_FALSE(all.empty()) << word;
    EXPECT_EQ(all.back().action, word);
    EXPECT_EQ(all.back().what, line);
    EXPECT_EQ(all.back().who, "anna");
    EXPECT_EQ(all.back().reason, "why");
  }
  EXPECT_EQ(entries().size(), 5U);
}

TEST_F(BoardAudit, Has_renewals_that_were_refused_and_recordings_but_none_that_only_go_on) {
  ASSERT_EQ(note_command(command(Action::Force, "0 {\"renew\":true}\n"), "anna", "anna has the role look"), "");
  ASSERT_EQ(note_command(command(Action::Record, "name\nlive\n*"), "anna", "done"), "");
  ASSERT_EQ(note_command(command(Action::Record, "name\nlive\n*"), "anna", "unchanged"), "");
  const auto all = entries();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].what, "renewal");
  EXPECT_EQ(all[0].outcome, "anna has the role look");
  EXPECT_EQ(all[1].action, "record");
}

// A limit of the file size instead of a full disk.
TEST_F(BoardAudit, Says_that_a_command_cannot_be_noted) {
  ASSERT_EQ(note_command(command(Action::Set, "0 {}\nx=1"), "anna", "begun"), "");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{std::filesystem::file_size(operate::usual_audit_file()), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  const std::string problem = note_command(command(Action::Set, "0 {}\nx=2"), "anna", "begun");
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(problem, operate::usual_audit_file().string() + ": File too large");
}

}  // namespace
}  // namespace indurop::deploy
