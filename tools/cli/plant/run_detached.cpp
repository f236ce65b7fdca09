// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/run_detached.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/read_file.h"
#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "store/vars/retain.h"
#include "tools/client/node/run_view.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kStartPollNs = 20'000'000;

// Returns the node's name, determined in the same way as by the node itself.
std::string name_of(const config::RunOptions& options) {
  if (!options.node.empty()) {
    return options.node;
  }
  const char* environment = std::getenv("INDUROP_NODE");
  if (environment != nullptr && *environment != '\0') {
    return environment;
  }
  return options.board.empty() ? vars::default_node() : options.board;
}

bool runs(const std::string& node, pid_t pid) {
  const auto run = RunView::open(node);
  return run.ok() && run->block().node_pid.load() == pid && run->block().state.load() == scheduler::NodeState::Running;
}

// The node ended before its modules ran: prints its output, returns its exit code.
int report_end(Context& context, const std::string& node, const std::filesystem::path& log, int status) {
  if (const auto text = base::read_file(log); text.ok()) {
    context.out.message_line(std::string_view(*text).substr(0, text->find_last_not_of('\n') + 1));
  }
  const int code = base::exit_code_of(status);
  if (code == kOk) {
    context.out.note(fmt::format("node '{}' has ended already", node));
  }
  return code;
}

}  // namespace

int run_detached(Context& context, const std::filesystem::path& program, const config::RunOptions& options) {
  const std::string node = name_of(options);
  const std::filesystem::path log = vars::state_directory(node) / "node.log";
  if (const pid_t holder = vars::running_node(node); holder != 0) {
    context.out.error(
        fmt::format("node '{}' runs already (pid {}); stop it first: indurop stop --node {}", node, holder, node));
    return kFailed;
  }
  std::error_code error;
  std::filesystem::create_directories(log.parent_path(), error);
  const base::Descriptor output(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644));
  if (output.get() < 0) {
    context.out.error(fmt::format("cannot write {}: {}; choose another place with INDUROP_STATE_DIR", log.string(),
                                  std::strerror(errno)));
    return kFailed;
  }
  std::vector<std::string> words = config::words_of(options);
  words.insert(words.begin(), program.string());
  const auto pid = base::spawn({.words = std::move(words),
                                .program = program,
                                .group = base::Launch::Group::OwnSession,
                                .output = output.get(),
                                .fresh_signals = true});
  if (!pid.ok()) {
    context.out.error(fmt::format("cannot start {}: {}", program.string(), std::strerror(pid.error().sys_errno)));
    return kFailed;
  }
  for (;;) {
    int status = 0;
    if (::waitpid(*pid, &status, WNOHANG) == *pid) {
      return report_end(context, node, log, status);
    }
    if (runs(node, *pid)) {
      context.out.note(fmt::format("node '{}' runs (pid {}); its messages: {}", node, *pid, log.string()));
      return kOk;
    }
    wait_until(rt::now_ns() + kStartPollNs);
    if (interrupted()) {
      ::kill(*pid, SIGTERM);
      ::waitpid(*pid, &status, 0);
      return interrupt_code();
    }
  }
}

}  // namespace indurop::tools
