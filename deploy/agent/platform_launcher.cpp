// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/platform_launcher.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/open_files.h"
#include "deploy/agent/agent_state.h"
#include "deploy/agent/release_programs.h"
#include "deploy/disk/last_switch.h"
#include "deploy/words/release_version.h"
#include "store/vars/retain.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kTrialStarts = 3;
constexpr std::uint64_t kCommittedStarts = 10;     // each of which ended before PlatformUpdate::kAliveAfter
constexpr std::chrono::seconds kTrialReserve{90};  // for a trial, in addition to the health window

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts) {
    out.push_back(text.data());
  }
  out.push_back(nullptr);
  return out;
}

// Returns why this process could not become the program.
std::string become(const fs::path& program, char** arguments, std::vector<std::string> environment) {
  std::vector<std::string> words{program.string()};
  for (char** word = arguments + 1; *arguments != nullptr && *word != nullptr; ++word) {
    words.emplace_back(*word);
  }
  rt::close_open_files_on_exec();
  (void)::execve(program.c_str(), pointers_to(words).data(), pointers_to(environment).data());
  return fmt::format("{}: {}", program.string(), std::strerror(errno));
}

class Launcher {
 public:
  Launcher(AgentState& state, RunningRelease& self, const base::Log& log)
      : state_(state), self_(self), log_(log), last_(load_switch(state.folder())) {}

  void run() {
    if (last_ && last_->ended.empty() && last_->order.generation > state_.committed().generation) {
      if (run_trial()) {
        return;
      }
    }
    run_committed();
  }

 private:
  // Counts the start, on the disk. Returns false if that is not possible.
  bool note() {
    const auto written = save_switch(state_.folder(), *last_);
    if (!written) {
      log_.error("{}", written.error().text);
    }
    return written.ok();
  }

  // Returns true if the trial is one of this program. A trial that ended without a commit is over for good.
  bool run_trial() {
    const std::chrono::nanoseconds longest = std::chrono::nanoseconds(last_->order.health_ns) + kTrialReserve;
    const std::chrono::nanoseconds past{rt::wall_ns() - last_->begun_ns};
    if (last_->starts >= kTrialStarts) {
      last_->ended = fmt::format("its agent was started {} times and did not do well", kTrialStarts);
    } else if (past < -longest) {
      // Neither this process nor the next one could tell when the trial has lasted too long.
      last_->expired = true;
      last_->ended = "the clock was set back, so it is not known how long it has lasted";
    } else if (past > longest) {
      last_->expired = true;
      last_->ended = fmt::format("it was not committed within {} s",
                                 std::chrono::duration_cast<std::chrono::seconds>(longest).count());
    } else {
      ++last_->starts;
      if (!note()) {
        last_->ended = "its start could not be noted on the disk";
      } else if (last_->order.deployment == kInstalledRelease) {
        return true;
      } else {
        const auto left = std::chrono::ceil<std::chrono::seconds>(longest);
        last_->ended = start(last_->order.deployment, static_cast<unsigned>(left.count()));
      }
    }
    log_.error("the switch to release {} failed: {}", shown_id(last_->order.deployment), last_->ended);
    (void)note();
    return false;
  }

  void run_committed() {
    const Committed& committed = state_.committed();
    const std::string& current = committed.current;
    if (current.empty() || current == kInstalledRelease) {
      return;
    }
    const bool same_switch = last_ && last_->order.generation == committed.generation;
    if (same_switch && last_->installed != INDUROP_VERSION && is_older_release(committed.comment, INDUROP_VERSION)) {
      log_.info("the installed release {} is newer than the deployed one, {}", INDUROP_VERSION, committed.comment);
      self_.upgraded = true;
      return;
    }
    std::string problem;
    if (same_switch && last_->starts >= kCommittedStarts) {
      last_->starts = 0;
      (void)note();
      problem = fmt::format("its agent ended soon after each of its last {} starts", kCommittedStarts);
    } else {
      if (same_switch) {
        ++last_->starts;
        (void)note();
      }
      problem = start(current, 0);
    }
    log_.error("release {} cannot be run: {}", shown_id(current), problem);
    if (!committed.previous.empty() && committed.previous != kInstalledRelease) {
      log_.error("nor can release {}: {}", shown_id(committed.previous), start(committed.previous, 0));
    }
  }

  // Becomes the agent of the release, which the kernel ends after `limit_s` unless the agent ends that limit (0: none).
  // Returns the reason if it does not.
  std::string start(const std::string& id, unsigned limit_s) {
    auto release = sound_release(state_.files(), id);
    if (!release) {
      // Its copies may not have reached the disk before a loss of power.
      const auto restored = state_.install(id);
      release = restored ? sound_release(state_.files(), id) : restored.error();
    }
    if (!release) {
      return release.error().text;
    }
    ::alarm(limit_s);
    const std::string problem =
        become(release->agent, self_.arguments,
               release_environment(state_.folder(), release->libraries,
                                   {fmt::format("{}={}", kReleaseVariable, id),
                                    fmt::format("{}={}", kLauncherVariable, self_.launcher.string())}));
    ::alarm(0);
    return problem;
  }

  AgentState& state_;
  RunningRelease& self_;
  const base::Log& log_;
  std::optional<LastSwitch> last_;
};

}  // namespace

RunningRelease become_release(const std::string& board, char** arguments, const base::Log& log) {
  const fs::path platform = platform_folder(vars::state_directory(board));
  RunningRelease self{value_of(kReleaseVariable), value_of(kLauncherVariable), false, arguments};
  if (!self.id.empty() && !self.launcher.empty()) {
    return self;
  }
  std::error_code error;
  self.id = kInstalledRelease;
  self.launcher = fs::read_symlink("/proc/self/exe", error);
  if (!fs::exists(platform, error)) {
    return self;  // nothing was deployed
  }
  auto state = AgentState::open_platform(board, [&log](const std::string& line) { log.error("{}", line); });
  if (state) {  // if another agent of the board runs, this one ends soon
    Launcher(*state, self, log).run();
  }
  return self;
}

std::string become_launcher(const RunningRelease& running, const fs::path& platform) {
  return become(running.launcher, running.arguments, release_environment(platform, {}, {}));
}

}  // namespace indurop::deploy
