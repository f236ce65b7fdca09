// SPDX-License-Identifier: Apache-2.0
#include "tools/testing/node_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "store/vars/store.h"

namespace indurop::testing {
namespace {

constexpr const char* kProgram = "indurop-node";
constexpr std::chrono::microseconds kLook{20};
constexpr std::chrono::seconds kEnd{5};
constexpr const char* kStateVariable = "INDUROP_STATE_DIR";

bool user_chose_state_folder() {
  const char* const chosen = std::getenv(kStateVariable);
  return chosen != nullptr && *chosen != '\0';
}

}  // namespace

std::filesystem::path find_node_program() {
  Dl_info info{};
  std::error_code error;
  if (::dladdr(reinterpret_cast<const void*>(&find_node_program), &info) != 0 && info.dli_fname != nullptr) {
    auto folder = std::filesystem::canonical(info.dli_fname, error).parent_path();
    for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path()) {
      for (const auto& place : {folder / kProgram, folder / "bin" / kProgram}) {
        if (::access(place.c_str(), X_OK) == 0) {
          return place;
        }
      }
    }
  }
  return {};
}

void remove_orphans(std::string_view prefix) {
  for (const std::string& node : vars::list_nodes()) {
    const char* const end = node.data() + node.size();
    pid_t owner = 0;
    if (node.starts_with(prefix) && std::from_chars(node.data() + prefix.size(), end, owner).ec == std::errc() &&
        owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH) {
      (void)vars::remove_node(node);  // not if it runs: its owner may be in another container
    }
  }
}

NodeProcess::NodeProcess(const std::string& node, bool plant, const std::vector<std::string>& arguments,
                         std::chrono::seconds patience, const std::filesystem::path& program)
    : node_(node), patience_(patience), output_(::memfd_create("output of a node", MFD_CLOEXEC)), plant_(plant) {
  if (!user_chose_state_folder() && state_.emplace().path().empty()) {
    end();
    throw std::runtime_error(state_->problem());
  }
  std::array<int, 2> ends{-1, -1};
  // A socket: a write to a node that has ended raises no signal in this process.
  if (output_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    end();
    throw std::runtime_error("cannot make a connection to a node");
  }
  commands_ = ends[1];
  base::Launch launch;
  launch.words = {kProgram, "--sim", "--step", "--node", node};
  launch.words.insert(launch.words.end(), arguments.begin(), arguments.end());
  launch.program = program;
  if (state_) {
    launch.environment = base::environment_without({kStateVariable});
    launch.environment->push_back(fmt::format("{}={}", kStateVariable, state_->path().string()));
  }
  launch.input = ends[0];
  launch.output = output_;
  launch.fresh_signals = true;
  launch.group = base::Launch::Group::Own;
  const auto started = base::spawn(launch);
  ::close(ends[0]);
  if (!started) {
    end();
    throw std::runtime_error("indurop-node cannot be started: put the folder of the InduRoP programs into PATH");
  }
  pid_ = started.value();
  try {
    wait_until_it_stands();
  } catch (...) {
    end();
    throw;
  }
}

NodeProcess::~NodeProcess() {
  end();
}

void NodeProcess::end() noexcept {
  if (commands_ >= 0) {
    ::close(commands_);  // it ends at the end of its input
  }
  const rt::MonoTime deadline = rt::MonoClock::now() + kEnd;
  while (!has_ended()) {
    if (rt::MonoClock::now() > deadline) {
      ::kill(pid_, SIGKILL);
    }
    std::this_thread::sleep_for(kLook);
  }
  if (output_ >= 0) {
    ::close(output_);
  }
  for (const std::string& node : nodes()) {
    (void)vars::remove_node(node);
  }
}

std::vector<std::string> NodeProcess::nodes() const {
  if (!plant_) {
    return {node_};
  }
  std::vector<std::string> all = vars::list_nodes();
  std::erase_if(all, [this](const std::string& node) { return !node.starts_with(node_ + "-"); });
  return all;
}

bool NodeProcess::has_ended() {
  if (pid_ > 0) {
    const pid_t ended = ::waitpid(pid_, nullptr, WNOHANG);
    if (ended == pid_ ||
        (ended < 0 && errno == ECHILD && ::kill(pid_, 0) != 0)) {  // no child: the program ignores SIGCHLD
      pid_ = -1;
    }
  }
  return pid_ <= 0;
}

std::int64_t NodeProcess::basic_period_ns() const noexcept {
  std::int64_t shortest = boards_[0].run().basic_period_ns;
  for (const Board& board : boards_) {
    shortest = std::min(shortest, board.run().basic_period_ns);
  }
  return shortest;
}

// The boards of a plant are all present when it reports that it has stopped before tick 0.
void NodeProcess::find_boards() {
  if (plant_ && printed().find("tick 0, ") == std::string::npos) {
    return;
  }
  for (const std::string& node : nodes()) {
    auto opened = vars::RunFile::open(node, vars::Mode::ReadWrite, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (opened) {
      if (static_cast<scheduler::RunBlock*>(opened->data())->abi != scheduler::kRunAbi) {
        fail("indurop-node is of another version of InduRoP: make what uses it with the same version");
      }
      boards_.push_back({plant_ ? node.substr(node_.size() + 1) : "", node, std::move(opened).value()});
    }
  }
  std::sort(boards_.begin(), boards_.end(), [](const Board& a, const Board& b) { return a.name < b.name; });
}

// A board that was killed by a script and has returned has new memory.
void NodeProcess::check_returned() {
  for (Board& board : boards_) {
    const pid_t pid = vars::running_node(board.node);
    if (pid == 0 || pid == board.run().node_pid.load()) {
      continue;
    }
    auto opened =
        vars::RunFile::open(board.node, vars::Mode::ReadWrite, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (opened && static_cast<scheduler::RunBlock*>(opened->data())->node_pid.load() == pid) {
      board.file = std::move(opened).value();
      ++board.starts;
    }
  }
}

// Returns true if all running boards have stopped just before the next tick.
bool NodeProcess::stands() const {
  std::int64_t epoch = boards_[0].run().epoch_ns;
  for (const Board& board : boards_) {
    epoch = std::min(epoch, board.run().epoch_ns.load());
  }
  if (epoch == 0) {
    return false;
  }
  const std::int64_t place = epoch + static_cast<std::int64_t>(ticks_) * basic_period_ns() - 1;
  return std::all_of(boards_.begin(), boards_.end(), [&](const Board& board) {
    return board.run().virtual_ns.load(std::memory_order_acquire) == place ||
           (plant_ && vars::running_node(board.node) == 0);
  });
}

std::string NodeProcess::printed(std::size_t after) const {
  struct stat status {};
  std::string text;
  if (::fstat(output_, &status) == 0 && static_cast<std::size_t>(status.st_size) > after) {
    text.resize(static_cast<std::size_t>(status.st_size) - after);
    const ssize_t count = ::pread(output_, text.data(), text.size(), static_cast<off_t>(after));
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
  return text;
}

void NodeProcess::fail(const std::string& what) const {
  constexpr std::size_t kLast = 2000;
  const std::string said = printed();
  throw std::runtime_error(said.empty() ? what
                                        : fmt::format("{}; the node said:\n{}", what,
                                                      said.substr(said.size() - std::min(said.size(), kLast))));
}

// Waits until it has stopped just before the next tick: everything of the last tick is done.
void NodeProcess::wait_until_it_stands() {
  const rt::MonoTime deadline = rt::MonoClock::now() + patience_;
  for (;;) {
    const bool ended = has_ended();
    if (boards_.empty() && !ended) {
      find_boards();
    }
    if (plant_) {
      check_returned();
    }
    if (!boards_.empty() && stands()) {
      return;
    }
    if (ended) {
      fail(ticks_ == 0 ? "the configuration cannot be run" : fmt::format("the node ended before tick {}", ticks_));
    }
    if (rt::MonoClock::now() > deadline) {
      fail(fmt::format("tick {} was not reached within {} s", ticks_, patience_.count()));
    }
    std::this_thread::sleep_for(kLook);
  }
}

void NodeProcess::go(std::uint64_t ticks) {
  if (ticks == 0) {
    return;
  }
  ticks_ += ticks;
  const std::string command = fmt::format("{}\n", ticks);
  if (::send(commands_, command.data(), command.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(command.size())) {
    fail(fmt::format("the node ended before tick {}", ticks_));
  }
  wait_until_it_stands();
}

}  // namespace indurop::testing
