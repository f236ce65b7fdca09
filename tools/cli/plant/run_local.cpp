// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/run_local.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "tools/cli/plant/local_pools.h"
#include "tools/client/process/interrupt.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kEndPollNs = 20'000'000;
constexpr std::int64_t kEndGraceNs = 10'000'000'000;  // a node gives its own modules and processes a few seconds to end

struct Child {
  std::string board;
  pid_t pid = -1;
};

// Returns "r.left.json" for "r.json" and board "left".
std::string file_of(const std::filesystem::path& file, const std::string& board) {
  auto named = file;
  named.replace_extension("." + board + file.extension().string());
  return named.string();
}

// `core` is for boards that name none, unless the user did.
std::vector<std::string> command(const std::filesystem::path& program, const config::Board& board, int core,
                                 config::RunOptions options) {
  options.board = board.name;
  options.one_host = true;
  if (!options.report.empty()) {
    options.report = file_of(options.report, board.name);
  }
  if (!options.record.empty()) {
    options.record = file_of(options.record, board.name);
  }
  if (!options.core && board.config.core < 0) {
    options.core = core;
  }
  std::vector<std::string> words = config::words_of(options);
  words.insert(words.begin(), program.string());
  return words;
}

Result<pid_t> launch(std::vector<std::string> words) {
  const std::string program = words[0];
  return base::spawn({.words = std::move(words),
                      .program = program,
                      .group = base::Launch::Group::Own,  // Ctrl-C reaches only this program, which ends the boards
                      .fresh_signals = true,
                      .ends_with_us = SIGTERM});
}

class Plant {
 public:
  Plant(Context& context, std::string file, std::vector<Child> children)
      : context_(context), plant_(std::move(file)), children_(std::move(children)), pools_(context) {}

  void send_pools(const config::Plant& plant, const std::filesystem::path& folder) { pools_.start(plant, folder); }

  int run() {
    while (running() > 0) {
      wait_until(rt::now_ns() + kEndPollNs);
      pools_.collect();
      if (interrupted()) {
        end_all(SIGINT);
        return interrupt_code();
      }
      if (const int code = collect(true); code != kOk) {
        end_all(SIGTERM);
        return code;
      }
    }
    return killed_ ? kFailed : kOk;
  }

  void end_all(int signal) {
    pools_.end();
    for (const Child& child : children_) {
      if (child.pid > 0) {
        ::kill(child.pid, signal);
      }
    }
    const std::int64_t deadline = rt::now_ns() + kEndGraceNs;
    while (running() > 0 && rt::now_ns() < deadline) {
      rt::sleep_until(rt::now_ns() + kEndPollNs);
      (void)collect(false);
    }
    for (const Child& child : children_) {
      if (child.pid > 0) {
        context_.out.error(fmt::format("board {} did not end within {} s and was killed", child.board,
                                       kEndGraceNs / rt::kNanosPerSecond));
        ::kill(child.pid, SIGKILL);
        ::waitpid(child.pid, nullptr, 0);
      }
    }
  }

 private:
  [[nodiscard]] std::ptrdiff_t running() const {
    return std::count_if(children_.begin(), children_.end(), [](const Child& child) { return child.pid > 0; });
  }

  // Collects boards that have ended: returns the first exit code that is not 0. One that was killed is treated like a
  // board without power: the others continue.
  int collect(bool report_ends) {
    int code = kOk;
    for (Child& child : children_) {
      int status = 0;
      if (child.pid <= 0 || ::waitpid(child.pid, &status, WNOHANG) != child.pid) {
        continue;
      }
      child.pid = -1;
      if (WIFSIGNALED(status)) {
        killed_ = true;
        if (report_ends) {
          context_.out.error(fmt::format(
              "board {} was ended by signal {} ({}), the others go on; bring it back with indurop run {} --board {} "
              "--one-host",
              child.board, WTERMSIG(status), ::strsignal(WTERMSIG(status)), plant_, child.board));
        }
        continue;
      }
      const int its = WEXITSTATUS(status);
      if (its != kOk && report_ends) {
        context_.out.error(fmt::format("board {} ended with exit code {}; ending the others", child.board, its));
      }
      code = code == kOk ? its : code;
    }
    return code;
  }

  Context& context_;
  std::string plant_;
  std::vector<Child> children_;
  LocalPools pools_;
  bool killed_ = false;
};

}  // namespace

int run_local(Context& context, const std::filesystem::path& program, const config::RunOptions& options) {
  const std::filesystem::path& plant = options.config;
  config::ReadPlant read = config::read_plant(plant);
  std::vector<base::Diagnostic> diagnostics = read.diagnostics;
  bool ok = read.ok();
  if (ok) {
    const config::PlantCheck check = config::check_plant(read.plant, {true, options.adjust, true, {}});
    diagnostics.insert(diagnostics.end(), check.diagnostics.begin(), check.diagnostics.end());
    ok = check.ok();
  }
  std::erase_if(diagnostics, [](const auto& d) { return d.severity == base::Diagnostic::Severity::Note; });
  print_diagnostics(context, diagnostics, false);
  if (!ok) {
    return kCheckFailed;
  }
  if (read.plant.security.empty()) {
    context.out.note("the plant is open: anyone on this host can read and write its variables (indurop keys init)");
  }
  const std::vector<int> cores = rt::allowed_cores();
  std::vector<Child> children;
  for (std::size_t i = 0; i < read.plant.boards.size(); ++i) {
    const config::Board& board = read.plant.boards[i];
    const int core = cores.empty() ? 0 : cores[cores.size() - 1 - i % cores.size()];
    context.out.flush();
    const auto child = launch(command(program, board, core, options));
    children.push_back({board.name, child ? *child : -1});
    if (!child) {
      context.out.error(
          fmt::format("board {} cannot be started: {}", board.name, std::strerror(child.error().sys_errno)));
      Plant(context, plant.string(), std::move(children)).end_all(SIGTERM);
      return kFailed;
    }
  }
  Plant running(context, plant.string(), std::move(children));
  running.send_pools(read.plant, program.parent_path());
  return running.run();
}

}  // namespace indurop::tools
