// SPDX-License-Identifier: Apache-2.0
// The known facts about one node when a question is asked: from its shared memory, from a recording or from a black
// box. Plain data; all times are the node's, in ns.

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/operate/journal.h"

namespace indurop::explain {

struct ModuleFact {
  std::string name;
  std::string type;       // "thread", "process"
  std::string operation;  // "periodic", "sporadic", "non-real"
  std::int64_t period_ns = 0;
  std::int64_t offset_ns = 0;
  std::int64_t deadline_ns = 0;  // 0: same as the period
  int priority = 0;              // lowest value first
  int core = -1;
  int fifo_priority = 0;          // of its thread; 0: not known, or none
  std::string state = "running";  // as shown by `indurop status`
  std::uint64_t runs = 0;
  std::uint64_t faults = 0;
  std::uint64_t restarts = 0;
  std::uint64_t fault_tick = 0;
  std::string fault;               // the last fault; empty: none
  std::vector<std::string> after;  // modules of other cores that it waits for in each tick
};

struct RunFact {
  std::uint32_t module = 0;  // index into Facts::modules
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  bool faulted = false;
};

// Missing runs of a module: they took place, but the recording does not have them, between two that it has.
struct HoleFact {
  std::uint32_t module = 0;
  std::uint64_t after_tick = 0;   // tick of the run before the hole
  std::uint64_t before_tick = 0;  // tick of the run after it
  std::int64_t from_ns = 0;       // end of the run before
  std::int64_t to_ns = 0;         // start of the run after
  std::uint64_t runs = 0;         // number of missing runs
};

// A release at which the module was still unfinished.
struct OverrunFact {
  std::uint32_t module = 0;
  std::uint64_t tick = 0;
  std::int64_t own_ns = 0;
  bool started = false;
};

// A user set, forced, stopped or started something.
using OrderFact = operate::Order;

// The kernel's counters for one thread of the node, between two readings.
struct KernelFact {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::int32_t core = -1;
  std::string thread;
  std::int64_t ran_ns = 0;         // processor time
  std::int64_t waited_ns = 0;      // ready, but other threads had the core
  std::uint64_t major_faults = 0;  // pages loaded from a disk
  std::int64_t stolen_ns = 0;      // the hypervisor took the core
};

// Another board, as seen by this one.
struct BoardFact {
  std::string name;
  std::string state;  // "alive", "silent", "absent", "mismatched"
  std::string problem;
  std::int64_t heard_ns = 0;  // time of its last frame; 0: never
  std::uint64_t losses = 0;   // number of times it fell silent
  std::uint64_t lost_updates = 0;
};

struct VariableFact {
  std::string name;
  std::vector<std::string> writers;  // modules, "control@sensor" in a plant
  std::string owner;                 // board whose value counts; empty: this one
  std::int64_t every_ns = 0;         // minimum interval between sends
  std::int64_t forced_until_ns = 0;  // 0: not forced; INT64_MAX: until released
  bool recorded = true;              // its changes are among the facts; they are those of one variable only
};

// A field device, or a point of one, whose quality is a variable.
struct DeviceFact {
  static constexpr std::int64_t kSinceBefore = INT64_MIN;  // it had this value before anything is known
  static constexpr std::int64_t kGood = 1;
  static constexpr std::int64_t kNotGood = -1;  // a bool does not tell more
  struct Quality {
    std::int64_t time_ns = kSinceBefore;
    std::int64_t number = 0;  // docs/io.md, Quality
  };
  std::string name;
  std::string place;                   // "ethercat eth1, slave 2"
  std::string quality;                 // variable
  std::vector<std::string> variables;  // which it exchanges: names of variables or parts of them
  std::vector<Quality> qualities;      // its values, as far as they are known, by time
};

// A new value, as far as the tape shows.
struct ChangeFact {
  std::string variable;
  std::string module;  // empty: no module of the schedule
  std::uint64_t tick = 0;
  std::int64_t time_ns = 0;
};

struct Facts {
  std::string node;
  std::string board;  // empty: no board of a plant
  bool is_virtual = false;
  bool realtime = false;  // its threads have real-time priority
  bool alive = false;
  std::int64_t basic_period_ns = 0;
  std::int64_t epoch_ns = 0;  // time of tick 0
  std::int64_t now_ns = 0;    // time when the facts were read
  std::uint64_t tick = 0;     // number of the last tick begun + 1
  std::uint64_t lost_ticks = 0;
  std::uint64_t schedule = 0;       // number of the schedule that `modules` tell; 0: not known, 1: there was no other
  std::uint64_t schedule_tick = 0;  // its first
  std::uint64_t first_tick = 0;     // from this tick on all runs are known
  std::string stop_reason;
  bool closed = false;  // the facts are of a recording that did not end with the node, unless stop_reason is set
  std::int64_t wall_minus_node_ns = 0;
  std::int64_t lease_ns = 0;  // a board silent for this time is gone
  std::vector<ModuleFact> modules;
  std::vector<RunFact> runs;  // by start
  std::vector<HoleFact> holes;
  std::vector<OverrunFact> overruns;
  std::vector<OrderFact> orders;
  std::vector<KernelFact> kernel;   // unusual readings only
  std::int64_t kernel_from_ns = 0;  // no other unusual readings from this time
  std::int64_t kernel_to_ns = 0;    // until this time; 0: no readings
  std::vector<BoardFact> boards;
  std::vector<VariableFact> variables;
  std::vector<DeviceFact> devices;
  std::vector<ChangeFact> changes;  // by time

  [[nodiscard]] const ModuleFact* find_module(std::string_view name) const noexcept;
  [[nodiscard]] const VariableFact* find_variable(std::string_view name) const noexcept;
  // Returns another board, as seen by this one.
  [[nodiscard]] const BoardFact* find_peer(std::string_view name) const noexcept;
  // Returns the hole in the runs of the module (an index) around the tick; null: none.
  [[nodiscard]] const HoleFact* hole_around(std::uint32_t module, std::uint64_t number) const noexcept;
  // Returns such a hole of any module of a core in a period of time.
  [[nodiscard]] const HoleFact* hole_within(std::int32_t core, std::int64_t from_ns, std::int64_t to_ns) const noexcept;
  [[nodiscard]] std::uint64_t tick_at(std::int64_t time_ns) const noexcept;
  // Returns the number of whole basic periods in a duration; 0 if either is invalid. The source of the facts may be
  // damaged.
  [[nodiscard]] std::uint64_t ticks_in(std::int64_t ns) const noexcept {
    return basic_period_ns > 0 && ns > 0 ? static_cast<std::uint64_t>(ns / basic_period_ns) : 0;
  }
  // The module runs in every n-th tick; n is at least 1.
  [[nodiscard]] std::uint64_t ticks_between_runs(const ModuleFact& module) const noexcept {
    return std::max<std::uint64_t>(ticks_in(module.period_ns), 1);
  }
  [[nodiscard]] std::int64_t release_of(std::uint64_t number) const noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(epoch_ns) +
                                     number * static_cast<std::uint64_t>(basic_period_ns));
  }
};

// Returns the facts of a board of the plant; null: there are none.
inline const Facts* find_board(std::span<const Facts> plant, const std::string& board) noexcept {
  const auto found = std::find_if(plant.begin(), plant.end(), [&](const Facts& one) { return one.board == board; });
  return found == plant.end() ? nullptr : &*found;
}

// Converts a time to the clock of the asked board; boards of one simulation have one clock.
inline std::int64_t on_clock_of(const Facts& to, const Facts& from, std::int64_t time_ns) noexcept {
  return time_ns + from.wall_minus_node_ns - to.wall_minus_node_ns;
}

}  // namespace indurop::explain
