// SPDX-License-Identifier: Apache-2.0
// The node of a board as a child of its agent: starts it, ends it, restarts it when it dies, and monitors its health. A
// node that outlived its agent is taken over instead of started again.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/black_box.h"
#include "deploy/agent/node_output.h"
#include "deploy/agent/node_program.h"
#include "deploy/agent/tick_watch.h"
#include "deploy/words/deployment_words.h"
#include "store/vars/run_file.h"

namespace indurop::deploy {

class BoardProcess {
 public:
  static constexpr std::chrono::seconds kRestart{1};
  static constexpr std::chrono::seconds kRestartWindow{60};
  static constexpr std::size_t kRestarts = 3;  // within kRestartWindow

  // Returns why the files of a deployment must not be run; empty: they are what was deployed.
  using Verify = std::function<std::string(const std::string& deployment)>;

  // `arguments`: for every node started, in addition to the manifest and the board. `verify` is called before every
  // start. `program`: indurop-node, an open file that is closed in the end.
  BoardProcess(std::string board, std::vector<std::string> arguments, BlackBox black_box, Verify verify,
               const base::Log& log, int program = open_node_program());
  BoardProcess(const BoardProcess&) = delete;
  BoardProcess& operator=(const BoardProcess&) = delete;
  ~BoardProcess();

  // Sets what should run from now on, and its id; empty: nothing. The same again: a node that has failed is given a new
  // chance.
  void want(const std::filesystem::path& manifest, const std::string& deployment);
  // As want(), of a node that was exchanged to that deployment: it goes on.
  void go_on_as(const std::filesystem::path& manifest, const std::string& deployment);
  // While another deployment is on trial in the running node, and some seconds after it is taken back, a node that
  // gives up does so because of that deployment, and is started again. Once it is committed, the node stays down.
  void begin_trial() noexcept { trial_until_ = rt::MonoTime::max(); }
  void end_trial(bool is_committed) noexcept;
  // Ends the node, and starts it again with what should run.
  void renew() noexcept { running_.clear(); }
  // Returns the manifest that the board's node was started with; empty: none runs.
  static std::filesystem::path manifest_of_node(const std::string& board);
  // Ends the node and keeps it down until release() or want(); `reason` is what users see.
  void hold(const std::string& reason);
  void release();
  [[nodiscard]] const std::string& held() const noexcept { return held_; }  // the reason, empty: not held
  [[nodiscard]] bool has_node() const noexcept { return pid_ > 0; }
  // Returns the manifest of what the node runs or is to run again; empty: there is none, or the node stays down.
  [[nodiscard]] std::filesystem::path to_run() const {
    return held_.empty() && condition_ != NodeCondition::Failed ? wanted_ : std::filesystem::path();
  }
  // Returns true if the node runs that.
  [[nodiscard]] bool runs_it() const noexcept {
    return condition_ == NodeCondition::Running && running_ == deployment_;
  }
  // Verifies the deployment that should run.
  [[nodiscard]] std::string verify() const { return deployment_.empty() ? std::string{} : verify_(deployment_); }
  void step(rt::MonoTime now);
  // Ends the node and waits until it has ended.
  void end();
  // Detaches from the node, which continues to run.
  void leave() noexcept;

  [[nodiscard]] NodeCondition condition() const noexcept { return condition_; }
  // Returns why it failed, or its last message before it died.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

  [[nodiscard]] NodeFigures figures();
  // Health during a trial: what failed since want(), otherwise what is still missing for the node to be healthy.
  struct Health {
    std::string problem;
    std::string missing;
  };
  // `boards`: those that must be present.
  [[nodiscard]] Health health(const std::vector<std::string>& boards);

 private:
  void launch(rt::MonoTime now);
  bool adopt();
  void copy_output();
  void end_if_it_hangs(rt::MonoTime now);
  bool ended(int& status);
  void note_end(int status, rt::MonoTime now);
  void signal_stop(rt::MonoTime now);
  bool attach_run();  // returns false if run_ is not that of the present node
  void remember_faults();
  // Returns the first module that is faulted, or has faulted since want(); empty if none has.
  [[nodiscard]] std::string fault() const;

  std::string board_;
  std::vector<std::string> arguments_;
  BlackBox black_box_;
  Verify verify_;
  const base::Log& log_;
  int program_;  // indurop-node
  std::filesystem::path wanted_;
  std::string deployment_;  // id of the deployment that should run
  std::string running_;     // id of the deployment of the present node; empty: it was started by hand
  std::string held_;
  pid_t pid_ = -1;
  bool adopted_ = false;
  NodeOutput output_;
  bool asked_to_stop_ = false;
  rt::MonoTime kill_at_;
  rt::MonoTime start_at_;  // earliest time of the next start
  std::deque<rt::MonoTime> restarts_;
  std::uint32_t deaths_ = 0;  // since want()
  rt::MonoTime trial_until_{};
  NodeCondition condition_ = NodeCondition::None;
  std::string reason_;
  std::optional<vars::RunFile> run_;
  TickWatch tick_watch_;
  std::string hung_;  // why the node was killed
  // By module: the faults that a node that was already running had at want().
  std::vector<std::uint64_t> faults_before_;
};

}  // namespace indurop::deploy
