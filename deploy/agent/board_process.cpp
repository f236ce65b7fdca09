// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "core/rt/fixed_text.h"
#include "deploy/agent/node_program.h"
#include "deploy/agent/options.h"
#include "deploy/agent/release_programs.h"
#include "network/mirror/frames/mirror_block.h"
#include "scheduler/run_block.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kNodeGrace{10};  // a node gives its own modules and processes a few seconds
constexpr std::chrono::milliseconds kNodePoll{10};
constexpr int kPipeBytes = 1 << 20;

const scheduler::RunBlock* block_of(const vars::RunFile& file) {
  const auto* block = static_cast<const scheduler::RunBlock*>(file.data());
  return block->abi == scheduler::kRunAbi ? block : nullptr;
}

const scheduler::RunBlock& present(const std::optional<vars::RunFile>& file) {
  return *static_cast<const scheduler::RunBlock*>(file->data());
}

std::string describe(int status) {
  return WIFSIGNALED(status)
             ? fmt::format("was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
             : fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

BoardProcess::BoardProcess(std::string board, std::vector<std::string> arguments, BlackBox black_box, Verify verify,
                           const base::Log& log, int program)
    : board_(std::move(board)),
      arguments_(std::move(arguments)),
      black_box_(std::move(black_box)),
      verify_(std::move(verify)),
      log_(log),
      program_(program),
      output_(log.has_journal() ? fmt::format("indurop-node[{}]: ", board_) : "") {}

BoardProcess::~BoardProcess() {
  leave();
  if (program_ >= 0) {
    ::close(program_);
  }
}

void BoardProcess::leave() noexcept {
  output_.close();
  pid_ = -1;
}

void BoardProcess::want(const std::filesystem::path& manifest, const std::string& deployment) {
  wanted_ = manifest;
  deployment_ = deployment;
  restarts_.clear();
  deaths_ = 0;
  start_at_ = {};
  held_.clear();
  reason_.clear();
  output_.forget_error();
  remember_faults();
  if (pid_ <= 0) {
    condition_ = NodeCondition::None;
  }
}

void BoardProcess::go_on_as(const std::filesystem::path& manifest, const std::string& deployment) {
  running_ = deployment;
  want(manifest, deployment);
}

void BoardProcess::end_trial(bool is_committed) noexcept {
  if (trial_until_ == rt::MonoTime::max()) {
    trial_until_ = is_committed ? rt::MonoTime() : rt::MonoClock::now() + kNodeGrace;
  }
}

std::filesystem::path BoardProcess::manifest_of_node(const std::string& board) {
  const auto file = vars::RunFile::open(board, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  const auto* const block = file && vars::running_node(board) > 0 ? block_of(file.value()) : nullptr;
  return block != nullptr ? rt::text_of(block->plant_file) : std::string();
}

void BoardProcess::hold(const std::string& reason) {
  held_ = reason;
  reason_ = reason;
  if (pid_ <= 0) {
    condition_ = NodeCondition::Stopped;
  }
}

void BoardProcess::release() {
  const std::filesystem::path same = wanted_;
  const std::string id = deployment_;
  want(same, id);
}

bool BoardProcess::adopt() {
  const pid_t pid = vars::running_node(board_);
  if (pid <= 0) {
    return false;
  }
  std::error_code error;
  auto file = vars::RunFile::open(board_, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  const auto* block = file ? block_of(file.value()) : nullptr;
  const bool same_release = release_folder_in(fs::read_symlink(fmt::format("/proc/{}/exe", pid), error)) ==
                            release_folder_in(node_program_path(program_));
  running_ = same_release && block != nullptr && block->node_pid.load() == pid ? rt::text_of(block->deployment)
                                                                               : std::string{};
  pid_ = pid;
  adopted_ = true;
  asked_to_stop_ = false;
  condition_ = NodeCondition::Running;
  log_.info("{} the node that is running (pid {})", running_ == deployment_ ? "taking over" : "ending", pid);
  return true;
}

void BoardProcess::launch(rt::MonoTime now) {
  if (std::string damage = verify(); !damage.empty()) {
    condition_ = NodeCondition::Failed;
    reason_ = "it is not started, because it is not what was deployed: " + damage;
    log_.error("{}", reason_);
    return;
  }
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    start_at_ = now + kRestart;
    return;
  }
  (void)::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  (void)::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  (void)::fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);
  std::vector<std::string> words{
      node_program_path(program_), wanted_.string(), "--board", board_, "--deployment", deployment_};
  words.insert(words.end(), arguments_.begin(), arguments_.end());
  // Ctrl-C reaches the agent alone; the node may outlive it. The node has a read end of its own, so that the pipe
  // outlives the agent too: its output is lost then, but no process dies of it.
  const auto pid = base::spawn({.words = std::move(words),
                                .program = node_program_path(program_),
                                .group = base::Launch::Group::OwnSession,
                                .output = ends[1],
                                .inherits = ends[0],
                                .fresh_signals = true});
  ::close(ends[1]);
  if (!pid) {
    ::close(ends[0]);
    reason_ = fmt::format("cannot start a process: {}", std::strerror(pid.error().sys_errno));
    start_at_ = now + kRestart;
    return;
  }
  output_.open(ends[0]);
  pid_ = *pid;
  adopted_ = false;
  asked_to_stop_ = false;
  running_ = deployment_;
  run_.reset();
  condition_ = NodeCondition::Starting;
}

// While the node is being stopped, its first error message counts.
void BoardProcess::copy_output() {
  output_.copy(pid_ < 0 || !asked_to_stop_);
}

bool BoardProcess::ended(int& status) {
  status = 0;
  if (!adopted_) {
    return ::waitpid(pid_, &status, WNOHANG) == pid_;
  }
  return vars::running_node(board_) != pid_;
}

void BoardProcess::note_end(int status, rt::MonoTime now) {
  // A node of another deployment than the one that should run would have been ended by the next step.
  const bool commanded = asked_to_stop_ || running_ != deployment_;
  pid_ = -1;
  asked_to_stop_ = false;
  run_.reset();
  faults_before_.clear();
  if (commanded) {
    hung_.clear();
    condition_ = held_.empty() ? NodeCondition::None : NodeCondition::Stopped;
    return;
  }
  ++deaths_;
  const bool died = adopted_ || WIFSIGNALED(status);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  reason_ = adopted_ ? std::string("the node ended") : "the node " + describe(status);
  if (!output_.last_error().empty()) {
    reason_ += ": " + output_.last_error();
  }
  if (!hung_.empty()) {
    reason_ = std::exchange(hung_, {});
  }
  const bool was_stopped = code == kOk || code == kInterrupted;
  if (!died && (was_stopped || now >= trial_until_)) {
    // An orderly end: it was stopped, or it refuses to run; further restarts would not help.
    condition_ = NodeCondition::Failed;
    if (was_stopped) {
      reason_ = "the node was stopped";
    }
    log_.error("{}; it is not started again", reason_);
    return;
  }
  if (died) {
    log_.info("{}", black_box_.keep());
  }
  while (!restarts_.empty() && now - restarts_.front() > kRestartWindow) {
    restarts_.pop_front();
  }
  if (restarts_.size() >= kRestarts) {
    condition_ = NodeCondition::Failed;
    reason_ += fmt::format(", the {}th time within a minute", restarts_.size() + 1);
    log_.error("{}; it is not started again", reason_);
    return;
  }
  restarts_.push_back(now);
  start_at_ = now + kRestart;
  condition_ = NodeCondition::Restarting;
  log_.error("{}; it is started again in {} s", reason_, kRestart.count());
}

void BoardProcess::signal_stop(rt::MonoTime now) {
  if (!asked_to_stop_) {
    asked_to_stop_ = true;
    kill_at_ = now + kNodeGrace;
    condition_ = NodeCondition::Stopping;
    ::kill(pid_, SIGTERM);
  } else if (now >= kill_at_) {
    log_.error("the node did not end within {} s and was killed", kNodeGrace.count());
    ::kill(pid_, SIGKILL);
    kill_at_ = now + kNodeGrace;
  }
}

void BoardProcess::step(rt::MonoTime now) {
  copy_output();
  if (int status = 0; pid_ > 0 && ended(status)) {
    copy_output();
    note_end(status, now);
  }
  if (pid_ > 0) {
    if (wanted_.empty() || running_ != deployment_ || asked_to_stop_ || !held_.empty()) {
      signal_stop(now);
    } else if (attach_run() && condition_ == NodeCondition::Starting &&
               present(run_).state.load() == scheduler::NodeState::Running) {
      condition_ = NodeCondition::Running;
    }
    if (condition_ == NodeCondition::Running) {
      end_if_it_hangs(now);
    }
    return;
  }
  if (wanted_.empty() || !held_.empty() || condition_ == NodeCondition::Failed || now < start_at_) {
    return;
  }
  if (!adopt()) {
    launch(now);
  }
}

// A node that hangs cannot be asked to end; it is restarted like one that died.
void BoardProcess::end_if_it_hangs(rt::MonoTime now) {
  if (!attach_run()) {
    return;
  }
  if (const auto stood = tick_watch_.check(present(run_), now)) {
    hung_ = fmt::format("the node hung: its tick stayed at {} for {:.1f} s", present(run_).tick.load(),
                        std::chrono::duration<double>(*stood).count());
    log_.error("{}; it is killed", hung_);
    ::kill(pid_, SIGKILL);
    tick_watch_.reset();
  }
}

void BoardProcess::end() {
  wanted_.clear();
  while (pid_ > 0) {
    step(rt::MonoClock::now());
    rt::sleep_until(rt::MonoClock::now() + kNodePoll);
  }
}

bool BoardProcess::attach_run() {
  if (pid_ <= 0) {
    return false;
  }
  if (!run_) {
    auto file = vars::RunFile::open(board_, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (!file || block_of(file.value()) == nullptr || block_of(file.value())->node_pid.load() != pid_) {
      return false;
    }
    run_ = std::move(file).value();
    tick_watch_.reset();
  }
  return true;
}

NodeFigures BoardProcess::figures() {
  NodeFigures out;
  if (!attach_run()) {
    return out;
  }
  const scheduler::RunBlock& block = present(run_);
  out.tick = block.tick.load();
  out.lost_ticks = block.lost_ticks.load();
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    out.overruns += block.modules()[i].overruns.load();
    out.faults += block.modules()[i].faults.load();
  }
  return out;
}

// A node that already runs the requested deployment continues, and its earlier faults are not attributed to the new
// one.
void BoardProcess::remember_faults() {
  faults_before_.clear();
  if (running_ != deployment_ || !attach_run()) {
    return;
  }
  const scheduler::RunBlock& block = present(run_);
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    faults_before_.push_back(block.modules()[i].faults.load());
  }
}

std::string BoardProcess::fault() const {
  const scheduler::RunBlock& block = present(run_);
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    const scheduler::ModuleRecord& module = block.modules()[i];
    const std::uint64_t before = i < faults_before_.size() ? faults_before_[i] : 0;
    if (module.faults.load() > before || module.state.load() == scheduler::ModuleState::Faulted) {
      const bool known_fault = module.fault_kind.load(std::memory_order_acquire) != 0;
      return fmt::format("module {} faulted{}{}", module.name, known_fault ? ": " : "",
                         known_fault ? module.last_fault : "");
    }
  }
  return {};
}

BoardProcess::Health BoardProcess::health(const std::vector<std::string>& boards) {
  if (deaths_ > 0) {
    return {reason_, {}};
  }
  if (wanted_.empty()) {
    return {{}, pid_ > 0 ? "its node is still running" : ""};
  }
  if (condition_ != NodeCondition::Running || !attach_run() || present(run_).tick.load() == 0) {
    return {{}, "its node has not started to run"};
  }
  if (std::string faulted = fault(); !faulted.empty()) {
    return {std::move(faulted), {}};
  }
  const auto file = vars::ShmCopy::of(vars::mirror_file(board_));
  const mirror::MirrorBlock* mirror =
      file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
  if (mirror == nullptr) {
    return {{}, "its mirror has not started to run"};
  }
  for (std::uint32_t i = 0; i < mirror->peer_count; ++i) {
    const mirror::PeerRecord& peer = mirror->peers()[i];
    const mirror::PeerState state = peer.state.load();
    const bool in_plant = std::find(boards.begin(), boards.end(), peer.name) != boards.end();
    if (in_plant && peer.wanted > 0 && state != mirror::PeerState::Alive) {
      const std::string why = peer.problem.get();
      return {{},
              fmt::format("board {} is {} to its mirror{}{}", peer.name, to_text(state), why.empty() ? "" : ": ", why)};
    }
  }
  return {};
}

}  // namespace indurop::deploy
