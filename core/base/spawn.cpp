// SPDX-License-Identifier: Apache-2.0
#include "core/base/spawn.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "core/base/stop_signal.h"

namespace indurop::base {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> all;
  all.reserve(words.size() + 1);
  for (const std::string& word : words) {
    all.push_back(const_cast<char*>(word.c_str()));  // NOLINT(cppcoreguidelines-pro-type-const-cast): POSIX
  }
  all.push_back(nullptr);
  return all;
}

// The C library's description of the actions of a child before it becomes the program.
class Preparation {
 public:
  explicit Preparation(const Launch& launch) {
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawn_file_actions_init(&actions_);
    unsigned int flags = 0;
    if (launch.fresh_signals) {
      sigset_t none;
      ::sigemptyset(&none);
      sigset_t all;
      ::sigfillset(&all);
      ::posix_spawnattr_setsigmask(&attributes_, &none);
      ::posix_spawnattr_setsigdefault(&attributes_, &all);
      flags |= POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    }
    flags |= launch.group == Launch::Group::Own ? POSIX_SPAWN_SETPGROUP : 0U;  // 0 as it is: a group of its own
    flags |= launch.group == Launch::Group::OwnSession ? POSIX_SPAWN_SETSID : 0U;
    ::posix_spawnattr_setflags(&attributes_, static_cast<short>(flags));
    if (launch.input >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, launch.input, STDIN_FILENO);
    }
    if (launch.output >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, launch.output, STDOUT_FILENO);
      ::posix_spawn_file_actions_adddup2(&actions_, launch.output, STDERR_FILENO);
    }
    if (launch.errors >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, launch.errors, STDERR_FILENO);
    }
    if (launch.inherits >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, launch.inherits, launch.inherits);  // clears O_CLOEXEC
    }
  }
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;
  ~Preparation() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
  }
  [[nodiscard]] const posix_spawnattr_t* attributes() const noexcept { return &attributes_; }
  [[nodiscard]] const posix_spawn_file_actions_t* actions() const noexcept { return &actions_; }

 private:
  posix_spawnattr_t attributes_{};
  posix_spawn_file_actions_t actions_{};
};

// Between fork and exec: only calls that are safe in a copy of a process with threads.
[[noreturn]] void become(const Launch& launch, pid_t parent, char* const* words, char* const* environment) noexcept {
  constexpr int kNotRun = 127;
  if (launch.group == Launch::Group::Own) {
    ::setpgid(0, 0);
  } else if (launch.group == Launch::Group::OwnSession) {
    ::setsid();
  }
  ::prctl(PR_SET_PDEATHSIG, launch.ends_with_us);
  if (::getppid() != parent) {
    ::_exit(1);  // the parent ended before the signal was requested
  }
  if (launch.fresh_signals) {
    for (int number = 1; number < NSIG; ++number) {
      (void)::signal(number, SIG_DFL);
    }
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
  }
  if (launch.input >= 0) {
    ::dup2(launch.input, STDIN_FILENO);
  }
  if (launch.output >= 0) {
    ::dup2(launch.output, STDOUT_FILENO);
    ::dup2(launch.output, STDERR_FILENO);
  }
  if (launch.errors >= 0) {
    ::dup2(launch.errors, STDERR_FILENO);
  }
  if (launch.inherits >= 0) {
    (void)::fcntl(launch.inherits, F_SETFD, 0);
  }
  if (launch.program.empty()) {
    ::execvpe(words[0], words, environment);
  } else {
    ::execve(launch.program.c_str(), words, environment);
  }
  ::_exit(kNotRun);
}

}  // namespace

void keep_ends_of_children() noexcept {
  if (is_ignored(SIGCHLD)) {
    (void)::signal(SIGCHLD, SIG_DFL);
  }
}

std::vector<std::string> environment_without(std::initializer_list<std::string_view> names) {
  std::vector<std::string> kept;
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string_view entry(*one);
    if (std::find(names.begin(), names.end(), entry.substr(0, entry.find('='))) == names.end()) {
      kept.emplace_back(entry);
    }
  }
  return kept;
}

Result<pid_t> spawn(const Launch& launch) {
  keep_ends_of_children();
  const auto failed = [](int error) { return Error{Errc::System, error, "start a program"}; };
  const std::vector<char*> words = pointers(launch.words);
  const std::vector<char*> given = launch.environment ? pointers(*launch.environment) : std::vector<char*>{};
  char* const* environment = launch.environment ? given.data() : environ;
  if (launch.ends_with_us != 0) {
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
      become(launch, parent, words.data(), environment);
    }
    if (child < 0) {
      return failed(errno);
    }
    return child;
  }
  const Preparation made(launch);
  pid_t child = -1;
  const int error =
      launch.program.empty()
          ? ::posix_spawnp(&child, words[0], made.actions(), made.attributes(), words.data(), environment)
          : ::posix_spawn(&child, launch.program.c_str(), made.actions(), made.attributes(), words.data(), environment);
  if (error != 0) {
    return failed(error);
  }
  return child;
}

int exit_code_of(int wait_status) noexcept {
  constexpr int kSignalled = 128;
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : kSignalled + WTERMSIG(wait_status);
}

}  // namespace indurop::base
