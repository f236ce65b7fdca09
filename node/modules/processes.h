// SPDX-License-Identifier: Apache-2.0
// Process modules: launched, supervised, restarted within limits, ended in order. Runs on a normal thread; the
// real-time threads only see ModuleRecord::state and the release slots.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "node/modules/failsafe.h"
#include "node/modules/file_mark.h"
#include "node/run/console.h"
#include "scheduler/run_block.h"
#include "store/tape/tape.h"

namespace indurop::node {

// "exited with code 1", of a status of waitpid().
std::string describe_end(int status);

class Processes {
 public:
  // What a process was launched from.
  struct Program {
    std::filesystem::path file;
    FileMark mark = {};         // of it when it was launched
    std::string digest = {};    // its SHA-256
    std::uint32_t version = 0;  // number on the tape
  };

  // All references are borrowed; `tape`: null if there is none.
  Processes(const config::Config& config, scheduler::RunBlock& run, std::string node, bool realtime, Console& console,
            FailSafe& failsafe, tape::Tape* tape);
  ~Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  // Launches all processes. Returns false if one cannot be started at all (reported on the console).
  bool launch_all();
  // Returns true if all periodic and sporadic ones have enrolled or ended.
  [[nodiscard]] bool ready() const noexcept;
  // Handles deaths, restarts, enrolments, budgets. Returns true if the node must stop because of one (reason()). `now`
  // is real time, `schedule` that of the schedule, which restarts follow. `stalled_ns`: for how long the machine ran
  // nothing of the node so far, which does not count as time of a run.
  bool supervise(rt::MonoTime now, rt::MonoTime schedule, std::int64_t stalled_ns = 0);
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }
  // When the next process is to be restarted, by the schedule's time; nullopt: none is.
  [[nodiscard]] std::optional<rt::MonoTime> next_restart() const noexcept;
  // For a single process. stop() only requests the end; supervise() completes it, without a fault, and has_ended()
  // returns true after it. start() returns false if the process cannot be launched (reported on the console).
  void stop(std::uint32_t module, rt::MonoTime now);
  [[nodiscard]] bool has_ended(std::uint32_t module) const noexcept;
  bool start(std::uint32_t module) { return start(module, false); }
  // For a module that another schedule adds. If it is no process, nothing happens. `module` is borrowed.
  void add(std::uint32_t index, const config::Module& module);
  // The program of a module without a process; `digest`: its SHA-256.
  void set_file(std::uint32_t module, const std::filesystem::path& file, const std::string& digest);
  // Like start(), for a process that no schedule has yet: if it dies, it is neither restarted nor an event for the
  // plant. From let_run() on it is like the others, with the FIFO priority of its record.
  bool start_aside(std::uint32_t module) { return start(module, true); }
  void let_run(std::uint32_t module);
  // For an exchange of a process. The one that runs now, -1: it has died; and what it was launched from.
  [[nodiscard]] pid_t pid(std::uint32_t module) const noexcept;
  [[nodiscard]] const Program& program(std::uint32_t module) const noexcept;
  // Launches another process of the module next to it, which is not supervised. Errors: System.
  Result<pid_t> launch_next_to(std::uint32_t module, const std::filesystem::path& file) const;
  // The next one that is launched is one of this program. Returns the program before it.
  Program set_program(std::uint32_t module, Program program);
  // While it is held, a module is not restarted when its process dies.
  void hold(std::uint32_t module, bool is_held) noexcept;
  // This process runs from now on, and is restarted with this file; in a deployment as long as it has this digest. The
  // one before is not supervised any more. Returns what that one was.
  Program replace(std::uint32_t module, pid_t pid, Program program);
  // Kills a process that does not return in a simulation, where it has unlimited time.
  void kill_hanging(std::uint32_t module);
  // Requests all to end, waits, kills those still running.
  void end_all();

 private:
  struct Child {
    std::uint32_t index = 0;
    const config::Module* module = nullptr;
    Program program;
    pid_t pid = -1;
    rt::MonoTime restart_at{};
    std::deque<rt::MonoTime> restarts;  // times of those within the window
    std::int64_t run_start_ns = 0;      // of the run that was seen last
    std::int64_t stalled_ns = 0;        // the machine, when it was seen
    std::int64_t excused_ns = 0;        // of its time, which does not count
    bool killed_for_budget = false;
    bool killed_hanging = false;
    bool was_replaced = false;  // killed, because its file was replaced while it was started
    bool warned = false;        // already warned that it does not expect its signal
    rt::MonoTime launched{};
    bool stopping = false;  // by command
    bool held = false;      // not restarted
    bool aside = false;     // in no schedule yet
    rt::MonoTime asked{};
  };
  Child* find(std::uint32_t module) noexcept;
  [[nodiscard]] const Child* find(std::uint32_t module) const noexcept;
  void ask_to_end(Child& child);
  void kill_if_late(Child& child, rt::MonoTime now);
  [[nodiscard]] bool managed(const Child& child) const noexcept;
  void enter(Child& child);
  // Returns true if a launched process is ready to be released.
  bool enrolled(Child& child);
  bool launch(Child& child);
  bool start(std::uint32_t module, bool aside);
  // Notes which version its file is now. Returns false if it is not the one that was deployed.
  bool note_version(Child& child);
  void note_digest(Child& child, const std::string& digest);
  static std::string describe_start_failure(const Child& child, int status);
  void died(Child& child, int status, rt::MonoTime schedule);
  void fault(Child& child, scheduler::FaultKind kind, const std::string& text);
  void plan_restart(Child& child, rt::MonoTime schedule);
  void enforce_budget(Child& child, rt::MonoTime schedule, std::int64_t stalled_ns);
  scheduler::ModuleRecord& record(const Child& child) noexcept { return run_.modules()[child.index]; }
  scheduler::ProcessSlot& slot(const Child& child) noexcept { return run_.process_slots()[child.index]; }

  scheduler::RunBlock& run_;
  std::string node_;
  bool realtime_;
  Console& console_;
  FailSafe& failsafe_;
  tape::Tape* tape_;
  std::vector<Child> children_;
  std::string reason_;
};

}  // namespace indurop::node
