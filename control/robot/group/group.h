// SPDX-License-Identifier: Apache-2.0
// The group of axes: the state machine behind the services, and the order of work in a period: read drives and
// requests, move, command the drives, report.

#pragma once

#include <array>
#include <memory>
#include <span>

#include "control/robot/axis/command_table.h"
#include "control/robot/axis/control.h"
#include "control/robot/axis/set_point_gate.h"
#include "control/robot/axis/torque_feed.h"
#include "control/robot/files/program_loader.h"
#include "control/robot/group/contact_watch.h"
#include "control/robot/group/dead_man.h"
#include "control/robot/group/tracking.h"
#include "control/robot/job/runner.h"
#include "control/robot/kinematics/tool_set.h"
#include "control/robot/path/follower.h"
#include "control/robot/path/joint_brake.h"
#include "control/robot/plan/planning_desk.h"
#include "control/robot/plan/read_ahead.h"

namespace indurop::robot {

// Everything that was read when the task was loaded.
struct GroupParts {
  Settings settings;
  Arm arm;
  JointLimits joints;
  ToolLimits tool;
  JobBook book;
  std::string kind;
  Dynamics dynamics{};
  Clearance clearance;
  std::string urdf{};  // the text of its file
};

class Group final : public Controller, private MotionPort {
 public:
  explicit Group(GroupParts parts);

  void step(const Inputs& in, Signals& signals, Outputs& out) noexcept override;
  [[nodiscard]] const std::vector<std::string>& signals() const noexcept override { return parts_.book.signals; }
  [[nodiscard]] std::size_t axis_count() const noexcept override { return static_cast<std::size_t>(count()); }
  [[nodiscard]] const std::string& kind() const noexcept override { return parts_.kind; }

 private:
  // Services (services.cpp).
  void serve(const ServiceRequest& request, bool edit) noexcept;
  [[nodiscard]] bool comes_to_rest() const noexcept;
  void begin_service(Service service, const ServiceRequest& request) noexcept;
  ErrorCode begin(Service service, const ServiceRequest& request) noexcept;
  ErrorCode enable() noexcept;
  ErrorCode disable() noexcept;
  ErrorCode home() noexcept;
  ErrorCode move(Service service, const ServiceRequest& request) noexcept;
  [[nodiscard]] ErrorCode may_move() const noexcept;
  ErrorCode redirect(const ServiceRequest& request) noexcept;
  ErrorCode start_job(std::uint32_t number, std::uint32_t line) noexcept;
  ErrorCode stop_motion() noexcept;
  ErrorCode select_tool(std::uint32_t tool) noexcept;

  // Moving by hand (jog.cpp).
  void serve_jog(const JogRequest& jog) noexcept;
  void begin_jog() noexcept;
  [[nodiscard]] const WorkFrame* work_frame(std::string_view name) const noexcept;
  [[nodiscard]] MoveCommand jog_axis(int axis, double part) const noexcept;
  [[nodiscard]] MoveCommand jog_tip(int direction, double part) const noexcept;
  void jog_shorter() noexcept;

  // Operating modes (mode.cpp).
  void serve_mode(const ModeRequest& asked) noexcept;
  [[nodiscard]] bool stands() const noexcept;
  void rest_for(ErrorCode code) noexcept;
  [[nodiscard]] bool reduced() const noexcept { return jogging_ || mode_ == OperatingMode::Manual; }
  [[nodiscard]] double tip_limit() const noexcept;
  [[nodiscard]] double axes_pace() const noexcept;
  [[nodiscard]] bool tip_too_fast() const noexcept;
  [[nodiscard]] ErrorCode axis_permit() const noexcept;

  // Interrupted jobs that can be continued (resume.cpp).
  void set_job_aside() noexcept;
  void pause_job() noexcept;
  void drop_aside() noexcept;
  ErrorCode resume_job() noexcept;
  ErrorCode back_job() noexcept;
  void end_return() noexcept;
  [[nodiscard]] double speed_back(const Joints& to) const noexcept;
  void finish_service(ErrorCode code, int axis = 0) noexcept;
  [[nodiscard]] bool is_near(const Joints& place) const noexcept;
  void ask_for_way_back(const Joints& to) noexcept;

  // Reloading jobs from their files (reload.cpp).
  [[nodiscard]] bool may_reload() const noexcept;
  void run_reload(Signals& signals) noexcept;
  ErrorCode take_program(Program& program, Signals& signals) noexcept;

  // Interrupts of jobs (interrupt.cpp).
  bool step_aside() noexcept override;
  [[nodiscard]] const Joints* left_at() const noexcept override;
  [[nodiscard]] Pose tip_at(const Joints& q) const noexcept override { return places_.arm().forward(q); }
  bool come_back(Fault& fault) noexcept override;
  [[nodiscard]] bool is_back() const noexcept override { return return_ == Return::None; }
  void take_from_shelf() noexcept;
  void end_come_back() noexcept;
  bool set_shelf_aside() noexcept;

  // Commands (commands.cpp).
  void serve_commands(const Inputs& in) noexcept;
  void take(int ticket, const CamTables& cams) noexcept;
  ErrorCode select_cam(const Command& command, const CamTables& cams) noexcept;
  void administer(int ticket, Service service) noexcept;
  void stop_for(int ticket) noexcept;
  void release_stop() noexcept;
  void interrupt(int ticket) noexcept;
  void go_on(int ticket) noexcept;
  void end_interrupt(ErrorCode code) noexcept;
  ErrorCode set_transform(const Command& command) noexcept;

  // Moving products, conveyor tracking (riding.cpp).
  ErrorCode track(const Command& command, bool turns) noexcept;
  void sense_belts(const Inputs& in) noexcept;
  [[nodiscard]] const BeltWatch& belt_watch() const noexcept {
    return belts_[static_cast<std::size_t>(tracking_.carrier().belt)];
  }
  // Limits of a carrier's motion; `tip`: m that the tip or the arm's end moves per m or rad of the carrier.
  struct RideRoom {
    LineLimits limits;
    double tip = 0;
  };
  void lose_product(const char* why) noexcept;
  void get_off() noexcept;
  bool room_to_ride(const Tracking::Carrier& carrier, RideRoom& room) const noexcept;
  [[nodiscard]] LineLimits most_of(const Tracking::Carrier& carrier) const noexcept;
  ErrorCode get_on() noexcept;
  void leave_belt(bool stays) noexcept;
  [[nodiscard]] bool is_on_product(int ticket) noexcept;
  void keep_to_product() noexcept;
  [[nodiscard]] Fault ride(Joints& q) noexcept;
  [[nodiscard]] Fault too_heavy(const Joints& q) const noexcept;
  void steer_ride() noexcept;
  [[nodiscard]] Pose product_ahead() const noexcept;
  void report_product() noexcept;
  void drop_ride(ErrorCode code) noexcept;

  // Motions by commands (motions.cpp).
  static Pose pose_of(const std::array<double, 8>& numbers) noexcept;
  [[nodiscard]] Pose pose_of(const std::array<double, 8>& numbers, const Command& command,
                             const Pose& from) const noexcept;
  [[nodiscard]] Joints joints_of_axes(const std::array<double, 8>& numbers) const noexcept;
  ErrorCode make_target(const Command& command, const std::array<double, 8>& numbers, Target& target) const noexcept;
  ErrorCode make_circle(const Command& command, MoveCommand& move) const noexcept;
  ErrorCode make_motion(int ticket, MoveCommand& move) const noexcept;
  void queue_motion(int ticket) noexcept;
  void begin_moving() noexcept;
  void replace_motions(int ticket) noexcept;
  [[nodiscard]] double zone_of(int i) const noexcept;
  void feed_motions() noexcept;
  void halt(int ticket) noexcept;
  void note_progress() noexcept;
  void end_first(int many, ErrorCode code) noexcept;
  void fail_motions(int ticket, ErrorCode code) noexcept;
  void drop_motions(ErrorCode first) noexcept;

  // States (group.cpp).
  void sense(const Inputs& in) noexcept;
  void set_pace(const Inputs& in) noexcept;  // commands.cpp
  void watch(const Inputs& in) noexcept;
  [[nodiscard]] bool stopped_for_emergency() const noexcept;
  [[nodiscard]] int axis_behind() const noexcept;
  [[nodiscard]] bool is_behind(const AxisControl& a) const noexcept;  // axes.cpp
  void fail_axes_behind() noexcept;
  // Stops and reset (stops.cpp).
  void trip(ErrorCode code, int axis, double hardness) noexcept;
  void fall_off(ErrorCode code, int axis) noexcept;
  void leave_path(ErrorCode code) noexcept;
  void begin_braking(bool in_step) noexcept;
  void brake_axes() noexcept;
  void run_stopping() noexcept;
  void stop_for(Fault fault) noexcept;
  bool clear_faults() noexcept;
  ErrorCode reset() noexcept;
  void go_on_resetting() noexcept;
  void pass_gates() noexcept;  // gates.cpp
  [[nodiscard]] bool leaves_workspace() const noexcept;
  [[nodiscard]] bool rests_inside(const Vec3& start) const noexcept;
  void look_ahead() noexcept;  // clear.cpp
  [[nodiscard]] Fault stays_clear() noexcept;
  void move_axes() noexcept;  // axes.cpp
  void run_state(Signals& signals) noexcept;
  [[nodiscard]] bool lets_go() const noexcept;
  void take_power() noexcept;
  void run_enabling() noexcept;
  void run_homing() noexcept;
  void run_motion(Signals& signals) noexcept;
  void begin_next(bool more) noexcept;                          // plans.cpp
  void take_plan() noexcept;                                    // plans.cpp
  void break_down(const char* what, const char* how) noexcept;  // plans.cpp
  void report_break_down(Outputs& out) noexcept;                // plans.cpp
  void forget_plans() noexcept;
  void follow_path() noexcept;
  static constexpr int kWhy = 120;
  void describe(Fault fault, char (&to)[kWhy]) const noexcept;
  void motion_failed(Fault fault, int source, std::uint32_t ticket) noexcept;
  void come_to_standby() noexcept;
  // Why it stopped remains known until a reset.
  [[nodiscard]] bool failed() const noexcept { return state_ == GroupState::ErrorStop || to_error_; }
  [[nodiscard]] bool all_enabled() const noexcept;
  [[nodiscard]] bool powered() const noexcept;
  // Returns false if the set points only follow the positions that the drives report.
  [[nodiscard]] bool commands_motion() const noexcept;
  [[nodiscard]] Joints commanded() const noexcept;

  // Functions that the job uses (MotionPort).
  [[nodiscard]] bool ready() const noexcept override { return ahead_.has_room(); }
  [[nodiscard]] bool settled() const noexcept override {
    return (aside_ || ahead_.empty()) && desk_.free() && follower_.idle();
  }
  Fault move(const MoveCommand& command) noexcept override;
  bool take_tool(int tool) noexcept override;
  bool take_load(int load) noexcept override;  // torques.cpp
  void weigh() noexcept;
  void set_up_torques() noexcept;
  [[nodiscard]] double most_torque(int axis) const noexcept;
  void watch_contact(const Inputs& in) noexcept;
  void feed_torques(Outputs& out) noexcept;
  [[nodiscard]] Joints needed_torques() const noexcept;
  void weigh_pushing() noexcept;
  [[nodiscard]] PathPlace place() const noexcept override { return follower_.path_place(); }

  [[nodiscard]] bool can_plan() const noexcept { return desk_.free() && follower_.has_room(); }
  [[nodiscard]] Joints planned_end() const noexcept {
    return follower_.idle() && !tracking_.on() ? commanded() : follower_.end();
  }
  void ask_for_plan(const PlanRequest& request) noexcept;  // plans.cpp

  [[nodiscard]] int count() const noexcept { return parts_.arm.count(); }
  [[nodiscard]] std::span<AxisControl> axes() noexcept { return {axes_.data(), axis_count()}; }
  [[nodiscard]] std::span<const AxisControl> axes() const noexcept { return {axes_.data(), axis_count()}; }

  void report(Outputs& out) noexcept;  // report.cpp
  void report_motion(Outputs& out) noexcept;
  void report_tool(const Twist& moved, Outputs& out) noexcept;

  GroupParts parts_;
  ToolSet tools_;
  CommandTable table_;
  Dynamics dynamics_;               // including tool and load
  Joints rated_ = Joints::Zero();   // torque of the drives; 0: unknown
  Joints torque_ = Joints::Zero();  // measured
  TorqueFeed feed_;
  ContactWatch contact_;
  char contact_text_[kWhy] = "";
  Places places_;
  int tool_ = 0;
  Body load_;  // of a job, in addition to the tool
  Follower follower_;
  JobRunner job_;
  ReadAhead ahead_;
  PlanningDesk desk_;
  ProgramLoader loader_;
  bool reloading_ = false;
  std::array<AxisControl, kAxes> axes_;
  std::array<SetPointGate, kAxes> gates_;
  std::array<Cam, kCams> cams_;
  ProfileTables profiles_{};
  double period_ = 0.01;  // s

  GroupState state_ = GroupState::Disabled;
  ErrorCode error_ = ErrorCode::Ok;
  int error_axis_ = 0;
  bool to_error_ = false;     // Stopping ends in ErrorStop
  bool to_disabled_ = false;  // Stopping ends in Disabled
  bool on_path_ = true;       // the stop follows the path; else it leaves it
  bool braking_ = false;      // the gates bring the axes to rest
  bool in_step_ = false;      // all axes together, by `brake_`
  JointBrake brake_;
  double hardness_ = 1;  // of the stop in progress
  bool enabling_ = false;
  bool letting_go_ = false;  // drives still on from before must switch off first
  bool quick_stop_ = false;
  bool job_moves_ = false;

  OperatingMode mode_ = OperatingMode::Any;
  DeadMan enabling_switch_;
  ErrorCode permit_ = ErrorCode::Ok;  // Ok, or why no motion is permitted

  // Collision checks for axes that move as single axes: up to the last set point, and for a way to rest.
  ClearWay clear_, to_rest_;
  bool looks_ahead_ = false;

  DeadMan dead_man_;
  bool jogging_ = false;
  bool jog_blocked_ = false;  // jogging cannot continue in that direction until another one is requested
  double jog_part_ = 1;       // part of the longest distance
  JogFrame jog_frame_ = JogFrame::Joint;
  Quat jog_axes_ = Quat::Identity();  // of a work frame
  int jog_index_ = -1;
  double jog_speed_ = 0;  // part of the maximum speed, with its sign

  // A job that can be continued: the follower has its path; what was to be planned is in this class and in `ahead_`.
  enum class Return { None, ToPath, Back, FromInterrupt };
  bool aside_ = false;
  int aside_tool_ = 0;
  Return return_ = Return::None;
  PlanRequest request_;  // the last one
  bool request_aside_ = false;
  bool unconnected_ = false;  // the desk regards another motion as the last one
  // What a job was doing when an interrupt began; meanwhile the follower, the desk and `ahead_` belong to the
  // interrupt.
  struct Shelf {
    Shelf(const Places& places, const ToolLimits& limits) : ahead(places, limits) {}
    bool leaving = false;  // on the way to rest
    bool used = false;
    Follower::Aside path;
    ReadAhead ahead;
    PlanRequest request;
    bool request_aside = false;
    int tool = 0;
  };
  std::unique_ptr<Shelf> shelf_;
  struct Passed {
    MoveCommand command;
    Joints from = Joints::Zero();
  };
  std::array<Passed, 32> passed_;  // motions of the job, for stepping back
  std::size_t passed_count_ = 0;
  std::size_t passed_known_ = 0;  // the last ones of them, which were not overwritten
  double waited_ = 0;

  // The tickets of the commands that wait for the service (kNone: the request), for the stop, and for the interruption.
  int ticket_ = CommandTable::kNone;
  int stop_ = CommandTable::kNone;
  int interrupt_ = CommandTable::kNone;
  int later_ = CommandTable::kNone;  // waits for the planning thread
  bool interrupted_ = false;
  std::array<int, CommandTable::kMost> motions_{};
  int motion_count_ = 0;
  int fed_ = 0;                            // number of motions given to the planner
  int asked_ = 0;                          // MoveCommand::source of what is being planned
  Pose ahead_of_;                          // where the next motion begins
  Pose product_;                           // the product's coordinates
  std::array<double, 6> product_given_{};  // as it was set

  // The product may move: plans refer to the carrier's position when the tool last was at rest on the product.
  std::array<BeltWatch, kBelts> belts_;
  Tracking tracking_;
  bool product_lost_ = false;  // it should move, and its position is unknown
  bool ride_held_ = false;     // all motions are held
  bool paused_ = false;        // all motions are held, also those without tracking
  bool pace_wrong_ = false;    // an override or factor is not a number
  double ride_pace_ = 1;       // part of full speed that the tracking leaves
  double ride_speed_ = 0;      // m/s of the tip or of the arm's end, due to the tracking

  // The request that is being served.
  bool first_ = true;
  bool active_ = false;
  bool by_edit_ = false;
  bool edit_done_ = false;
  bool motion_done_ = false;
  Service service_ = Service::None;
  std::uint32_t acknowledged_ = 0;
  std::uint32_t done_ = 0;
  Pose last_pose_;
  Twist last_moved_ = Twist::Zero();
  // A thread has crashed: why the task ends, and how long it has been at rest since then.
  char broken_[2 * kWhy] = "";
  double broken_for_ = 0;  // s
  Joints last_command_ = Joints::Zero();
  Joints last_speed_ = Joints::Zero();
  bool emergency_ = false;
};

}  // namespace indurop::robot
