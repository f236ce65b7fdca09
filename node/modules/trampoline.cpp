// SPDX-License-Identifier: Apache-2.0
#include "node/modules/trampoline.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/base/print.h"
#include "core/base/spawn.h"
#include "core/rt/thread.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

std::vector<std::string> environment_for(const Launch& what) {
  std::vector<std::string> result = base::environment_without({"INDUROP_NODE", "INDUROP_MODULE"});
  result.push_back("INDUROP_NODE=" + what.node);
  result.push_back("INDUROP_MODULE=" + what.module);
  return result;
}

// A module that was built elsewhere, or deployed from another machine, must find libindurop: it gets the node's own,
// with which it shares memory, unless the user's environment names another one.
void offer_own_library() {
  constexpr const char* kVariable = "LD_LIBRARY_PATH";
  Dl_info library{};
  if (::dladdr(reinterpret_cast<const void*>(&runtime::current_module), &library) == 0 ||
      library.dli_fname == nullptr) {
    return;
  }
  std::error_code error;
  const auto folder = std::filesystem::canonical(library.dli_fname, error).parent_path();
  if (!error) {
    const char* before = std::getenv(kVariable);
    const std::string first = before == nullptr || *before == '\0' ? "" : std::string(before) + ":";
    ::setenv(kVariable, (first + folder.string()).c_str(), 1);
  }
}

}  // namespace

Result<pid_t> launch(const Launch& what) {
  std::vector<std::string> words = {"indurop-node", kTrampolineFlag, std::to_string(::getpid()),
                                    std::to_string(what.core), what.file};
  words.insert(words.end(), what.arguments.begin(), what.arguments.end());
  return base::spawn({.words = std::move(words),
                      .program = "/proc/self/exe",
                      .environment = environment_for(what),
                      .group = base::Launch::Group::Own,  // Ctrl-C in the terminal only reaches the node
                      .output = what.output,
                      .fresh_signals = true});
}

int become_module(int argc, char** argv) {
  constexpr int kFirstArgument = 4;
  if (argc <= kFirstArgument) {
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != static_cast<pid_t>(std::strtol(argv[2], nullptr, 10))) {
    return 1;  // the node died before the signal was requested
  }
  if (const int core = static_cast<int>(std::strtol(argv[3], nullptr, 10)); core >= 0) {
    (void)rt::pin_to_core(core);
  }
  offer_own_library();
  ::execv(argv[kFirstArgument], argv + kFirstArgument);
  base::print(stderr, "indurop-node: error: cannot run {}: {}\n", argv[kFirstArgument], std::strerror(errno));
  return 127;
}

}  // namespace indurop::node
