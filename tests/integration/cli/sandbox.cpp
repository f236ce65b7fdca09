// SPDX-License-Identifier: Apache-2.0
#include "sandbox.h"

#include <sys/mount.h>
#include <unistd.h>

#include <utility>

namespace indurop::test {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path path = fs::temp_directory_path() / ("indurop_cli_test." + std::to_string(getpid()));
  pid_t owner = getpid();
  Scratch() { fs::create_directories(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    if (getpid() == owner) {
      std::error_code error;
      fs::remove_all(path, error);
    }
  }
};

Environment with_state(Environment environment) {
  environment.variables.insert(environment.variables.begin(), "INDUROP_STATE_DIR=" + (scratch() / "state").string());
  return environment;
}

}  // namespace

bool enter_sandbox() {
  static const bool kPrivate = own_mounts() && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  return kPrivate && ::mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "size=64m,mode=1777") == 0;
}

fs::path scratch() {
  static const Scratch kScratch;
  return kScratch.path;
}

std::vector<std::string> indurop_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{INDUROP_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

std::vector<std::string> fake_node(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> command{FAKE_NODE_PROGRAM, name};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

Outcome indurop(const std::vector<std::string>& arguments, Environment environment) {
  return Program(indurop_command(arguments), with_state(std::move(environment))).finish();
}

Environment background() {
  return with_state({.one_output = true});
}

}  // namespace indurop::test
