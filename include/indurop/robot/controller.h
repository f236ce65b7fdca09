// SPDX-License-Identifier: Apache-2.0
// The robot task as a module sees it: one object that is loaded in start() and stepped in every run(). Its inputs and
// outputs are plain numbers, which the module copies from and to its shared variables; see examples/robot_cell.

#pragma once

#include <indurop/result.h>
#include <indurop/robot/commands.h>
#include <indurop/robot/questions.h>
#include <indurop/robot/space.h>
#include <indurop/robot/tool_way.h>
#include <indurop/robot/words.h>
#include <indurop/string.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace indurop::robot {

inline constexpr std::size_t kJoints = 8;  // maximum number of axes

// One number for each axis, converted from and to arrays that are as long as the arm has axes.
struct AxisNumbers : std::array<double, kJoints> {
  AxisNumbers() noexcept : array{} {}
  AxisNumbers(std::initializer_list<double> first) noexcept : AxisNumbers() { take(first.begin(), first.size()); }
  template <std::size_t N>
  AxisNumbers(const std::array<double, N>& first) noexcept : AxisNumbers() {
    take(first.data(), N);
  }
  template <std::size_t N>
  operator std::array<double, N>() const noexcept {
    std::array<double, N> first{};
    std::copy_n(data(), std::min(N, kJoints), first.data());
    return first;
  }

 private:
  void take(const double* first, std::size_t count) noexcept { std::copy_n(first, std::min(count, kJoints), data()); }
};

// A CiA 402 drive: its actual values and its set points. Positions are in counts.
struct DriveIn {
  std::uint16_t error = 0;
  std::uint16_t status = 0;
  std::int8_t mode = 0;
  std::int32_t position = 0;
  // Touch probe: its status (60B9h) and the positions it stored.
  std::uint16_t probe = 0;
  std::int32_t probe_rise = 0;
  std::int32_t probe_fall = 0;
  std::int16_t torque = 0;  // actual torque (6077h), 1/1000 of the rated one
};
struct DriveOut {
  std::uint16_t control = 0;
  std::int8_t mode = 0;
  std::int32_t position = 0;
  std::uint16_t probe = 0;         // function of the touch probe (60B8h)
  std::int16_t torque_offset = 0;  // feed-forward torque of the motion (60B2h), 1/1000 of the rated torque
  std::int16_t torque = 0;         // target torque of mode 10 (6071h), in addition to the offset
};

// A service request with its arguments, as ROBOT_MODULE_SERVICE.
struct ServiceRequest {
  std::int32_t code = 0;     // Service
  std::uint32_t number = 0;  // differs from last time: a new request
  std::uint32_t level = 0;   // position level: 0 stops at the target, above that the path is rounded `level` cm before
  double speed = 0;          // %; 0: as fast as possible
  std::uint32_t point = 0;
  std::uint32_t mid = 0;
  std::uint32_t job = 0;
  AxisNumbers target{};    // deg, mm of sliding axes; or a pose: mm and deg
  double velocity = 0;     // DirectAbsolute: %, LinearAbsolute: mm/s; 0: `speed` applies
  std::uint32_t line = 0;  // JobStart: the line to start at; 0: the first one
  std::uint32_t tool = 0;  // SelectTool: in the order of the files, from 1; 0: none, the arm's end
};

// A request to one axis, as AXIS_SERVICE[n]. Zero in velocity, acceleration and jerk means the maximum of the axis.
struct AxisRequest {
  std::uint32_t number = 0;
  std::int32_t code = 0;    // AxisService
  double position = 0;      // deg
  double velocity = 0;      // deg/s
  double acceleration = 0;  // deg/s^2
  double jerk = 0;          // deg/s^3
};

// Shared variables that jobs set and wait for (SET O8 ON, WAIT I4), by the names the jobs use. Called only in step().
class Signals {
 public:
  Signals() = default;
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  virtual ~Signals() = default;
  // `index` is the position in Controller::signals().
  virtual double read(std::size_t index) noexcept = 0;
  virtual void write(std::size_t index, double value) noexcept = 0;
  // Reloaded jobs use other variables: prepares access to them, while read() and write() continue as before. The error
  // is one line: why it cannot, and what to do. Called by a thread of the controller, or in the tick of a simulation;
  // not real-time safe.
  virtual Result<void, std::string> prepare(const std::vector<std::string>& /*names*/) {
    return std::string("the jobs name other variables than before; restart the node");
  }
  // Switches to the prepared variables. Real-time safe.
  virtual void adopt() noexcept {}
};

// Jogging while the group is in standby: one axis, or the tip along or about one direction.
// Base: the frame of poses, which is that of the workpiece if axes turn it; World: the base that stands still. Hand:
// the arm gives way to a hand that pushes it, in manual mode only.
enum class JogFrame : std::int16_t { Joint, Base, Tool, Work, Hand, World };
struct JogRequest {
  bool enabled = false;  // the enabling device; without it the robot stops
  JogFrame frame = JogFrame::Joint;
  AxisNumbers speed{};     // %, with sign; for axes, or x y z and rotations about them. The first that is not 0 counts
  std::uint32_t beat = 0;  // 0: the switch alone counts; else only while this changes at least every 0.3 s
  // JogFrame::Work: name of a frame of the jobs, as far as it fits; an unknown name moves nothing.
  string<32> work;
};

// The requested operating mode. It changes once the robot is at standstill; the robot stops for that.
struct ModeRequest {
  OperatingMode mode = OperatingMode::Any;  // a number outside the enum is manual mode without the enabling device
  bool enabled = false;                     // the enabling device of manual mode
  std::uint32_t beat = 0;                   // of the enabling device, as JogRequest::beat
};

// A conveyor or a rotary table, as reported by the reader of its encoder.
struct BeltIn {
  double place = 0;        // mm or degrees; counts on without wrapping
  std::uint32_t beat = 0;  // changes each time that `place` is reported
};

// A line of a job's file before which the job is to pause.
struct Breakpoint {
  std::uint32_t job = 0;   // from 1; 0: none
  std::uint32_t line = 0;  // from 1
};
using Breakpoints = std::array<Breakpoint, 8>;

// Inputs of one period: drives as they were read, requests as PLC programs wrote them, all of the same instant.
struct Inputs {
  std::array<DriveIn, kJoints> drives{};
  ServiceRequest service;
  bool edit = false;  // msgRobotServiceEditNum: a request without a number
  std::array<AxisRequest, kJoints> axes{};
  Commands commands{};
  CamTables cams{};
  std::array<BeltIn, kBelts> belts{};
  ProfileTables profiles{};
  // Override factors: speed, acceleration and jerk of single axes; speed of the group.
  struct Factors {
    AxisNumbers velocity{1, 1, 1, 1, 1, 1, 1, 1};
    AxisNumbers acceleration{1, 1, 1, 1, 1, 1, 1, 1};
    AxisNumbers jerk{1, 1, 1, 1, 1, 1, 1, 1};
    double group = 1;
  } factors;
  // False until the requesting board was received: an old request is then not mistaken for a new one.
  bool requests_known = true;
  double speed_override = 100;  // %
  bool hold = false;
  bool emergency = false;
  bool single_step = false;  // jobs pause before each line
  Breakpoints breakpoints{};
  JogRequest jog;
  ModeRequest mode;
  AnswerRequest answer;
  std::uint64_t tick = 0;  // of the node: the same for all robots that are stepped in it
  // Reports of the robots in Settings::other_robots, in that order; null: none was received.
  std::array<const SpaceReport*, kOtherRobots> others{};
};

// The status of one axis, as AXIS_STATUS[n]. A request is acknowledged, and later done or aborted, by its number.
struct AxisReport {
  AxisState state = AxisState::Disabled;
  std::uint32_t acknowledged = 0;
  std::uint32_t done = 0;
  std::uint32_t aborted = 0;
  ErrorCode error = ErrorCode::Ok;
  bool power = false;
  bool homed = false;
  bool in_velocity = false;
  double position = 0;      // deg, measured
  double velocity = 0;      // deg/s, commanded
  double command = 0;       // deg
  double acceleration = 0;  // deg/s^2, commanded
  double measured_velocity = 0;
  // Limits of the axis.
  double lower = 0, upper = 0;
  double most_velocity = 0, most_acceleration = 0, most_jerk = 0;
  double probe = 0;   // deg, the last position recorded by its touch probe
  double phase = 0;   // deg or mm by which it sees the axis that it follows further on
  double torque = 0;  // N m (N), measured; 0: rated_torque is not known
  double push = 0;    // N m (N), external: the part that the arm's motion does not need; 0 without collision_limit
  // Limits for single-axis motions, from parameters that were written.
  double own_lower = 0, own_upper = 0;
  bool lower_counts = true, upper_counts = true;
  double own_velocity = 0, own_acceleration = 0, own_deceleration = 0, own_jerk = 0;
};

// The tool in the coordinates of the machine or of the product: x y z in mm, roll pitch yaw in degrees. Velocity and
// acceleration are as commanded, turning about the coordinates' axes.
struct ToolReport {
  std::array<double, 6> position{};  // measured
  std::array<double, 6> velocity{};
  std::array<double, 6> acceleration{};
};

// Where a job that an interrupt has left continues: a line, from 1, of the file of `name`.
struct InterruptedJob {
  const char* name = "";  // valid as long as the controller
  std::uint32_t line = 0;
};

inline constexpr std::size_t kReportedPending = 8;

// The job that runs or ran last. `line`, from 1, refers to the file of `called`: of that job, or of one that it called.
// It is the line that is executed, or at which the job continues.
struct JobReport {
  JobState state = JobState::Idle;
  std::uint32_t job = 0;
  std::uint32_t line = 0;
  std::uint32_t cycles = 0;
  const char* name = "";     // valid as long as the controller
  const char* message = "";  // the same
  bool can_resume = false;   // JobResume can resume it
  const char* called = "";   // valid as long as the controller
  std::uint16_t interrupted_count = 0;
  std::array<InterruptedJob, 3>
      interrupted{};                // by ON, in this order; each continues when what interrupted it has ended
  std::uint16_t pending_count = 0;  // interrupts that wait to be served
  // The jobs that they call, the next one first; more than these may wait.
  std::array<const char*, kReportedPending> pending{"", "", "", "", "", "", "", ""};
  QuestionReport question{};
};

// Outputs of one period. Set points in `drives` keep every limit of the URDF; after an error the robot stops on the
// path, and the set points stay within the limits.
struct Outputs {
  std::array<DriveOut, kJoints> drives{};
  GroupState state = GroupState::Disabled;
  bool motion_done = false;
  bool busy = false;
  bool edit_done = false;  // msgRobotServiceEditNum may become 0
  bool moving_by_job = false;
  std::uint32_t acknowledged = 0;
  std::uint32_t done = 0;
  ErrorCode error = ErrorCode::Ok;
  std::uint32_t error_axis = 0;
  AxisNumbers joints{};                 // deg, measured
  AxisNumbers command{};                // deg
  AxisNumbers speed{};                  // deg/s, commanded
  std::array<double, 3> position{};     // mm, of the tool, commanded
  std::array<double, 3> orientation{};  // deg, roll pitch yaw
  std::array<double, 3> velocity{};     // mm/s, of the tool, commanded
  std::array<double, 3> turning{};      // deg/s, about the fixed axes
  double tool_speed = 0;                // mm/s
  double path_speed = 0;                // % of full speed
  double to_go = 0;                     // s
  std::array<AxisReport, kJoints> axes{};
  CommandAnswers commands{};
  ToolReport machine, product;
  std::array<double, 6> product_frame{};  // coordinate frame of the product in that of the machine, as last set
  AxisNumbers acceleration{};             // deg/s^2, commanded
  JobReport job;
  OperatingMode mode = OperatingMode::Any;  // the mode in effect
  bool guided = false;                      // a hand may move the arm now
  bool may_move = true;                     // true unless the mode or its enabling device forbids motion
  std::uint32_t tool = 0;                   // in use; 0: none
  const char* tool_name = "";               // valid as long as the controller
  const SpaceReport* space = nullptr;       // for other robots; null: Settings::other_robots is empty; valid so long
  // The motions that are planned, the present one first; null: no more, or it is not known where they lead. They are
  // valid until the next step. And whether this differs from the step before.
  std::array<const ToolWay*, kWaysAhead> ways{};
  bool ways_changed = false;
  // Reason why the task cannot continue, set once its drives have no power: the module must end. Null: it can continue.
  const char* broken = nullptr;
};

// Configuration of the task; the module reads it from its properties.
struct Settings {
  std::string urdf;               // file
  std::vector<std::string> jobs;  // files; a job's number is its position here, from 1
  std::chrono::nanoseconds period{10'000'000};
  // Each of the following: one number for all axes, or one for each.
  std::vector<double> counts_per_turn{1'320'000};  // of a rotary joint, in DriveIn and DriveOut; below 0: reversed
  std::vector<double> counts_per_mm{1000};         // of a sliding joint
  std::vector<double> gear{1};                     // DriveOut counts are multiplied by this
  std::vector<double> zero{0};                     // deg or mm, position of the joint at count 0 of its drive
  bool absolute = true;                            // the drives know their position without homing
  double time_to_speed = 0.25;                     // s, from rest to full speed of an axis at full acceleration
  double time_to_acceleration = 0.1;               // s, from zero to full acceleration
  // deg/s^2 and deg/s^3 of each axis, mm for sliding ones; empty: from time_to_speed and time_to_acceleration.
  std::vector<double> acceleration;
  std::vector<double> jerk;
  // kg m2 for each axis, kg for sliding ones: inertia of the motors' rotors in addition to the arm's masses, gears
  // included; empty: none.
  std::vector<double> rotor_inertia;
  // N m for each axis, N for sliding ones: the torque that 1000 thousandths in DriveIn and DriveOut stand for; empty:
  // not known. And the limit of external torque beyond what the arm needs; empty: no limit.
  std::vector<double> rated_torque;
  std::vector<double> collision_limit;
  // Guiding by hand: the mass and damping that a hand feels at the arm's end, kg and N s/m; and the torque of each axis
  // that moves nothing, N m, N for sliding ones; empty: 2 % of rated_torque.
  double guide_mass = 20;
  double guide_damping = 150;
  std::vector<double> guide_threshold;
  // mm, x y z of two opposite corners of the box that the tool's point must not leave, in the base's frame; empty: no
  // box.
  std::vector<double> workspace;
  // mm; bodies of links, tools and zones nearer to each other than this count as touching.
  double clearance = 5;
  std::string ignore_collisions;  // links, tools and zones that may touch: "forearm gripper, shoulder table"
  // The robots of this node that share its space, by the namespaces of their variables, at most kOtherRobots; its own
  // name; mm, x y z of two opposite corners of the box that contains what they share; and the pose of the robot's base
  // in the frame of that box, x y z in mm, roll pitch yaw in deg.
  std::vector<std::string> other_robots;
  std::string name;
  std::vector<double> cell_box;
  std::vector<double> base_in_cell;
  double tool_speed = 1000;       // mm/s, full speed on lines and circles
  double tool_turn_speed = 180;   // deg/s, the same for orientation
  double emergency_factor = 1.5;  // factor on the accelerations in an emergency stop
  double following_limit = 10;    // deg or mm, maximum lag of an axis
  double regain_distance = 100;   // mm, maximum distance of the tip from where a job left its path, to resume it
  // s from the request of a motion to its start, if the robot is at standstill: the time available for planning. Many
  // short lines need more, the same again for each second that they take.
  double plan_time = 0.02;
  bool plan_in_tick = false;  // true: plan in the tick, not in the background: for simulated time, or without a thread
  // Gets a result that the tick received from the planning thread; returns the one to use: a replay takes it from the
  // recording (irp::learned()). Real-time safe. Null: the given one is used.
  bool (*learned)(bool what) noexcept = nullptr;
  // Calls work(with) on a thread of the controller. Returns false if it crashed, with the reason in `why`
  // (irp::guarded()). Null: a crash ends the process.
  bool (*guarded)(void (*work)(void*) noexcept, void* with, char* why, std::size_t size) noexcept = nullptr;
  FirstQuestion first_question = nullptr;
  // Stop category of an emergency stop: 0 or 1 (IEC 60204-1).
  StopCategory emergency_category = StopCategory::Category1;
};

// Sets members from a module's properties of the same names, except urdf and jobs: `property` returns the text of one,
// or an empty one. A wrong value leaves the member unchanged and is added to `errors`: do not run a robot then.
[[gnu::visibility("default")]] void take_properties(const std::function<std::string(const char*)>& property,
                                                    Settings& settings, std::vector<std::string>& errors);

// One robot of up to eight axes: planner, jobs, state machines of PLCopen Motion Control parts 1 and 4, drives of CiA
// 402. Degrees are millimetres where an axis slides. Used by one thread at a time.
class Controller {
 public:
  // Reads robot and jobs. On failure returns null with all errors in `errors`, "file:line:col: error: text". Not
  // real-time safe.
  [[gnu::visibility("default")]] static std::unique_ptr<Controller> load(const Settings& settings,
                                                                         std::vector<std::string>& errors);
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  // One period: reads `in`, sets all of `out`. Called once per Settings::period, also while the robot is at standstill.
  // Real-time safe if `signals` is: no allocation, no lock, no system call.
  virtual void step(const Inputs& in, Signals& signals, Outputs& out) noexcept = 0;
  // What it keeps from one step to the next, for INDUROP_STATE_BY(most = Controller::kMostKept, ...): any motion, job
  // and stop under way. save() writes at most `most` bytes, which a controller that was loaded from the same files puts
  // back with restore(), also in another process. It returns 0 while a motion is being planned in the background, and
  // for good after jobs were reloaded. A step may begin meanwhile; what was written is of no use then. restore() is
  // called between two steps and returns false, without a change, if the bytes are of a controller of other files or of
  // another version. Not real-time safe.
  static constexpr std::size_t kMostKept = std::size_t{1} << 20;
  [[nodiscard]] virtual std::size_t save(void* to, std::size_t most) const noexcept = 0;
  [[nodiscard]] virtual bool restore(const void* from, std::size_t bytes) noexcept = 0;
  // Names of the variables that jobs set or wait for, each once; Signals are indexed in this order.
  [[nodiscard]] virtual const std::vector<std::string>& signals() const noexcept = 0;
  // Number of drives in use; the others stay without power.
  [[nodiscard]] virtual std::size_t axis_count() const noexcept = 0;
  // Describes what this arm can do.
  [[nodiscard]] virtual const std::string& kind() const noexcept = 0;

 protected:
  Controller() = default;
};

}  // namespace indurop::robot
