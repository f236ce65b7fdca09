// SPDX-License-Identifier: Apache-2.0
// Runs a job, as many of its steps per period as can be done at once. Motions are read ahead so that they can be
// blended; a step that reads or changes the outside world waits until the robot is at standstill.

#pragma once

#include <indurop/robot/controller.h>

#include <array>
#include <span>

#include "control/robot/job/job.h"
#include "control/robot/job/pulses.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

// The services of the group that a job uses.
class MotionPort {
 public:
  virtual ~MotionPort() = default;
  // Returns whether another motion can be accepted now.
  [[nodiscard]] virtual bool ready() const noexcept = 0;
  // Returns whether all commanded motions have ended.
  [[nodiscard]] virtual bool settled() const noexcept = 0;
  virtual Fault move(const MoveCommand& command) noexcept = 0;
  // Selects a tool when all motions have ended. Returns false if it is not done yet.
  virtual bool take_tool(int) noexcept { return true; }
  // Selects a load when all motions have ended. Returns false if it is not done yet.
  virtual bool take_load(int) noexcept { return true; }
  [[nodiscard]] virtual PathPlace place() const noexcept { return {}; }
  // Begins an interrupt: comes to rest on the path and saves the rest of it. Returns false if it is not done yet.
  virtual bool step_aside() noexcept { return true; }
  // Joint values where the path was left; null if no interrupt is being served.
  [[nodiscard]] virtual const Joints* left_at() const noexcept { return nullptr; }
  // The tip of the selected tool at these joint values.
  [[nodiscard]] virtual Pose tip_at(const Joints&) const noexcept { return {}; }
  // Returns to where the path was left; all motions must have ended. Returns false if it is not done yet. Errors: Away.
  virtual bool come_back(Fault&) noexcept { return true; }
  // Returns whether it is back on the path.
  [[nodiscard]] virtual bool is_back() const noexcept { return true; }
};

class JobRunner {
 public:
  explicit JobRunner(const JobBook& book) noexcept : book_(book) {}

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
  void say(const char* text) noexcept;
  // Sets where to pause: before every line, or before these lines.
  void watch(bool each, const Breakpoints& lines) noexcept {
    single_ = each;
    breakpoints_ = lines;
  }
  [[nodiscard]] int tool() const noexcept { return tool_; }
  // The load that is held where the job starts.
  [[nodiscard]] int load() const noexcept { return load_; }
  // Ends the job where it is. `why` is kept as message and must outlive this object; null: ended by request.
  void stop() noexcept;
  // Ends it with a message that names file and line of the motion `source`, or of the present step if `source` is 0.
  void fail(Fault fault, const char* why, int source) noexcept;
  // Continues after RECOVER if the job is in a TRY. Returns false if it is not; then it has to fail. `ticket`: motion
  // that is not possible; outputs that are to be set during it or a later motion are discarded.
  bool recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept;
  void step(double seconds, Signals& signals, MotionPort& port) noexcept;
  // Called once per period, whether a job runs or not.
  void end_pulses(double seconds, Signals& signals) noexcept { pulses_.step(seconds, signals); }

  // Returns whether timed outputs are on.
  [[nodiscard]] bool pulses() const noexcept { return pulses_.any(); }
  // Clears all state about jobs, because the book was replaced.
  void forget() noexcept;

  [[nodiscard]] bool running() const noexcept { return state_ == JobState::Runs || state_ == JobState::Waits; }
  // Returns the report, with the line of the motion `source` while the job runs ahead of it.
  [[nodiscard]] JobReport report(int source) const noexcept;
  [[nodiscard]] JobState state() const noexcept { return state_; }
  // Why it failed last.
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }

 private:
  enum class Next { Go, Wait };
  static constexpr int kLineBits = 20;  // MoveCommand::source = job and line
  static std::uint32_t line_of(int source) noexcept {
    return static_cast<std::uint32_t>(source) & ((1U << kLineBits) - 1);
  }
  static constexpr int kDeepest = 8;
  struct Frame {
    int job = 0;
    int step = 0;
    int loops = 0;
    std::array<double, kDeepest> left{};  // times the open loops still run
    std::array<double, kMostVariables> variables{};
  };

  [[nodiscard]] const Step* present() const noexcept;
  Next run(const Step& step, double seconds, Signals& signals, MotionPort& port) noexcept;
  Next move(const Step& step, Signals& signals, MotionPort& port) noexcept;
  // Adds the offset of a motion. Returns false if the offset has no value.
  bool shift(const Step& step, Signals& signals, Target& target) noexcept;
  // Returns false if the formula has no value; the job has then failed.
  bool compute(int formula, Signals& signals, double& value) noexcept;
  Next wait_until(const Step& step, double seconds, Signals& signals) noexcept;
  Next set_on_path(const Step& step, Signals& signals) noexcept;
  // Interrupts (interrupts.cpp).
  void describe(const char* why, int source) noexcept;
  void refuse(Fault fault, const char* why) noexcept;
  Next arm(const Step& step, Signals& signals) noexcept;
  [[nodiscard]] bool holds(int interrupt, Signals& signals) const noexcept;
  bool interrupt(Signals& signals, MotionPort& port) noexcept;
  void begin_interrupt() noexcept;
  Next leave_interrupt(MotionPort& port) noexcept;
  void end_interrupt() noexcept;
  void fire(double seconds, Signals& signals, const MotionPort& port) noexcept;
  void modal(const Step& step) noexcept;
  Next hold(const Step& step, MotionPort& port) noexcept;
  Next assign(const Step& step, Signals& signals) noexcept;
  Next pulse(const Step& step, Signals& signals) noexcept {
    return pulses_.start(static_cast<std::size_t>(step.index), step.pulse, signals) ? Next::Go : Next::Wait;
  }
  Next branch(const Step& step, Signals& signals) noexcept;
  Next wait_time(const Step& step, double seconds) noexcept;
  Next call(const Step& step, Signals& signals) noexcept;
  [[nodiscard]] std::span<const Formula> formulas_of(const Step& step) const noexcept;
  [[nodiscard]] int cost_of(const Step& step) const noexcept;
  [[nodiscard]] bool touches_world(const Step& step) const noexcept;
  void jump(int step) noexcept;
  [[nodiscard]] bool pauses_before(const Step& step) const noexcept;
  void loop(const Step& step) noexcept;
  void end_loop(const Step& step) noexcept;
  Next leave(MotionPort& port) noexcept;

  [[nodiscard]] Frame& frame() noexcept { return frames_[static_cast<std::size_t>(depth_)]; }
  [[nodiscard]] const Frame& frame() const noexcept { return frames_[static_cast<std::size_t>(depth_)]; }
  [[nodiscard]] const Job& job_of(int index) const noexcept { return book_.jobs[static_cast<std::size_t>(index)]; }

  const JobBook& book_;
  JobState state_ = JobState::Idle;
  std::array<Frame, kDeepest> frames_{};
  int depth_ = 0;
  int job_ = -1;
  double waited_ = 0;  // s in the present step
  // Settings that apply until a line changes them.
  struct Modal {
    double speed = 1, tool_speed = 0, zone = 0, acceleration = 1;
  };
  Modal modal_;
  int tool_ = 0;
  int load_ = 0;
  // An output that is to be set during a motion.
  struct Trigger {
    bool waits = false;
    int signal = 0;
    double value = 0;
    std::uint32_t ticket = 0;
    bool by_time = false, after = false;
    double amount = 0;  // m or s
    double pulse = 0;   // s; 0: it is set permanently
  };
  using Triggers = std::array<Trigger, 16>;
  Triggers triggers_{};
  Pulses pulses_;
  // Monitored conditions, in the order of the book.
  struct Watched {
    bool on = false;
    bool was = false;      // value of its condition in the last period
    bool pending = false;  // it has become true
  };
  std::array<Watched, kMostInterrupts> watched_{};
  enum class Serving { None, Leaving, Runs, Returning };
  Serving serving_ = Serving::None;
  int served_ = -1;
  // The state to continue with after the interrupt.
  struct Interrupted {
    JobState state = JobState::Runs;
    int depth = -1;
    double waited = 0;
    Modal modal;
    int tool = 0;
    Triggers triggers{};
    std::uint32_t present = 0;
    double since = 0;
    bool in_job = false;
  };
  Interrupted interrupted_;
  std::uint32_t ticket_ = 0;   // last motion that was commanded
  std::uint32_t present_ = 0;  // motion that was followed last
  double since_ = 0;           // s for which this motion has been followed
  bool single_ = false;
  Breakpoints breakpoints_{};
  bool free_ = false;    // the present line does not pause again
  bool in_job_ = false;  // started with a line other than the first, and has not moved yet
  int last_step_ = -1;   // step of last_job_ that ran last
  int last_job_ = -1;
  std::uint32_t line_ = 0;
  int line_job_ = -1;  // job whose file contains that line
  std::uint32_t cycles_ = 0;
  Fault fault_;
  char message_[160] = "";
};

}  // namespace indurop::robot
