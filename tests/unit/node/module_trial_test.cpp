// SPDX-License-Identifier: Apache-2.0
// What the end of the process that loads a file first says about the file. The processes of this test end as those do.
#include "node/exchange/module_trial.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

namespace indurop::node {
namespace {

using testing::HasSubstr;
using testing::Not;

int status_of(const std::function<void()>& end) {
  const pid_t child = ::fork();
  if (child == 0) {
    end();
    std::_Exit(0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

TEST(ModuleTrial, Blames_what_ended_the_process) {
  EXPECT_EQ(trial_failure(status_of([] { std::_Exit(93); })), "");
  EXPECT_THAT(trial_failure(status_of([] { std::_Exit(0); })),
              HasSubstr("exit code 0: one of its static constructors"));
  EXPECT_THAT(trial_failure(status_of([] { (void)std::raise(SIGKILL); })), HasSubstr("ended by signal 9"));
}

TEST(ModuleTrial, Does_not_blame_the_file_alone_if_no_program_ran) {
  const std::string text =
      trial_failure(status_of([] { std::_Exit(::execl("/nowhere/indurop-node", "x", nullptr) == -1 ? 127 : 0); }));
  EXPECT_THAT(text, HasSubstr("no process could be started to load it first"));
  EXPECT_THAT(text, Not(HasSubstr("a process that loaded it")));
}

}  // namespace
}  // namespace indurop::node
