// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/module_trial.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "node/modules/module_library.h"
#include "node/modules/trampoline.h"

namespace indurop::node {
namespace {

constexpr int kTrialLimitMs = 10'000;
// Not one that a static constructor is likely to pass to exit().
constexpr int kWasLoaded = 93;

std::string describe_end(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return fmt::format(
        "a process that loaded it ended by signal {} ({}): the file is damaged, or one of its static "
        "constructors crashes or throws",
        number, ::strsignal(number));  // NOLINT(concurrency-mt-unsafe): glibc's is safe
  }
  return WEXITSTATUS(status) == kWasLoaded
             ? std::string()
             : fmt::format(
                   "a process that loaded it ended with exit code {}: one of its static constructors calls "
                   "exit()",
                   WEXITSTATUS(status));
}

// Returns false if it has not ended within the limit.
bool wait_for_end(pid_t process) {
  const auto descriptor = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));  // <sys/pidfd.h> is not for C++
  pollfd ends{descriptor, POLLIN, 0};
  int ready = 0;
  do {
    ready = ::poll(&ends, 1, kTrialLimitMs);
  } while (ready < 0 && errno == EINTR);
  ::close(descriptor);
  return ready == 1;
}

}  // namespace

std::string try_module(const std::filesystem::path& file) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  // Under a name that no node has: its static constructors must not write what this node uses.
  const auto started = launch({.file = "/proc/self/exe",
                               .arguments = {kTrialFlag, file.string()},
                               .node = fmt::format("trial-{}", ::getpid()),
                               .module = "",
                               .output = nowhere});
  ::close(nowhere);
  if (!started) {
    return fmt::format("no process could be started to load it first: {}", started.error().where);
  }
  const bool ended = wait_for_end(*started);
  if (!ended) {
    ::kill(*started, SIGKILL);
  }
  int status = 0;
  ::waitpid(*started, &status, 0);
  return ended ? describe_end(status)
               : fmt::format(
                     "a process that loads it does not end within {} s: one of its static constructors does "
                     "not return",
                     kTrialLimitMs / 1000);
}

void load_on_trial(int argc, char** argv) {
  constexpr int kFile = 2;
  if (argc > kFile) {
    ModuleLibrary library;
    (void)library.load(argv[kFile], true);
    std::_Exit(kWasLoaded);
  }
  std::_Exit(2);
}

}  // namespace indurop::node
