// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/module_trial.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "node/modules/trampoline.h"
#include "node/run/ending.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kTrialLimit{10};
constexpr std::chrono::milliseconds kTrialPoll{1};
// Not one that a static constructor is likely to pass to exit().
constexpr int kWasLoaded = 93;
constexpr int kNotRun = 127;  // see become_module()

// Returns the status of its end; nothing if it has not ended within the limit.
std::optional<int> wait_for_end(pid_t process) {
  const rt::MonoTime end = rt::MonoClock::now() + kTrialLimit;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) != process) {
    if (rt::MonoClock::now() > end) {
      return std::nullopt;
    }
    rt::sleep_until(rt::MonoClock::now() + kTrialPoll);
  }
  return status;
}

}  // namespace

std::string trial_failure(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return fmt::format(
        "a process that loaded it ended by signal {} ({}): the file is damaged, or one of its static "
        "constructors or destructors crashes or throws",
        number, ::strsignal(number));  // NOLINT(concurrency-mt-unsafe): glibc's is safe
  }
  switch (WEXITSTATUS(status)) {
    case kWasLoaded:
      return {};
    case kNotRun:
      return fmt::format(
          "no process could be started to load it first (exit code {}): indurop-node cannot be executed again, or a "
          "static constructor of the file calls exit({})",
          kNotRun, kNotRun);
    default:
      return fmt::format(
          "a process that loaded it ended with exit code {}: one of its static constructors calls exit()",
          WEXITSTATUS(status));
  }
}

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
    return fmt::format("no process could be started to load it first: {}", describe(started.error()));
  }
  if (const auto status = wait_for_end(*started); status) {
    return trial_failure(*status);
  }
  ::kill(*started, SIGKILL);
  ::waitpid(*started, nullptr, 0);
  return fmt::format("a process that loads it does not end within {} s: one of its static constructors does not return",
                     kTrialLimit.count());
}

Result<ModuleLibrary, base::Problem> load_apart(const std::filesystem::path& file, std::uint32_t module) {
  constexpr std::size_t kStack = std::size_t{8} * 1024 * 1024;
  Result<ModuleLibrary, base::Problem> result = base::Problem{"no thread could be started to load it"};
  auto thread = rt::Thread::start({"irp-load", 0, -1, kStack}, [&] {
    ModuleLibrary library;
    runtime::set_current_module(module);
    const auto loaded = library.load(file, true);
    runtime::set_current_module(runtime::kNoModule);
    result = loaded ? Result<ModuleLibrary, base::Problem>(std::move(library)) : loaded.error();
  });
  if (thread) {
    thread.value().join();
  }
  return result;
}

void load_on_trial(int argc, char** argv) {
  constexpr int kFile = 2;
  if (argc > kFile) {
    if (auto library = load_apart(argv[kFile], runtime::kNoModule)) {
      std::vector<std::byte> state(library->memory().most());
      (void)library->memory().save(state);  // reads what the module describes
      (void)library->unload();              // a node does, too: when it rejects the version, and in the end
    }
    std::_Exit(kWasLoaded);
  }
  std::_Exit(2);
}

}  // namespace indurop::node
