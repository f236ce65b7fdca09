// SPDX-License-Identifier: Apache-2.0
// Takes keyframes of the modules: twice a second, a copy of what each keeps, between two of its runs. On a normal
// thread; the schedule does nothing for it and never waits.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "node/exchange/exchanges.h"
#include "node/parts/process_requests.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/loaded.h"
#include "node/run/prepared.h"
#include "scheduler/engine.h"
#include "store/tape/keyframes.h"

namespace indurop::node {

class KeyframePart {
 public:
  // Returns null if there is no tape, or no process and no module that declares what it keeps. A failure is reported:
  // the node runs without. All references are borrowed.
  static std::unique_ptr<KeyframePart> begin(const Options& options, const Prepared& prepared, const Loaded& loaded,
                                             const scheduler::Engine& engine, const Console& console);

  // Called repeatedly, on one normal thread. `kernel`: the schedule's clock. A module that is being exchanged is left
  // out, and so is, from then on, one whose new version keeps something else.
  void take(scheduler::Kernel& kernel, const Exchanges& exchanges);

 private:
  struct Subject {
    std::uint32_t module = 0;
    const ModuleMemory* memory = nullptr;
    std::string form = {};  // when the node started
    bool due = false;
    std::uint32_t missed = 0;  // in a row
  };
  KeyframePart(const Prepared& prepared, const scheduler::Engine& engine, const Console& console,
               std::vector<Subject> subjects, std::optional<tape::KeyframeWriter> writer, ProcessRequests processes);
  void begin_period();
  bool take_one(std::size_t index, scheduler::Kernel& kernel);

  const Prepared& prepared_;
  const scheduler::Engine& engine_;
  const Console& console_;
  std::vector<Subject> subjects_;
  std::optional<tape::KeyframeWriter> writer_;  // for thread modules, if there are subjects
  ProcessRequests processes_;
  rt::MonoTime next_{};
};

}  // namespace indurop::node
