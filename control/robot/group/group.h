// SPDX-License-Identifier: Apache-2.0
// The group of axes as one robot: the order of work in a period (read drives and requests, move, command the drives,
// report), and what its classes ask of each other. Each class owns its part of the state; the picture of the states is
// in docs/robot.md.

#pragma once

#include "control/robot/group/answer_desk.h"
#include "control/robot/group/breakdown.h"
#include "control/robot/group/by_hand.h"
#include "control/robot/group/command_desk.h"
#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/interrupt_shelf.h"
#include "control/robot/group/job_motions.h"
#include "control/robot/group/kept_image.h"
#include "control/robot/group/last_gate.h"
#include "control/robot/group/mode_guard.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/motion_report.h"
#include "control/robot/group/overrides.h"
#include "control/robot/group/path_correction.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/power.h"
#include "control/robot/group/reloading.h"
#include "control/robot/group/resuming.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/service_desk.h"
#include "control/robot/group/services.h"
#include "control/robot/group/shared_space.h"
#include "control/robot/group/stops.h"
#include "control/robot/group/torque_watch.h"
#include "control/robot/group/ways_ahead.h"
#include "control/robot/kinematics/zeroed.h"

namespace indurop::robot {

// KeptImage compares what has no initial value, too, so that lies in zeroed memory.
class Group final : public Controller, public InZeroedMemory, private GroupPort {
 public:
  explicit Group(GroupParts parts);

  void step(const Inputs& in, Signals& signals, Outputs& out) noexcept override;
  [[nodiscard]] std::size_t save(void* to, std::size_t most) const noexcept override;
  [[nodiscard]] bool restore(const void* from, std::size_t bytes) noexcept override;
  [[nodiscard]] const std::vector<std::string>& signals() const noexcept override { return robot_.parts.book.signals; }
  [[nodiscard]] std::size_t axis_count() const noexcept override {
    return static_cast<std::size_t>(robot_.count()) + static_cast<std::size_t>(robot_.singles.count());
  }
  [[nodiscard]] const std::string& kind() const noexcept override { return robot_.parts.kind; }

 private:
  void begin_keeping();

  // What may end a motion from outside.
  void sense(const Inputs& in) noexcept;
  void watch(const Inputs& in) noexcept;
  [[nodiscard]] bool stopped_for_emergency() const noexcept;

  // One period of the present state (motion.cpp).
  void run_state(Signals& signals) noexcept;
  void reset_further() noexcept;
  void run_homing() noexcept;
  void run_motion(Signals& signals) noexcept;
  bool run_job(Signals& signals) noexcept;
  void begin_next(bool more) noexcept;
  void take_plan() noexcept;
  void note_lines(const Plan& plan) noexcept;
  void follow_path() noexcept;
  void motion_failed(const Fault& fault, int source, std::uint32_t ticket) noexcept;
  void end_motions() noexcept;

  void report(Outputs& out) noexcept;
  // Returns false if the set points only follow the positions that the drives report.
  [[nodiscard]] bool commands_motion() const noexcept;

  // GroupPort.
  void trip(ErrorCode code, int axis, double hardness, const char* why) noexcept override;
  void fall_off(ErrorCode code, int axis) noexcept override { stops_.fall_off(code, axis); }
  void stop_for(const Fault& fault) noexcept override { stops_.stop_for(fault); }
  void break_down(const char* what, const char* how) noexcept override { breakdown_.begin(what, how); }
  void finish_service(const Fault& result) noexcept override { service_.finish(result); }
  [[nodiscard]] bool is_serving() const noexcept override { return service_.active(); }
  [[nodiscard]] ErrorCode may_move() const noexcept override { return services_.may_move(); }
  [[nodiscard]] bool settled() const noexcept override { return job_motions_.settled(); }
  [[nodiscard]] double tip_limit() const noexcept override { return mode_.tip_limit(by_hand_.jogging.on()); }
  bool change_tool(int tool) noexcept override { return job_motions_.take_tool(tool); }
  void forget_plans() noexcept override;
  void drop_motions(ErrorCode first) noexcept override { queue_.drop(first); }
  void set_job_aside() noexcept override;
  void drop_aside() noexcept override;
  void end_motion() noexcept override;
  void come_to_standby() noexcept override;
  using GroupPort::finish_service;
  using GroupPort::trip;

  Robot robot_;
  PathCorrection correction_;
  SharedSpace space_;
  WaysAhead ways_;
  Plans plans_;
  ModeGuard mode_;
  TorqueWatch torques_;
  Resuming resuming_;
  InterruptShelf shelf_;
  ConveyorTracking conveyor_;
  MotionQueue queue_;
  ByHand by_hand_;
  LastGate gate_;
  Power power_;
  Stops stops_;
  JobMotions job_motions_;
  Services services_;
  ServiceDesk service_;
  AnswerDesk answers_;
  Overrides overrides_;
  CommandDesk commands_;
  Reloading reloading_;
  Breakdown breakdown_;
  MotionReport motion_report_;
  KeptImage kept_;  // of all members before it
};

}  // namespace indurop::robot
