// SPDX-License-Identifier: Apache-2.0
// What is known of one node when a question is asked: from its shared memory, from a recording or from a black box.
// Plain data; all times are the node's, in ns.

#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "operate/journal.h"

namespace indurop::explain {

struct ModuleFact {
  std::string name;
  std::string type;       // "thread", "process"
  std::string operation;  // "periodic", "sporadic", "non-real"
  std::int64_t period_ns = 0;
  std::int64_t offset_ns = 0;
  std::int64_t deadline_ns = 0;  // 0: the period
  int priority = 0;              // lowest value first
  int core = -1;
  int fifo_priority = 0;          // of the thread it runs in; 0: not known, or none
  std::string state = "running";  // in the words of `indurop status`
  std::uint64_t runs = 0;
  std::uint64_t faults = 0;
  std::uint64_t restarts = 0;
  std::uint64_t fault_tick = 0;
  std::string fault;               // the last one; empty: none
  std::vector<std::string> after;  // modules of other cores it waits for in each tick
};

struct RunFact {
  std::uint32_t module = 0;  // index into Facts::modules
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  bool faulted = false;
};

// Runs of a module that took place and that the recording does not have, between two that it has.
struct HoleFact {
  std::uint32_t module = 0;
  std::uint64_t after_tick = 0;   // of the run before
  std::uint64_t before_tick = 0;  // of the run behind
  std::int64_t from_ns = 0;       // end of the one before
  std::int64_t to_ns = 0;         // start of the one behind
  std::uint64_t runs = 0;         // how many
};

// A release that found the module unfinished.
struct OverrunFact {
  std::uint32_t module = 0;
  std::uint64_t tick = 0;
  std::int64_t own_ns = 0;
  bool started = false;
};

// Somebody set, forced, stopped or started something.
using OrderFact = operate::Order;

// What the kernel counted for one thread of the node between two looks.
struct KernelFact {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::int32_t core = -1;
  std::string thread;
  std::int64_t ran_ns = 0;         // processor time
  std::int64_t waited_ns = 0;      // ready, and others had the core
  std::uint64_t major_faults = 0;  // pages that came from a disk
  std::int64_t stolen_ns = 0;      // the machine below took the core
};

// Another board, as this one sees it.
struct BoardFact {
  std::string name;
  std::string state;  // "alive", "silent", "absent", "mismatched"
  std::string problem;
  std::int64_t heard_ns = 0;  // its last frame; 0: never
  std::uint64_t losses = 0;   // how often it fell silent
  std::uint64_t lost_updates = 0;
};

struct VariableFact {
  std::string name;
  std::vector<std::string> writers;  // modules, "control@sensor" in a plant
  std::string owner;                 // board whose value counts; empty: this one
  std::int64_t every_ns = 0;         // sent at most this often
  std::int64_t forced_until_ns = 0;  // 0: not forced; INT64_MAX: until it is let go
};

// A new value, as far as the tape tells.
struct ChangeFact {
  std::string variable;
  std::string module;  // empty: none of the schedule
  std::uint64_t tick = 0;
  std::int64_t time_ns = 0;
};

struct Facts {
  std::string node;
  std::string board;  // empty: none of a plant
  bool is_virtual = false;
  bool realtime = false;  // its threads have real-time priority
  bool alive = false;
  std::int64_t basic_period_ns = 0;
  std::int64_t epoch_ns = 0;  // of tick 0
  std::int64_t now_ns = 0;    // when it was looked
  std::uint64_t tick = 0;     // number of the last tick begun + 1
  std::uint64_t lost_ticks = 0;
  std::uint64_t first_tick = 0;  // from here on all runs are known
  std::string stop_reason;
  bool closed = false;  // of a recording whose end is not that of the node, unless stop_reason says so
  std::int64_t wall_minus_node_ns = 0;
  std::int64_t lease_ns = 0;  // a board not heard for so long is gone
  std::vector<ModuleFact> modules;
  std::vector<RunFact> runs;  // by start
  std::vector<HoleFact> holes;
  std::vector<OverrunFact> overruns;
  std::vector<OrderFact> orders;
  std::vector<KernelFact> kernel;   // what was unusual
  std::int64_t kernel_from_ns = 0;  // nothing else was, from here
  std::int64_t kernel_to_ns = 0;    // to here; 0: nobody looked
  std::vector<BoardFact> boards;
  std::vector<VariableFact> variables;
  std::vector<ChangeFact> changes;  // by time

  [[nodiscard]] const ModuleFact* find_module(std::string_view name) const noexcept;
  [[nodiscard]] const VariableFact* find_variable(std::string_view name) const noexcept;
  // Runs of the module (an index) are missing around the tick; null: none.
  [[nodiscard]] const HoleFact* hole_around(std::uint32_t module, std::uint64_t number) const noexcept;
  // The same of all modules of a core and a time.
  [[nodiscard]] const HoleFact* hole_within(std::int32_t core, std::int64_t from_ns, std::int64_t to_ns) const noexcept;
  [[nodiscard]] std::uint64_t tick_at(std::int64_t time_ns) const noexcept;
  // Whole basic periods in so long; 0 if one of both makes no sense. What the facts come from may be damaged.
  [[nodiscard]] std::uint64_t ticks_in(std::int64_t ns) const noexcept {
    return basic_period_ns > 0 && ns > 0 ? static_cast<std::uint64_t>(ns / basic_period_ns) : 0;
  }
  // In every so many ticks the module runs, 1 at least.
  [[nodiscard]] std::uint64_t ticks_between_runs(const ModuleFact& module) const noexcept {
    return std::max<std::uint64_t>(ticks_in(module.period_ns), 1);
  }
  [[nodiscard]] std::int64_t release_of(std::uint64_t number) const noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(epoch_ns) +
                                     number * static_cast<std::uint64_t>(basic_period_ns));
  }
};

}  // namespace indurop::explain
