// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_pools.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

#include "config/xml/plant_reader.h"
#include "core/base/json.h"
#include "core/base/program_folder.h"
#include "core/base/replace_file.h"
#include "core/base/spawn.h"
#include "deploy/words/node_texts.h"
#include "store/vars/process.h"
#include "store/vars/retain.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPoolsPoll{10};
// A problem that was past before is shown again by a program that lives this short.
constexpr std::chrono::seconds kPoolsBegin{3};

std::string describe_end(int status) {
  return WIFSIGNALED(status)
             ? fmt::format("was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
             : fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

fs::path pools_program() {
  return base::program_folder() / "indurop-pools";
}

BoardPools::BoardPools(std::string board, fs::path program, std::vector<std::string> further, bool one_host,
                       Limits limits, const base::Log& log)
    : board_(std::move(board)),
      program_(std::move(program)),
      further_(std::move(further)),
      one_host_(one_host),
      limits_(limits),
      log_(log) {
  std::error_code ignored;
  fs::remove(pools_file(vars::state_directory(board_)), ignored);  // what an earlier agent left is past
}

BoardPools::~BoardPools() {
  if (pid_ > 0) {
    ::kill(pid_, SIGTERM);
  }
}

// The manifest of a deployment never changes, so it is read once.
void BoardPools::read(const fs::path& manifest) {
  if (manifest == manifest_) {
    return;
  }
  manifest_ = manifest;
  changed_ = true;
  std::vector<std::string> wanted;
  pools_.clear();
  if (!manifest.empty()) {
    if (const config::ReadPlant plant = config::read_plant(manifest); plant.ok()) {
      wanted = config::pool_arguments(plant.plant, board_, one_host_);
      pools_ = config::pools_of(plant.plant, board_);
    }
  }
  if (wanted != wanted_) {
    wanted_ = std::move(wanted);
    deaths_ = 0;
    pause_ = {};
    start_at_ = {};
    problem_.clear();
    output_.forget_error();
  }
}

void BoardPools::launch(rt::MonoTime now) {
  if (::access(program_.c_str(), X_OK) != 0) {
    fail(fmt::format("cannot be started, because {} is missing; install all of the package indurop, the agent tries "
                     "again",
                     program_.string()),
         now);
    return;
  }
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    fail(fmt::format("cannot be started: {}; the agent tries again", std::strerror(errno)), now);
    return;
  }
  (void)::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  (void)::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  std::vector<std::string> words{program_.string()};
  words.insert(words.end(), wanted_.begin(), wanted_.end());
  words.insert(words.end(), further_.begin(), further_.end());
  const auto pid = base::spawn({.words = std::move(words),
                                .program = program_,
                                .group = base::Launch::Group::OwnSession,
                                .output = ends[1],
                                .fresh_signals = true,
                                .ends_with_us = SIGTERM});
  ::close(ends[1]);
  if (!pid) {
    ::close(ends[0]);
    fail(fmt::format("cannot be started: {}; the agent tries again", std::strerror(pid.error().sys_errno)), now);
    return;
  }
  output_.close();
  output_.open(ends[0]);
  pid_ = *pid;
  start_time_ = vars::process_start_time(pid_);
  running_ = wanted_;
  asked_to_stop_ = false;
  changed_ = true;
  started_at_ = now;
}

void BoardPools::fail(std::string why, rt::MonoTime now) {
  pause_ = pause_.count() == 0 ? limits_.first : std::min(2 * pause_, limits_.longest);
  start_at_ = now + pause_;
  problem_ = std::move(why);
  changed_ = true;
  log_.error("indurop-pools {} in {:g} s", problem_, std::chrono::duration<double>(pause_).count());
}

void BoardPools::stop(rt::MonoTime now) {
  if (!asked_to_stop_) {
    asked_to_stop_ = true;
    changed_ = true;
    kill_at_ = now + limits_.grace;
    ::kill(pid_, SIGTERM);
  } else if (now >= kill_at_) {
    ::kill(pid_, SIGKILL);
    kill_at_ = now + limits_.grace;
  }
}

void BoardPools::note_end(int status, rt::MonoTime now) {
  pid_ = -1;
  running_.clear();
  changed_ = true;
  if (std::exchange(asked_to_stop_, false)) {
    return;
  }
  ++deaths_;
  pause_ = now - started_at_ >= limits_.well ? std::chrono::milliseconds(0) : pause_;
  std::string why = describe_end(status);
  if (const std::string& error = output_.last_error(); !error.empty()) {
    constexpr std::string_view kMark = "error: ";
    why += ": " + error.substr(error.find(kMark) + kMark.size());
    output_.forget_error();
  }
  fail(why + "; it is started again", now);
}

void BoardPools::step(const fs::path& manifest, bool node_runs, rt::MonoTime now) {
  read(manifest);
  output_.copy(true);
  if (int status = 0; pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) == pid_) {
    output_.copy(true);
    note_end(status, now);
  }
  if (pid_ > 0 && running_ != wanted_) {
    stop(now);
  } else if (pid_ > 0 && !problem_.empty() && now - started_at_ >= kPoolsBegin) {
    problem_.clear();
    changed_ = true;
  } else if (pid_ <= 0 && !wanted_.empty() && node_runs && now >= start_at_) {
    launch(now);
  }
  save();
}

void BoardPools::end() {
  manifest_.clear();
  wanted_.clear();
  pools_.clear();
  changed_ = true;
  while (pid_ > 0) {
    step({}, false, rt::MonoClock::now());
    rt::sleep_until(rt::MonoClock::now() + kPoolsPoll);
  }
  save();
}

std::string BoardPools::problem() const {
  return problem_.empty() ? "" : "indurop-pools " + problem_;
}

std::string BoardPools::text() const {
  using base::Json;
  if (pools_.empty()) {
    return {};
  }
  Json list = Json::array();
  for (const config::BoardPool& one : pools_) {
    list.push_back({{"pool", one.pool}, {"text", one.text}});
  }
  const char* const state = pid_ > 0           ? asked_to_stop_ ? "stopping" : "running"
                            : problem_.empty() ? "starting"
                                               : "restarting";
  return Json{{"state", state},    {"pid", pid_ > 0 ? pid_ : 0}, {"start_time", pid_ > 0 ? start_time_ : 0},
              {"deaths", deaths_}, {"problem", problem()},       {"pools", list}}
      .dump();
}

// For `indurop status` on this board. It is made again with every change, so it need not reach the disk.
void BoardPools::save() {
  if (!std::exchange(changed_, false)) {
    return;
  }
  const fs::path file = pools_file(vars::state_directory(board_));
  if (const std::string now = text(); !now.empty()) {
    (void)base::replace_file(file, now, base::Durable::No);
  } else {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
}

}  // namespace indurop::deploy
