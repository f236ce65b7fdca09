// SPDX-License-Identifier: Apache-2.0
// One schedule of an engine: the bands of its modules, the threads of these bands, who waits for whom, and what each
// core's tick thread runs and releases. While another schedule takes over, an engine has two, which share the states of
// the modules. Built by a normal thread; nothing of it changes afterwards but the bands.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "scheduler/band.h"
#include "scheduler/engine_settings.h"

namespace indurop::scheduler {

// A module in a schedule.
struct Member {
  Task task;
  TaskState* state = nullptr;
  const Band* before = nullptr;  // its band in the schedule before; null: none
};

class Schedule {
 public:
  // What the tick thread of one core runs and releases, in execution order.
  struct CoreBands {
    const Schedule* schedule = nullptr;
    int core = 0;
    std::vector<Band*> here;      // run in the tick thread
    std::vector<Band*> released;  // released by it
    std::vector<Member> members;  // of these bands
  };
  // What an engine shares between its schedules, borrowed.
  struct Parts {
    RunBlock& block;
    Kernel& kernel;
    const Hooks& hooks;
    const EngineSettings& settings;
    std::function<CoreTrace&(int core)> trace;
  };

  // Not real-time safe.
  Schedule(const Parts& parts, std::vector<Member> members);
  ~Schedule();
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  // Starts a thread for each band that needs one. Errors: those of rt::Thread::start(). stop() is called all the same.
  Status start_threads();
  // Runs what is due of bands with threads, for callers without threads.
  void drain() const noexcept;
  // As Runner::enforce_budget(), for all bands.
  void enforce_budgets(rt::MonoTime now, bool stopping, std::int64_t grace_ns, std::int64_t late_ns) const noexcept;
  // After the threads have ended: completes statistics.
  void finish() const noexcept;
  // Ends these threads: first request it, then wait for it.
  void request_stop() noexcept;
  void join() noexcept;

  // Writes the FIFO priorities of the modules into their records.
  void publish_priorities() const noexcept;

  // Returns the bands of a core, which lives as long as the schedule.
  [[nodiscard]] const CoreBands& on(int number) noexcept;
  [[nodiscard]] std::span<const std::unique_ptr<CoreBands>> cores() const noexcept { return cores_; }
  // Periodic ones in execution order, then after-base, then event handler.
  [[nodiscard]] std::span<const std::unique_ptr<Band>> bands() const noexcept { return bands_; }
  // Returns the band that runs a module. Null: none, or the scheduler does not see the end of its runs.
  [[nodiscard]] Band* find_band(std::uint32_t module) const noexcept;
  [[nodiscard]] std::span<const Member> members() const noexcept { return members_; }
  // Returns the FIFO priority with which a module runs; 0: without.
  [[nodiscard]] int priority_of(std::uint32_t module) const noexcept;
  // Returns true if all threads wait for releases.
  [[nodiscard]] bool is_ready() const noexcept;
  // Returns true if all releases so far are done.
  [[nodiscard]] bool is_at_rest() const noexcept;

  // Bands wait for their predecessors explicitly; then those that wait check again. Any thread.
  [[nodiscard]] bool is_gated() const noexcept { return gated_; }
  void wake_waiting() const noexcept;

  // How often runs have to be compared with their budgets, ns.
  [[nodiscard]] std::int64_t watchdog_period() const noexcept { return watchdog_period_; }

 private:
  struct Planned;
  void build_periodic(std::vector<Planned>& planned);
  void build_sporadic(std::vector<Planned>& planned);
  void add_band(std::vector<Planned>& planned, const BandPlan& plan, const std::vector<std::size_t>& threads,
                const std::vector<std::size_t>& processes);
  void connect_predecessors(const std::vector<Planned>& planned);
  CoreBands& core(int number);
  [[nodiscard]] static bool has_thread(const Band& band) noexcept;

  Parts parts_;
  std::vector<Member> members_;  // in the order of the file
  std::vector<std::unique_ptr<CoreBands>> cores_;
  std::vector<std::unique_ptr<Band>> bands_;
  std::vector<std::unique_ptr<KernelThread>> threads_;
  bool gated_ = false;
  std::int64_t watchdog_period_ = 0;
};

}  // namespace indurop::scheduler
