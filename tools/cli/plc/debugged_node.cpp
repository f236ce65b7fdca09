// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debugged_node.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/program_folder.h"
#include "tools/client/process/child.h"

namespace indurop::tools {

DebuggedNode::DebuggedNode(const std::string& config, const std::filesystem::path& socket, const std::string& until)
    : name_(fmt::format("debug{}", ::getpid())), nowhere_(::open("/dev/null", O_WRONLY | O_CLOEXEC)) {
  ::setenv("INDUROP_PLC_DEBUG", socket.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): one thread
  launch_.program = base::program_folder() / "indurop";
  launch_.words = {"indurop", "run", config, "--sim", "-q", "--node", name_};
  if (!until.empty()) {
    launch_.words.insert(launch_.words.end(), {"--until", until});
  }
  launch_.fresh_signals = true;
  launch_.group = base::Launch::Group::Own;
  launch_.ends_with_us = SIGTERM;  // however this program ends: no other process knows the node
}

DebuggedNode::~DebuggedNode() {
  if (process_ != 0) {
    ::kill(process_, SIGTERM);
    constexpr int kPolls = 500;
    for (int i = 0; i < kPolls && !ended(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill_group();
  }
  (void)run_child({launch_.program.string(), "clean", "--node", name_, "-q"});
}

// No one else uses this node, and the next start of it needs nothing from this one.
void DebuggedNode::kill_group() {
  if (const pid_t process = std::exchange(process_, 0); process != 0) {
    ::kill(-process, SIGKILL);
    (void)::waitpid(process, nullptr, 0);
  }
}

bool DebuggedNode::start(bool silent) {
  kill_group();
  launch_.output = silent ? nowhere_.get() : -1;
  const auto started = base::spawn(launch_);
  process_ = started ? started.value() : 0;
  return process_ != 0;
}

std::optional<int> DebuggedNode::ended() {
  int status = 0;
  if (process_ == 0 || ::waitpid(process_, &status, WNOHANG) != process_) {
    return std::nullopt;
  }
  process_ = 0;
  return base::exit_code_of(status);
}

std::string DebuggedNode::set(const std::string& assignment, bool quiet) const {
  std::vector<std::string> words{launch_.program.string(), "set", "--node", name_, assignment};
  if (quiet) {
    words.emplace_back("-q");
  }
  const auto done = run_child(words);
  return done ? std::string() : done.error().text;
}

}  // namespace indurop::tools
