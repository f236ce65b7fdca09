// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/replayed_tick.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "config/run_options.h"
#include "core/base/descriptor.h"
#include "core/base/exit_code.h"
#include "core/base/read_file.h"
#include "core/base/spawn.h"
#include "core/base/temporary_folder.h"
#include "core/base/text.h"
#include "store/vars/store.h"
#include "tools/client/process/node_program.h"
#include "tools/client/recordings/replay_setup.h"

namespace indurop::tools {
namespace {

using base::Problem;

constexpr std::chrono::seconds kReplayTime{30};
constexpr std::chrono::milliseconds kReplayPollTime{5};

// Returns the exit code; nullopt: the node was ended because it took too long.
std::optional<int> exit_code_after(pid_t child) {
  const auto until = std::chrono::steady_clock::now() + kReplayTime;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) != child) {
    if (std::chrono::steady_clock::now() > until) {
      (void)::kill(child, SIGKILL);
      (void)::waitpid(child, &status, 0);
      return std::nullopt;
    }
    std::this_thread::sleep_for(kReplayPollTime);
  }
  return base::exit_code_of(status);
}

// Returns what the node says about the replay; what modules print is left out.
std::vector<std::string> messages_in(const std::filesystem::path& file) {
  std::vector<std::string> messages;
  const auto text = base::read_file(file);
  for (const std::string& line : text ? base::lines_of(*text) : std::vector<std::string>()) {
    for (const std::string_view kind : {"error: ", "warning: "}) {
      if (const std::size_t at = line.find(kind); at != std::string::npos) {
        messages.push_back(line.substr(at + kind.size()));
        break;
      }
    }
  }
  return messages;
}

}  // namespace

Result<ReplayedTick, Problem> replay_tick(const std::filesystem::path& file, const std::string& board,
                                          const std::filesystem::path& config, std::uint64_t tick,
                                          const std::string& node) {
  auto setup = replay_setup(file, board, config);
  if (!setup) {
    return std::move(setup).error();
  }
  const base::TemporaryFolder folder;
  const auto program = find_node_program();
  if (program.empty() || folder.path().empty()) {
    return Problem{program.empty() ? fmt::format("{} is not found", kNodeProgram) : folder.problem()};
  }
  config::RunOptions run = std::move(setup).value();
  run.quiet = true;
  run.node = node;
  run.replay.from_tick = tick;
  run.replay.to_tick = tick;
  run.replay.kept = folder.path() / "kept.json";
  const auto output_file = folder.path() / "messages";
  constexpr mode_t kMode = S_IRUSR | S_IWUSR;
  const base::Descriptor output(::open(output_file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kMode));
  base::Launch launch{
      .words = config::words_of(run), .program = program, .output = output.get(), .ends_with_us = SIGKILL};
  launch.words.insert(launch.words.begin(), kNodeProgram);
  const auto child = base::spawn(launch);
  if (!child) {
    return Problem{fmt::format("cannot start {}: {}", kNodeProgram, std::strerror(child.error().sys_errno))};
  }
  const auto code = exit_code_after(*child);
  (void)vars::remove_node(node);  // left by it if it was killed
  ReplayedTick replayed;
  replayed.messages = messages_in(output_file);
  const auto text = base::read_file(run.replay.kept);
  const auto json = text ? base::Json::parse(*text) : std::nullopt;
  if (!json || !json->is_object()) {
    const std::string why = code ? fmt::format("it ended with exit code {}", *code)
                                 : fmt::format("it has not ended for {} s", kReplayTime.count());
    return Problem{replayed.messages.empty() ? why : replayed.messages.back()};
  }
  replayed.modules = (*json)["modules"];
  base::read(*json, "differing", replayed.differing);
  return replayed;
}

}  // namespace indurop::tools
