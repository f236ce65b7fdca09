// SPDX-License-Identifier: Apache-2.0
#include "node/trampoline.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "rt/thread.h"
#include "runtime/host.h"

namespace indurop::node {
namespace {

std::vector<std::string> environment_for(const Launch& what) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!text.starts_with("INDUROP_NODE=") && !text.starts_with("INDUROP_MODULE=")) {
      result.emplace_back(text);
    }
  }
  result.push_back("INDUROP_NODE=" + what.node);
  result.push_back("INDUROP_MODULE=" + what.module);
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) {
    result.push_back(text.data());
  }
  result.push_back(nullptr);
  return result;
}

// A module that was built in another place, or deployed from another machine, has to find libindurop: it gets the
// node's own, whose memory it shares, unless the user's environment names another one.
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
  std::vector<std::string> variables = environment_for(what);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none;
  ::sigemptyset(&none);
  sigset_t all;
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C in the terminal is for the node alone
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const auto argument_pointers = pointers(words);
  const auto variable_pointers = pointers(variables);
  const int code = ::posix_spawn(&process, "/proc/self/exe", nullptr, &attributes, argument_pointers.data(),
                                 variable_pointers.data());
  ::posix_spawnattr_destroy(&attributes);
  if (code != 0) {
    return Error{Errc::System, code, "start a process module"};
  }
  return process;
}

int become_module(int argc, char** argv) {
  constexpr int kFirstArgument = 4;
  if (argc <= kFirstArgument) {
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != static_cast<pid_t>(std::strtol(argv[2], nullptr, 10))) {
    return 1;  // the node died before we asked to be told
  }
  if (const int core = static_cast<int>(std::strtol(argv[3], nullptr, 10)); core >= 0) {
    (void)rt::pin_to_core(core);
  }
  offer_own_library();
  ::execv(argv[kFirstArgument], argv + kFirstArgument);
  fmt::print(stderr, "indurop-node: error: cannot run {}: {}\n", argv[kFirstArgument], std::strerror(errno));
  return 127;
}

}  // namespace indurop::node
