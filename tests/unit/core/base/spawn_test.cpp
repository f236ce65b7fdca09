// SPDX-License-Identifier: Apache-2.0
#include "core/base/spawn.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "core/base/descriptor.h"

namespace indurop::base {
namespace {

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    read = Descriptor(ends[0]);
    write = Descriptor(ends[1]);
  }
  // All output until no process can write any more.
  std::string rest() {
    write = Descriptor();
    std::string text;
    std::array<char, 256> block{};
    for (ssize_t got = 0; (got = ::read(read.get(), block.data(), block.size())) > 0;) {
      text.append(block.data(), static_cast<std::size_t>(got));
    }
    return text;
  }
  Descriptor read;
  Descriptor write;
};

int end_of(const Result<pid_t>& child) {
  int status = 0;
  EXPECT_TRUE(child.ok());
  EXPECT_EQ(::waitpid(*child, &status, 0), *child);
  return exit_code_of(status);
}

// What /bin/sh says when it runs `script`.
std::string said(Launch launch, const std::string& script) {
  Pipe pipe;
  launch.program = "/bin/sh";
  launch.words = {"sh", "-c", script};
  launch.output = pipe.write.get();
  const auto child = spawn(launch);
  std::string text = pipe.rest();
  EXPECT_EQ(end_of(child), 0);
  return text;
}

// Both ways of starting do the same.
class Spawn : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static Launch launch() {
    Launch made;
    made.ends_with_us = GetParam();
    return made;
  }
};

TEST_P(Spawn, Tells_the_exit_code_and_the_signal) {
  Launch sut = launch();
  sut.words = {"sh", "-c", "exit 7"};
  EXPECT_EQ(end_of(spawn(sut)), 7);
  sut.words = {"sh", "-c", "kill -TERM $$"};
  EXPECT_EQ(end_of(spawn(sut)), 128 + SIGTERM);
}

// As a program that was started by one that ignores it.
TEST_P(Spawn, Tells_the_exit_code_although_ends_of_children_were_ignored) {
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  Launch sut = launch();
  sut.words = {"sh", "-c", "exit 7"};
  EXPECT_EQ(end_of(spawn(sut)), 7);
  (void)std::signal(SIGCHLD, handler);
}

TEST_P(Spawn, Passes_arguments_and_both_outputs) {
  EXPECT_EQ(said(launch(), "echo a; echo 'b  c' >&2"), "a\nb  c\n");
}

TEST_P(Spawn, Separates_the_outputs_if_asked) {
  Pipe errors;
  Launch sut = launch();
  sut.errors = errors.write.get();
  EXPECT_EQ(said(sut, "echo a; echo b >&2"), "a\n");
  EXPECT_EQ(errors.rest(), "b\n");
}

TEST_P(Spawn, Uses_the_environment_that_is_given) {
  Launch sut = launch();
  sut.environment = {"ONLY=this"};
  EXPECT_EQ(said(sut, "echo $ONLY$HOME"), "this\n");
}

TEST_P(Spawn, Makes_a_group_or_a_session_of_its_own) {
  const std::string script = "set -- $(cut -d' ' -f5,6 /proc/$$/stat); echo $(($1==$$)) $(($2==$$))";
  Launch sut = launch();
  EXPECT_EQ(said(sut, script), "0 0\n");
  sut.group = Launch::Group::Own;
  EXPECT_EQ(said(sut, script), "1 0\n");
  sut.group = Launch::Group::OwnSession;
  EXPECT_EQ(said(sut, script), "1 1\n");
}

TEST_P(Spawn, Signals_are_fresh_if_asked) {
  const auto handler = std::signal(SIGPIPE, SIG_IGN);
  // A shell may ignore further signals itself.
  const auto ignores_pipe = [](const Launch& sut) {
    const std::string mask = said(sut, "grep SigIgn /proc/self/status | cut -f2");
    return (std::stoull(mask, nullptr, 16) >> (SIGPIPE - 1) & 1U) != 0;
  };
  Launch sut = launch();
  EXPECT_TRUE(ignores_pipe(sut));
  sut.fresh_signals = true;
  EXPECT_FALSE(ignores_pipe(sut));
  (void)std::signal(SIGPIPE, handler);
}

TEST_P(Spawn, Passes_on_the_file_that_is_named_and_no_other) {
  Pipe given;
  Pipe other;
  Launch sut = launch();
  sut.inherits = given.read.get();
  const std::string script = "for n in " + std::to_string(given.read.get()) + " " + std::to_string(other.read.get()) +
                             "; do test -e /proc/self/fd/$n && echo yes || echo no; done";
  EXPECT_EQ(said(sut, script), "yes\nno\n");
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutFork, Spawn, ::testing::Values(0, SIGKILL));

TEST(SpawnErrors, A_missing_program_is_reported) {
  const auto sut = spawn({.words = {"x"}, .program = "/nosuch/program"});
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().sys_errno, ENOENT);
  EXPECT_FALSE(spawn({.words = {"no such program"}, .program = {}}).ok());
}

TEST(SpawnErrors, A_program_that_is_to_end_with_us_does) {
  Pipe pipe;
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    Launch launch;
    launch.words = {"sleep", "60"};
    launch.output = pipe.write.get();
    launch.ends_with_us = SIGKILL;
    ::_exit(spawn(launch).ok() ? 0 : 1);
  }
  // The end of the pipe comes when the last one that could write, the sleeper, is gone.
  EXPECT_EQ(pipe.rest(), "");
  int status = 0;
  EXPECT_EQ(::waitpid(parent, &status, 0), parent);
  while (::waitpid(-1, &status, 0) > 0) {
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

}  // namespace
}  // namespace indurop::base
