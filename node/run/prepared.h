// SPDX-License-Identifier: Apache-2.0
// Second phase of a run: the node's name is claimed, the rights are obtained, and the memory shared with processes and
// tools is created, with the values the run begins with.

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "node/modules/failsafe.h"
#include "node/modules/retainer.h"
#include "node/parts/pools_part.h"
#include "node/run/checked.h"
#include "node/run/rights.h"
#include "scheduler/run_block_setup.h"
#include "store/tape/tape.h"
#include "store/vars/batch.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

namespace indurop::node {

// Holds the node's name as long as it lives. If no files of the node existed before, none are left behind unless keep()
// is called.
class ClaimedName {
 public:
  static Result<ClaimedName, Ending> claim(const std::string& node, const Console& console);
  ClaimedName(ClaimedName&& other) noexcept;
  ClaimedName(const ClaimedName&) = delete;
  ClaimedName& operator=(const ClaimedName&) = delete;
  ClaimedName& operator=(ClaimedName&&) = delete;
  ~ClaimedName();
  void keep() noexcept { remove_all_ = false; }
  // Claims the name again if its lock file was removed. Returns false if that was necessary.
  bool hold();

 private:
  ClaimedName(std::string node, vars::NodeLock lock);
  std::string node_;
  std::optional<vars::NodeLock> lock_;
  bool remove_all_;
};

struct Prepared {
  ClaimedName name;
  Rights rights;
  scheduler::RunBlockSetup setup;
  PoolsPart pools;
  std::unique_ptr<vars::Store> store;
  vars::RunFile run_file;
  std::unique_ptr<FailSafe> failsafe;
  std::unique_ptr<Retainer> retainer;  // none in a simulation
  std::unique_ptr<tape::Tape> tape;    // null if not requested
  vars::Batch batch;                   // values that must change in one tick
  [[nodiscard]] scheduler::RunBlock& run() const noexcept {
    return *static_cast<scheduler::RunBlock*>(run_file.data());
  }
};

// From then on the console reports on the run.
Result<Prepared, Ending> prepare(const Options& options, const Checked& checked, Console& console,
                                 base::StopSignal& signals);

}  // namespace indurop::node
