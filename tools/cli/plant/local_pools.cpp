// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/local_pools.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>

#include "config/pool_arguments.h"
#include "core/base/spawn.h"
#include "core/rt/clock.h"

namespace indurop::tools {
namespace {

constexpr std::chrono::seconds kPoolsGrace{5};
constexpr std::chrono::milliseconds kPoolsEndPoll{10};

}  // namespace

void LocalPools::start(const config::Plant& plant, const std::filesystem::path& folder) {
  const std::filesystem::path program = folder / "indurop-pools";
  for (const config::Board& board : plant.boards) {
    std::vector<std::string> words = config::pool_arguments(plant, board.name, true);
    if (words.empty()) {
      continue;
    }
    words.insert(words.begin(), program.string());
    words.emplace_back("--quiet");
    const auto pid = base::spawn({.words = std::move(words),
                                  .program = program,
                                  .group = base::Launch::Group::Own,  // Ctrl-C reaches only this program
                                  .fresh_signals = true,
                                  .ends_with_us = SIGTERM});
    if (!pid) {
      context_.out.error(fmt::format("indurop-pools of board {} cannot be started: {}; no pool is sent", board.name,
                                     std::strerror(pid.error().sys_errno)));
      continue;
    }
    programs_.push_back({board.name, *pid});
  }
}

void LocalPools::collect() {
  std::erase_if(programs_, [this](const Program& one) {
    int status = 0;
    if (::waitpid(one.pid, &status, WNOHANG) != one.pid) {
      return false;
    }
    context_.out.error(fmt::format(
        "indurop-pools of board {} ended with exit code {}, its pools are not sent any more; the boards go on",
        one.board, base::exit_code_of(status)));
    return true;
  });
}

void LocalPools::end() {
  for (const Program& one : programs_) {
    ::kill(one.pid, SIGTERM);
  }
  const rt::MonoTime deadline = rt::MonoClock::now() + kPoolsGrace;
  while (!programs_.empty()) {
    std::erase_if(programs_, [](const Program& one) { return ::waitpid(one.pid, nullptr, WNOHANG) == one.pid; });
    if (rt::MonoClock::now() >= deadline) {
      for (const Program& one : programs_) {
        ::kill(one.pid, SIGKILL);
      }
    }
    rt::sleep_until(rt::MonoClock::now() + kPoolsEndPoll);
  }
}

}  // namespace indurop::tools
