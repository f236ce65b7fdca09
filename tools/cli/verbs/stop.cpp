// SPDX-License-Identifier: Apache-2.0
// indurop stop: requests the node to end and waits until it has. For single modules and boards: plant/commands.h.
#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <csignal>

#include <cerrno>
#include <cstring>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "tools/cli/plant/commands.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

// A process handle that cannot refer to another process later.
class ProcessHandle {
 public:
  explicit ProcessHandle(pid_t pid) : file_(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))) {}
  ProcessHandle(const ProcessHandle&) = delete;
  ProcessHandle& operator=(const ProcessHandle&) = delete;
  ~ProcessHandle() {
    if (file_ >= 0) {
      close(file_);
    }
  }
  [[nodiscard]] int file() const noexcept { return file_; }
  // Returns 0 or errno.
  [[nodiscard]] int send(int signal) const noexcept {
    return syscall(SYS_pidfd_send_signal, file_, signal, nullptr, 0) == 0 ? 0 : errno;
  }

 private:
  int file_;
};

int stop_node(Context& context, const CommandOptions& options) {
  const auto chosen = choose_node(context.node);
  if (!chosen) {
    return report(context.out, chosen.error());
  }
  const std::string& node = *chosen;
  const pid_t pid = vars::running_node(node);
  const ProcessHandle process(pid);
  // Checked again after the handle was opened: the handle must refer to the node, not to a later process with the same
  // number.
  if (pid == 0 || process.file() < 0 || vars::running_node(node) != pid) {
    context.out.note(fmt::format("node '{}' does not run", node));
    return kOk;
  }
  const int problem = process.send(SIGTERM);
  if (problem != 0 && problem != ESRCH) {
    context.out.error(fmt::format("cannot stop node '{}' (pid {}): {}", node, pid, std::strerror(problem)));
    return kFailed;
  }
  const std::int64_t begin = rt::now_ns();
  while (vars::running_node(node) == pid) {
    switch (wait_until(begin + options.timeout_ns, process.file())) {
      case Woken::Readable:
        break;
      case Woken::Signal:
        if (interrupted()) {
          return kOk;
        }
        break;
      case Woken::Deadline:
        context.out.error(
            fmt::format("node '{}' (pid {}) has not ended after {}. It was asked to; to end it at once: kill -9 {}",
                        node, pid, human_age(options.timeout_ns), pid));
        return kUnreachable;
    }
  }
  context.out.note(fmt::format("node '{}' stopped after {}", node, human_ns(rt::now_ns() - begin)));
  return kOk;
}

Action declare_stop(base::Options& app, Context& context) {
  auto options = std::make_shared<CommandOptions>();
  add_command_options(app, context, *options);
  return [options](Context& c) {
    return options->targets.empty() ? stop_node(c, *options) : carry_out(c, scheduler::ModuleCommand::Stop, *options);
  };
}

}  // namespace

const Verb kStopVerb{
    "stop", "Start and stop", "Stop a node and wait until it has ended, or stop modules of it",
    "Calls stop() of the modules and writes retained values. Exit code 6 if the node has not ended in time; 0 if\n"
    "it was not running.\n"
    "With MODULE, the node continues without the module: its place in the schedule stays empty, its stop() is\n"
    "called in the background, then its fail-safe values are written. It stays stopped until indurop start or the\n"
    "next start of the node. MODULE@BOARD and @BOARD (its node) use the agent of a board in the network; the\n"
    "command is signed with --keys if the board has keys. A board stopped this way starts again by command, with\n"
    "the next deployment, or when it is switched on again. Exit code 1 if the command was rejected, 6 if the\n"
    "board or node did not answer in time.\n"
    "Examples:\n"
    "  indurop stop\n"
    "  indurop stop gripper\n"
    "  indurop stop gripper@control --interface eth1\n"
    "  indurop stop @control\n",
    &declare_stop};

}  // namespace indurop::tools
