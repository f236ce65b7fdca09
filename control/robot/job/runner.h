// SPDX-License-Identifier: Apache-2.0
// Runs a job, as many of its steps per period as can be done at once. Motions are read ahead so that they can be
// blended; a step that reads or changes the outside world waits until the robot is at standstill.

#pragma once

#include <indurop/robot/controller.h>

#include <array>
#include <cstdint>

#include "control/robot/job/breakpoints.h"
#include "control/robot/job/call_stack.h"
#include "control/robot/job/interrupts.h"
#include "control/robot/job/job.h"
#include "control/robot/job/job_places.h"
#include "control/robot/job/long_statements.h"
#include "control/robot/job/motion_line.h"
#include "control/robot/job/motion_port.h"
#include "control/robot/job/open_question.h"
#include "control/robot/job/outputs.h"
#include "control/robot/job/step_motions.h"
#include "control/robot/job/step_values.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

// How far the robot is with the motions of a job.
struct JobProgress {
  int source = 0;        // of the motion that is followed, or will be next; 0: none
  bool kept = false;     // the job was stopped or pauses, and can be resumed
  bool returns = false;  // the robot returns to the path to resume it
};

class JobRunner {
 public:
  // `first_question`: as in Settings.
  explicit JobRunner(const JobBook& book, FirstQuestion first_question = nullptr) noexcept
      : book_(book),
        jobs_(book),
        places_(book),
        values_(book, jobs_, places_),
        motions_(book, places_, values_),
        question_(book, first_question),
        long_{Correcting(book), Riding(book), Pushing(book, values_, places_)},
        interrupts_(book) {}
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  // Starts a job. `job` counts from 0 and exists; `line`: where to start, with the settings (speed and so on) of the
  // lines before it. Returns false if there is no step from that line on. Real-time safe, like all functions of this
  // class.
  bool start(int job, std::uint32_t line = 0) noexcept;
  // Continues after stop(), fail() or a pause.
  void resume() noexcept;
  // Returns whether a motion belongs to the running job itself, not to a job that it called or that called it.
  [[nodiscard]] bool is_in(int source) const noexcept;
  // Steps back to such a motion: its line is the next one to run.
  void go_back(int source) noexcept;
  void set_message(const char* text) noexcept;
  // Sets where to pause: before every line, or before these lines.
  void set_pauses(bool each, const Breakpoints& lines) noexcept { pauses_.set(each, lines); }
  [[nodiscard]] int tool() const noexcept { return settings_.tool; }
  // The load that is held where the job starts.
  [[nodiscard]] int load() const noexcept { return load_; }
  // Ends the job where it is. `why` is kept as message and must outlive this object; null: ended by request.
  void stop() noexcept;
  static constexpr int kReported = -1;  // a source: the line that was reported last
  // Ends it with a message that names file and line of the motion `source`, or of the present step if `source` is 0.
  // `column`: in that line; 0: none in particular.
  void fail(Fault fault, const char* why, int source, unsigned column = 0) noexcept;
  // Continues after RECOVER if the job is in a TRY. Returns false if it is not; then it has to fail. `ticket`: motion
  // that is not possible; outputs that are to be set during it or a later motion are discarded.
  bool recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept;
  void step(double seconds, Signals& signals, MotionPort& port) noexcept;
  // The question that waits for an answer; null: none. While the job is stopped, paused or interrupted, its question
  // cannot be answered; then it is asked again.
  [[nodiscard]] OpenQuestion* open_question() noexcept;
  // Called once per period, before step(), whether a job runs or not: outputs that are timed or follow the motion.
  // Returns false if the job has failed because one of them has no value.
  [[nodiscard]] bool step_outputs(double seconds, Signals& signals, const MotionPort& port) noexcept;
  // Timed outputs, which end whether a job runs or not.
  [[nodiscard]] const Pulses& pulses() const noexcept { return outputs_.pulses; }

  // Clears all state about jobs, because the book was replaced.
  void forget() noexcept;

  [[nodiscard]] bool running() const noexcept { return state_ == JobState::Runs || state_ == JobState::Waits; }
  // Returns the report. Called once per period, after step(), since the job runs ahead of its motions.
  JobReport report(const JobProgress& now = {}) noexcept;
  [[nodiscard]] JobState state() const noexcept { return state_; }
  // Why it failed last.
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }

 private:
  enum class Next { Go, Wait };

  Next run(const Step& step, double seconds, Signals& signals, MotionPort& port) noexcept;
  // Commands a motion. Returns false if it has to wait, or is not possible.
  bool command_motion(const Step& step, Signals& signals, MotionPort& port) noexcept;
  // Follows a motion with UNTIL until it is at rest.
  Next search(const Step& step, Signals& signals, MotionPort& port) noexcept;
  // Waits, and the job has failed or continues after RECOVER, if there is a flaw.
  Next done(const StepValues::Flaw& flaw) noexcept;
  bool compute(int formula, Signals& signals, const MotionPort& port, double& value) noexcept;
  // Waits for a time, a condition or an answer.
  Next wait(const Step& step, double seconds, Signals& signals, const MotionPort& port) noexcept;
  Next output(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  // What changes how motions are made, and a push.
  Next select(const Step& step, double seconds, Signals& signals, MotionPort& port) noexcept;
  Next branch(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  Next call(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  Next leave(Signals& signals, MotionPort& port) noexcept;

  // Interrupts and errors (runner_interrupts.cpp).
  bool serve_interrupts(Signals& signals, MotionPort& port) noexcept;
  void begin_interrupt() noexcept;
  Next leave_interrupt(MotionPort& port) noexcept;
  void end_interrupt() noexcept;
  Next raise(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  // Continues after RECOVER, where ERROR is `number`. Returns false if the job is in no TRY.
  bool continue_after(double number, std::uint32_t ticket) noexcept;
  // `column`: of the present line; 0: none in particular.
  void describe(const char* why, int source, unsigned column = 0) noexcept;
  // Ends the job, or continues after RECOVER, where ERROR is `number`; 0: that of the fault.
  void refuse(Fault fault, const char* why, unsigned column = 0, double number = 0) noexcept;

  const JobBook& book_;
  JobState state_ = JobState::Idle;
  int job_ = -1;  // that was started
  CallStack jobs_;
  JobPlaces places_;
  StepValues values_;
  StepMotions motions_;
  // The motion with UNTIL that is under way.
  struct Search {
    std::uint32_t ticket = 0;  // 0: there is none
    bool met = false;          // its condition; the robot comes to rest
  };
  Search search_;
  double waited_ = 0;  // s in the present step
  OpenQuestion question_;
  LongStatements long_;
  MotionSettings settings_;
  int load_ = 0;
  JobOutputs outputs_;
  Interrupts interrupts_;
  // The state to continue with after an interrupt.
  struct Interrupted {
    JobState state = JobState::Runs;
    int depth = -1;
    double waited = 0;
    OpenQuestion::Asked asked;
    MotionSettings settings;
    PathOutputs outputs;
    Search search;
    JobPlaces::Finding found;
    bool in_job = false;
    MotionLine line;
    MotionLine shown;
  };
  std::array<Interrupted, kMaxPriorities> interrupted_;  // in the order in which they were interrupted
  std::uint32_t ticket_ = 0;                             // last motion that was commanded
  LineBreakpoints pauses_;
  bool in_job_ = false;  // started with a line other than the first, and has not moved yet
  MotionLine line_;      // of the present step, which may be read ahead
  MotionLine stopped_;   // where it was when it stopped or failed
  MotionLine shown_;     // reported last: the line that is executed, or at which the job continues
  std::uint32_t cycles_ = 0;
  Fault fault_;
  char message_[160] = "";
};

}  // namespace indurop::robot
