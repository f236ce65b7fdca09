// SPDX-License-Identifier: Apache-2.0
// One run of a node from the configuration to the final report: the composition root, the only code that knows every
// room. Phases: check, claim the name, memory, load, start, run, stop; a stop request is heard in each of them.

#pragma once

#include <csignal>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/check.h"
#include "mirror/mirror.h"
#include "node/console.h"
#include "node/external_part.h"
#include "node/failsafe.h"
#include "node/force_watch.h"
#include "node/module_library.h"
#include "node/module_orders.h"
#include "node/normal_threads.h"
#include "node/options.h"
#include "node/phases.h"
#include "node/processes.h"
#include "node/retainer.h"
#include "node/stop_signal.h"
#include "rt/machine.h"
#include "scheduler/engine.h"
#include "scheduler/run_block_setup.h"
#include "vars/node_lock.h"
#include "vars/run_file.h"
#include "vars/store.h"

namespace indurop::node {

class Node {
 public:
  explicit Node(Options options);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Runs to the end; returns the program's exit code.
  int run();

 private:
  // Phases. Each says its errors itself and returns false if the run ends here, with exit_ set.
  bool check();
  bool read_plant(std::vector<deploy::Diagnostic>& diagnostics);
  bool read_modules(std::vector<deploy::Diagnostic>& diagnostics);
  bool claim_name();
  bool obtain_rights();
  bool make_memory();
  bool load_modules();
  bool start_modules();
  bool start_schedule();
  bool start_mirror();
  [[nodiscard]] std::vector<int> cores_without_modules() const;
  void supervise();
  void shut_down();
  int finish();

  bool fail(int code);
  bool interrupted();
  void stop_because(const std::string& reason);
  scheduler::Hooks hooks();

  Options options_;
  Console console_;
  StopSignal signals_;
  int exit_ = kOk;
  std::string reason_;

  deploy::Config config_;
  deploy::CheckResult check_;
  std::vector<std::string> board_names_;  // of the plant
  std::optional<vars::NodeLock> lock_;
  rt::ShortIdle idle_;
  scheduler::Obtained obtained_{};
  int core_ = 0;
  scheduler::RunBlockSetup setup_;
  std::optional<vars::Store> store_;
  ForceWatch forces_;
  std::optional<vars::RunFile> run_file_;
  scheduler::RunBlock* run_ = nullptr;
  bool previous_run_ended_well_ = false;
  std::unique_ptr<FailSafe> failsafe_;
  std::unique_ptr<Retainer> retainer_;
  std::optional<mirror::Settings> mirror_settings_;  // of a board of a plant
  std::optional<mirror::Mirror> mirror_;
  ExternalPart external_;
  std::vector<ModuleLibrary> libraries_;  // one per module, empty for processes
  std::vector<scheduler::Task> tasks_;
  scheduler::SystemClock clock_;
  std::unique_ptr<scheduler::Engine> engine_;
  std::unique_ptr<Processes> processes_;
  std::unique_ptr<Phases> phases_;
  std::unique_ptr<NormalThreads> normal_threads_;
  std::unique_ptr<ModuleOrders> orders_;
  std::atomic<std::uint32_t> stop_order_{0};  // 1 + index of the module whose policy stops the node
  bool started_ = false;
  bool leave_nothing_ = false;  // nothing of this node was there before, and nothing of this run is worth keeping
};

}  // namespace indurop::node
