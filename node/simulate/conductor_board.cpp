// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/conductor_board.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <utility>

#include "core/base/spawn.h"
#include "core/rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kBoardGrace{10};  // a node waits a few seconds for its own modules and processes
constexpr std::chrono::milliseconds kEndPoll{1};

// Returns "r.left.json" for "r.json" of board "left", and "r.left.2.json" when it was started again.
std::filesystem::path file_of(const std::filesystem::path& file, const std::string& board, int start) {
  std::filesystem::path named = file;
  if (!file.empty()) {
    named.replace_extension("." + board + (start > 1 ? "." + std::to_string(start) : "") + file.extension().string());
  }
  return named;
}

}  // namespace

ConductorBoard::ConductorBoard(ConductorBoard&& other) noexcept
    : name_(std::move(other.name_)),
      channel_(std::move(other.channel_)),
      pid_(std::exchange(other.pid_, -1)),
      status_(other.status_),
      starts_(other.starts_),
      answer_(std::move(other.answer_)) {}

ConductorBoard::~ConductorBoard() {
  kill();
}

Status ConductorBoard::start(const Options& options, const BoardPlace& place) {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return Error{Errc::System, errno, "make a socket"};
  }
  Options own = options;
  own.board = name_;
  own.one_host = true;
  own.node = options.node.empty() ? name_ + "-sim" : options.node + "-" + name_;
  ++starts_;
  own.report = file_of(options.report, name_, starts_);
  own.record = file_of(options.record, name_, starts_);
  own.simulation.step = false;
  own.simulation.speed = 0;
  own.simulation.network.clear();
  own.simulation.script.clear();
  own.simulation.conductor = ends[1];
  base::Launch launch;
  launch.words = config::words_of(own);
  launch.words.insert(launch.words.begin(), "indurop-node");
  launch.program = "/proc/self/exe";
  launch.inherits = ends[1];
  launch.group = base::Launch::Group::Own;  // only we get Ctrl-C; we end the boards
  launch.fresh_signals = true;
  launch.ends_with_us = SIGKILL;
  const auto started = base::spawn(launch);
  ::close(ends[1]);
  channel_.emplace(ends[0]);
  if (!started) {
    channel_.reset();
    return started.error();
  }
  pid_ = started.value();
  answer_ = {};
  (void)channel_->send(place);
  return {};
}

void ConductorBoard::order(const BoardOrder& order) {
  (void)channel_->send(order);  // if the board has ended, await_answer() notices
}

bool ConductorBoard::await_answer(base::StopSignal& signals) {
  bool forwarded = false;
  for (;;) {
    const BoardChannel::Got got = channel_->receive(answer_);
    if (got == BoardChannel::Got::Word) {
      return true;
    }
    if (got == BoardChannel::Got::End) {
      channel_.reset();
      return false;
    }
    if (const int number = signals.wait(std::chrono::nanoseconds{0}); number != 0 && !std::exchange(forwarded, true)) {
      ::kill(pid_, number);
    }
  }
}

void ConductorBoard::kill() noexcept {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    (void)::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  channel_.reset();  // not before: it would end in an orderly way
}

int ConductorBoard::await_end() {
  channel_.reset();
  const rt::MonoTime give_up = rt::MonoClock::now() + kBoardGrace;
  int status = 0;
  while (pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) == 0) {
    if (rt::MonoClock::now() > give_up) {
      ::kill(pid_, SIGKILL);
    }
    rt::sleep_until(rt::MonoClock::now() + kEndPoll);
  }
  if (pid_ > 0) {
    pid_ = -1;
    status_ = base::exit_code_of(status);
  }
  return std::exchange(status_, 0);
}

}  // namespace indurop::node
