// SPDX-License-Identifier: Apache-2.0
// The data that one run of a node publishes and shares with its process modules: a shared-memory block that the
// real-time threads write without locks and all others only read. Fixed layout, offsets instead of pointers.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/rt/signal_word.h"
#include "scheduler/histogram.h"
#include "scheduler/module_kind.h"

namespace indurop::scheduler {

inline constexpr std::uint64_t kRunMagic = 0x314e555255444e49ULL;  // "INDURUN1"
inline constexpr std::uint32_t kRunAbi = 12;
inline constexpr std::size_t kTextLength = 160;

enum class NodeState : std::uint32_t { Starting, Running, Stopping, Stopped, Failed };
enum class ModuleState : std::uint32_t {
  Loaded,    // start() not called yet
  Starting,  // process launched, not yet ready
  Running,
  Stopped,     // by command, or at the end of the run
  Faulted,     // quarantined after a fault, see last_fault
  Restarting,  // process waiting for its restart delay
  Exited,      // a non-real-time module that finished
};
enum class FaultKind : std::uint32_t { None, Exception, Signal, Budget, Overrun, Exit, StartFailed };

enum class VersionState : std::uint32_t {
  Settled,   // no exchange is in progress
  Watched,   // it was exchanged; the previous version runs again if this one fails
  Returned,  // the previous version runs again
};

// A number that one thread writes while others may read it; a sequence number elsewhere keeps related ones consistent.
template <class T>
class Relaxed {
 public:
  Relaxed() = default;
  explicit Relaxed(T value) noexcept : value_(value) {}
  Relaxed(const Relaxed& other) noexcept : value_(other.load()) {}
  Relaxed& operator=(const Relaxed& other) noexcept {
    value_.store(other.load(), std::memory_order_relaxed);
    return *this;
  }
  ~Relaxed() = default;
  Relaxed& operator=(T value) noexcept {
    value_.store(value, std::memory_order_relaxed);
    return *this;
  }
  [[nodiscard]] T load() const noexcept { return value_.load(std::memory_order_relaxed); }
  operator T() const noexcept { return load(); }  // NOLINT(google-explicit-constructor)

 private:
  std::atomic<T> value_;
};

// One Distribution = one quantity in ns. Single writer (the thread that runs the module); readers may see a sample
// counted in one field and not yet in the next.
struct Distribution {
  std::atomic<std::uint64_t> count;
  std::atomic<std::int64_t> min;
  std::atomic<std::int64_t> max;
  std::atomic<std::int64_t> sum;
  Histogram histogram;
};

// A module's configuration as the node loaded it, and its counters so far.
struct ModuleRecord {
  // Written before the run, constant afterwards.
  char name[kNameLength];  // unique; <name>, or the file name without directory and ending: "cntr1"
  char file[256];
  ModuleType type;
  Operation operation;
  std::int32_t core;              // -1: not pinned
  std::uint32_t property_offset;  // into the block: "name\0value\0name\0value\0"
  std::uint32_t property_size;
  // What another schedule may change. Written by a normal thread of the node.
  Relaxed<OverrunPolicy> overrun_policy;
  Relaxed<std::int32_t> priority;       // as in the XML: lowest value first
  Relaxed<std::int32_t> fifo_priority;  // 0: not SCHED_FIFO
  Relaxed<std::int64_t> period_ns;      // 0 if not periodic
  Relaxed<std::int64_t> offset_ns;
  Relaxed<std::int64_t> deadline_ns;  // 0: none
  Relaxed<std::int64_t> budget_ns;    // 0: none
  Relaxed<bool> ended;                // the schedule is without it
  // Counters.
  std::atomic<ModuleState> state;
  std::atomic<std::int32_t> pid;  // process modules
  std::atomic<std::uint64_t> runs;
  std::atomic<std::uint64_t> skipped;
  std::atomic<std::uint64_t> overruns;
  std::atomic<std::uint64_t> deadline_misses;
  std::atomic<std::uint64_t> faults;
  std::atomic<std::uint64_t> restarts;
  std::atomic<std::uint64_t> lost_messages;  // irp::printf lines that found the ring full
  std::atomic<std::uint32_t> fault_kind;     // FaultKind of the last fault
  std::atomic<std::uint64_t> fault_tick;
  char last_fault[kTextLength];  // "SIGSEGV at address 0x0"; valid once fault_kind is set
  // Commands from other processes, see module_command.h.
  std::atomic<std::uint64_t> command;
  std::atomic<std::uint64_t> answer;
  // The version of its code (thread modules). Written by a normal thread of the node, the number last.
  std::atomic<std::uint64_t> version;       // 1: the one that the node started with; each exchange adds 1
  std::atomic<std::uint64_t> version_tick;  // of its first run; 0 for version 1
  std::atomic<VersionState> version_state;
  std::atomic<std::uint32_t> kept_loaded;  // earlier versions that could not be unloaded
  char digests[2][72];                     // SHA-256 of its file, at digests[version % 2]
  std::int64_t last_start_ns;              // CLOCK_MONOTONIC, of the run in progress or the last one
  std::atomic<std::int64_t> last_exec_ns;
  // Distributions.
  Distribution jitter;    // |J_n|, Eq. (1), ns
  Distribution latency;   // release to first instruction, ns
  Distribution exec;      // run() itself, ns
  Distribution response;  // release to end of run(), ns
};

// The release of a process module. Written by node and module process. `released` and `done` count releases.
struct ProcessSlot {
  rt::SignalWord wake;                   // the node wakes the process
  std::atomic<std::uint64_t> released;   // last release number, 0: none yet
  std::atomic<std::uint64_t> taken;      // release number of the last run that a process began, or took to begin
  std::atomic<std::uint64_t> done;       // release number of the last finished run
  std::atomic<std::int64_t> release_ns;  // grid time of `released`
  std::atomic<std::uint64_t> release_tick;
  std::atomic<std::int64_t> start_ns;       // first instruction of the current or last run
  std::atomic<std::int64_t> end_ns;         // end of the last run
  std::atomic<std::int32_t> pid;            // set by irp::initPeriodExe()
  std::atomic<std::uint32_t> stop;          // 1: waitPeriod() must return false / the process should end
  std::atomic<std::uint32_t> module;        // index
  std::atomic<std::int32_t> obtained_fifo;  // priority obtained, 0 none
  std::atomic<std::uint32_t> version;       // number on the tape of its file; written by the node before it runs
  // The process is exchanged while the node runs: another one follows it between two runs. Process ids, 0: none.
  rt::SignalWord turn;                     // wakes the process that follows
  rt::SignalWord recall;                   // wakes the one that was followed
  std::atomic<std::int32_t> runner;        // began the run `taken`; written by it
  std::atomic<std::int32_t> successor;     // launched next to the one that runs, or kBeingLaunched; written by the node
  std::atomic<std::int32_t> ready;         // waits for its turn; written by it
  std::atomic<std::int32_t> may_follow;    // may take the place of `pid`; written by the node
  std::atomic<std::uint64_t> follow_from;  // tick of its first release; written by the node before `may_follow`
  std::atomic<std::int32_t> left;          // was `pid` and has given its place away; written by it before that
  std::atomic<std::int32_t> followed;      // has the place, and what the other one kept; written by it
  std::atomic<std::uint64_t> follow_tick;  // tick of the newest release then; written by the same before `followed`
  std::atomic<std::int32_t> previous;      // stays ready when it was followed; written by the node
};
// In place of the successor's process id: the process may run already, but its id is not known to the node yet.
inline constexpr std::int32_t kBeingLaunched = -1;

// One entry of the slot log: which module ran when. Ring, newest overwrites oldest.
struct SlotEntry {
  std::atomic<std::uint64_t> sequence;  // entry number + 1, stored last; 0 while being written
  Relaxed<std::uint64_t> tick;
  Relaxed<std::uint64_t> slot;
  Relaxed<std::int64_t> release_ns;
  Relaxed<std::int64_t> start_ns;
  Relaxed<std::int64_t> end_ns;
  Relaxed<std::uint32_t> module;
  Relaxed<std::uint32_t> reserved;
};

// One overrun: which module, when, the time it used itself, and what ran before it in that basic period.
struct OverrunEntry {
  std::atomic<std::uint64_t> sequence;  // entry number + 1, stored last
  Relaxed<std::uint64_t> tick;
  Relaxed<std::uint64_t> slot;
  Relaxed<std::int64_t> own_ns;       // time since its start, or 0 if it had not started
  Relaxed<std::int64_t> latency_ns;   // its own release-to-run latency
  Relaxed<std::int32_t> previous;     // module that ran before it in the slot, -1 none
  Relaxed<std::int64_t> previous_ns;  // execution time of that module
  Relaxed<std::uint32_t> started;     // 0: it was still waiting for its turn
  Relaxed<std::uint32_t> module;
};

// Text from irp::printf and from the node's real-time threads, for a normal thread to print.
inline constexpr std::size_t kMessageText = 488;
struct MessageEntry {
  std::atomic<std::uint64_t> sequence;  // bounded multi-producer queue: ticket protocol
  std::uint32_t module;
  std::uint32_t length;
  std::int64_t time_ns;
  char text[kMessageText];
};
struct MessageRing {
  std::atomic<std::uint64_t> head;  // next ticket for a producer
  std::atomic<std::uint64_t> tail;  // next entry for the consumer
  std::atomic<std::uint64_t> dropped;
  std::uint32_t capacity;  // power of two
  std::uint32_t reserved;
  std::uint64_t entries_offset;  // offset of MessageEntry[capacity] from the block's start
};

// The rights the operating system granted, which may be less than was requested.
struct Obtained {
  std::uint32_t fifo;  // 1: SCHED_FIFO
  std::int32_t tick_priority;
  std::uint32_t memory_locked;
  std::uint32_t cpu_dma_latency;  // 1: held at 0
  std::uint32_t pinned;
  std::int32_t tick_core;
  std::uint32_t preempt_rt;         // kernel is PREEMPT_RT
  std::uint32_t throttle_permille;  // sched_rt_runtime / sched_rt_period, 1000: unlimited
  char why[kTextLength];            // first request that was refused, and what to do
};

struct RunBlock {
  std::atomic<std::uint64_t> magic;
  std::uint32_t abi;
  std::atomic<std::uint32_t> module_count;  // grows when modules are added; then their records are complete
  std::uint32_t module_capacity;            // there is room for so many
  std::uint64_t total_size;
  char node_name[48];
  char config_file[256];
  char board[48];  // name in the plant, and the plant's file; empty: none
  char plant_file[256];
  char deployment[72];  // id of the deployment; empty: the node was started by hand
  std::atomic<std::int32_t> node_pid;
  std::uint64_t node_start_time;  // field 22 of /proc/PID/stat
  std::int64_t started_wall_ns;   // CLOCK_REALTIME
  std::atomic<NodeState> state;
  std::int64_t basic_period_ns;
  Relaxed<std::int64_t> macro_period_ns;
  Relaxed<std::uint64_t> slot_count;
  // The schedule. Written by a normal thread of the node, the number last.
  std::atomic<std::uint64_t> schedule;       // 1: the one that the node started with; each change adds 1
  std::atomic<std::uint64_t> schedule_tick;  // its first tick; 0 for schedule 1
  char schedule_files[2][256];               // its configuration, at schedule_files[schedule % 2]
  // CLOCK_MONOTONIC of tick 0. A module whose devices have a clock of their own moves it a little, and all later ticks
  // with it.
  std::atomic<std::int64_t> epoch_ns;
  // How long after the frames of a tick devices of that module have a pulse of their clock, and shall have it; both 0:
  // no module has said.
  std::atomic<std::int64_t> pulse_after_ns;
  std::atomic<std::int64_t> pulse_wanted_ns;
  std::atomic<std::int64_t> virtual_ns;  // time of a simulation; 0: CLOCK_MONOTONIC
  std::atomic<std::uint64_t> tick;       // number of the last tick begun + 1; 0: none
  std::atomic<std::uint64_t> lost_ticks;
  std::atomic<std::int64_t> spin_margin_ns;
  Obtained obtained;
  char stop_reason[kTextLength];
  char unsaved[kTextLength];     // why retained values cannot be saved at present; empty: they are saved
  std::uint64_t modules_offset;  // ModuleRecord[module_capacity]
  std::uint64_t slots_offset;    // ProcessSlot[module_capacity]
  std::uint64_t rings_offset;    // MessageRing[module_capacity + 1], the last one of the node itself
  std::uint64_t slot_log_offset;
  std::uint32_t slot_log_capacity;  // power of two
  std::uint32_t overrun_log_capacity;
  std::uint64_t overrun_log_offset;
  std::atomic<std::uint64_t> slot_log_next;
  std::atomic<std::uint64_t> overrun_log_next;
  Distribution tick_lateness;  // T_n - P_n of the tick thread itself, ns

  template <class T>
  T* at(std::uint64_t offset) noexcept {
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(this) + offset);
  }
  template <class T>
  const T* at(std::uint64_t offset) const noexcept {
    return reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(this) + offset);
  }
  ModuleRecord* modules() noexcept { return at<ModuleRecord>(modules_offset); }
  const ModuleRecord* modules() const noexcept { return at<ModuleRecord>(modules_offset); }
  ProcessSlot* process_slots() noexcept { return at<ProcessSlot>(slots_offset); }
  const ProcessSlot* process_slots() const noexcept { return at<ProcessSlot>(slots_offset); }
  MessageRing* rings() noexcept { return at<MessageRing>(rings_offset); }
  const MessageRing* rings() const noexcept { return at<MessageRing>(rings_offset); }
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

}  // namespace indurop::scheduler
