// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/shadow/shadow_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "config/run_options.h"
#include "core/base/descriptor.h"
#include "core/base/program_folder.h"
#include "core/base/read_file.h"
#include "core/base/spawn.h"
#include "core/base/temporary_folder.h"
#include "core/base/text.h"
#include "core/rt/clock.h"
#include "store/vars/store.h"
#include "tools/cli/command/node_program.h"
#include "tools/client/node/module_command.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr rlim_t kProcessorSeconds = 60;  // of each process
constexpr std::int64_t kPatienceNs = 120'000'000'000;
constexpr std::int64_t kChildPollNs = 10'000'000;
constexpr int kLowest = 19;

// What is inherited by the processes that are started: they give way to all others, and if memory runs out, they end
// first.
void become_expendable(const std::string& node) {
  be_gentle(node);
  (void)::setpriority(PRIO_PROCESS, 0, kLowest);
  const rlimit limit{kProcessorSeconds, kProcessorSeconds};
  (void)::setrlimit(RLIMIT_CPU, &limit);
  std::ofstream("/proc/self/oom_score_adj") << "1000";
}

// Returns the exit code, 128 + number after a signal. It is ended when it takes longer than that, or is interrupted.
Result<int, Failure> run_expendable(const base::Launch& launch, std::int64_t most_ns) {
  const auto child = base::spawn(launch);
  if (!child) {
    return Failure{kFailed,
                   fmt::format("cannot start {}: {}", launch.words.front(), std::strerror(child.error().sys_errno))};
  }
  const std::int64_t end = rt::now_ns() + most_ns;
  int status = 0;
  for (;;) {
    const pid_t ended = ::waitpid(*child, &status, WNOHANG);
    if (ended == *child) {
      return base::exit_code_of(status);
    }
    if ((ended < 0 && errno != EINTR) || interrupted() || rt::now_ns() > end) {
      break;
    }
    (void)wait_until(rt::now_ns() + kChildPollNs);
  }
  (void)::kill(*child, SIGKILL);
  (void)::waitpid(*child, &status, 0);
  return interrupted() ? Failure{interrupt_code(), "interrupted: nothing was exchanged"}
                       : Failure{kFailed, fmt::format("{} has not ended for {} s", launch.words.front(),
                                                      most_ns / rt::kNanosPerSecond)};
}

Result<void, Failure> record(const std::string& node, const std::filesystem::path& file, std::int64_t duration_ns) {
  const auto program = base::program_folder() / "indurop";
  const base::Launch launch{.words = {"indurop", "record", "-q", "--node", node, "--duration",
                                      fmt::format("{}ns", duration_ns), "--file", file.string()},
                            .program = program,
                            .ends_with_us = SIGKILL};
  const auto code = run_expendable(launch, duration_ns + kPatienceNs);
  if (!code) {
    return code.error();
  }
  return *code == kOk ? Result<void, Failure>()
                      : Failure{*code, "the runs of the node could not be recorded: nothing was compared"};
}

// What modules print is not shown; what the node says about them is.
void show_messages(Context& context, const std::filesystem::path& file) {
  const auto text = base::read_file(file);
  for (const std::string& line : text ? base::lines_of(*text) : std::vector<std::string>()) {
    if (line.find(": error: ") != std::string::npos || line.find(": warning: ") != std::string::npos) {
      context.out.message_line(printable(line));
    }
  }
}

// Runs the recording again with the new file. Returns the exit code.
Result<int, Failure> repeat(Context& context, const std::filesystem::path& program, const config::RunOptions& options) {
  const std::filesystem::path messages = options.replay.report.parent_path() / "messages";
  constexpr mode_t kMode = S_IRUSR | S_IWUSR;
  const base::Descriptor output(::open(messages.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kMode));
  base::Launch launch{
      .words = config::words_of(options), .program = program, .output = output.get(), .ends_with_us = SIGKILL};
  launch.words.insert(launch.words.begin(), "indurop-node");
  const auto code = run_expendable(launch, kPatienceNs);
  show_messages(context, messages);
  (void)vars::remove_node(options.node);  // left by it if it was killed, or by an earlier one
  return code;
}

std::string shadow_node(const std::string& node) {
  constexpr std::size_t kMaxName = 40;
  const std::string ending = "-shadow";
  return node.substr(0, kMaxName - ending.size()) + ending;
}

std::string why_ended(int code) {
  constexpr int kSignalled = 128;
  if (code == kSignalled + SIGXCPU || code == kSignalled + SIGKILL) {
    return fmt::format("it was ended, after {} s of processor time or because memory ran out", kProcessorSeconds);
  }
  return code > kSignalled ? fmt::format("it ended its process ({})", ::strsignal(code - kSignalled))
                           : "it cannot be repeated";
}

}  // namespace

Result<ShadowReport, Failure> run_shadow(Context& context, const ShadowRequest& request) {
  const auto program = node_program(context);
  const auto run = open_run(request.node);
  if (program.empty() || !run) {
    return run ? Failure{kFailed, "a shadow needs indurop-node"} : run.error();
  }
  const auto index = find_module(run->run, request.node, request.module);
  if (!index) {
    return index.error();
  }
  const std::string file = request.file.empty() ? fixed_text(run->run.module(*index).file) : request.file;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return Failure{kCheckFailed, fmt::format("{}: no such file; build it, or correct its name", file)};
  }
  const base::TemporaryFolder folder;
  if (folder.path().empty()) {
    return Failure{kFailed, folder.problem()};
  }
  become_expendable(request.node);
  config::RunOptions options;
  options.quiet = true;
  options.node = shadow_node(request.node);
  options.board = fixed_text(run->run.block().board);
  options.config =
      options.board.empty() ? fixed_text(run->run.block().config_file) : fixed_text(run->run.block().plant_file);
  options.replay.file = folder.path() / "runs.mcap";
  options.replay.report = folder.path() / "shadow.json";
  options.replay.with = {request.module + "=" + file};
  if (const auto recorded = record(request.node, options.replay.file, request.duration_ns); !recorded) {
    return recorded.error();
  }
  const auto code = repeat(context, program, options);
  if (!code) {
    return code.error();
  }
  const auto text = base::read_file(options.replay.report);
  auto report = text && *code == kOk ? read_shadow_report(*text) : std::nullopt;
  if (!report) {
    return Failure{kFailed, fmt::format("module '{}': not exchanged: as a shadow of the running version, {}",
                                        request.module, why_ended(*code))};
  }
  return *std::move(report);
}

}  // namespace indurop::tools
