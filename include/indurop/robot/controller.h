// SPDX-License-Identifier: Apache-2.0
// The robot task as a module sees it: one object that is loaded in start() and stepped in every run(). What goes in and
// out are plain numbers, which the module takes from and puts into its shared variables; see examples/robot_cell.

#pragma once

#include <indurop/robot/commands.h>
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

inline constexpr std::size_t kJoints = 8;  // there is room for that many axes

// A number of each axis, from and to arrays that are as long as the arm has axes.
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

// A CiA 402 drive: what it says and what it is told. Positions are counts.
struct DriveIn {
  std::uint16_t error = 0;
  std::uint16_t status = 0;
  std::int8_t mode = 0;
  std::int32_t position = 0;
  // Of the touch probe: its status (60B9h) and what it stored.
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
  std::int16_t torque_offset = 0;  // what the motion needs (60B2h), 1/1000 of the rated torque
  std::int16_t torque = 0;         // target torque of mode 10 (6071h), beside the offset
};

// What a service is asked for with, as ROBOT_MODULE_SERVICE.
struct ServiceRequest {
  std::int32_t code = 0;     // Service
  std::uint32_t number = 0;  // another one than last time: a new request
  std::uint32_t level = 0;   // position level: 0 stops at the target, above that the path is rounded `level` cm before
  double speed = 0;          // %; 0: as fast as possible
  std::uint32_t point = 0;
  std::uint32_t mid = 0;
  std::uint32_t job = 0;
  AxisNumbers target{};    // deg, mm of sliding axes; or a pose: mm and deg
  double velocity = 0;     // DirectAbsolute: %, LinearAbsolute: mm/s; 0: `speed` counts
  std::uint32_t line = 0;  // JobStart: where it begins; 0: with the first one
  std::uint32_t tool = 0;  // SelectTool: in the order of the files, from 1; 0: none, the arm's end
};

// As AXIS_SERVICE[n]. Zeros in velocity, acceleration and jerk stand for the most the axis can.
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
  // `index` counts in Controller::signals().
  virtual double read(std::size_t index) noexcept = 0;
  virtual void write(std::size_t index, double value) noexcept = 0;
  // Jobs that were read anew name other variables: makes ready for them, while read() and write() go on as before.
  // False, and why, if it cannot. By a thread of the controller, or in the tick of a simulation; not real-time safe.
  virtual bool prepare(const std::vector<std::string>& /*names*/, std::string& why) {
    why = "the jobs name other variables than before; start the node anew";
    return false;
  }
  // From now on what was made ready counts. Real-time safe.
  virtual void adopt() noexcept {}
};

// Moving by hand while the group stands by: one axis, or the tip along or about one direction.
enum class JogFrame : std::int16_t { Joint, Base, Tool, Work };
struct JogRequest {
  bool enabled = false;  // the enabling switch; without it the robot comes to rest
  JogFrame frame = JogFrame::Joint;
  AxisNumbers speed{};     // %, with its sign; of axes, or x y z and turns about them. The first that is not 0 counts
  std::uint32_t beat = 0;  // 0: the switch counts by itself; else only while this changes at least every 0.3 s
  // JogFrame::Work: a frame of the jobs by its name, as far as that fits; another one moves nothing.
  string<32> work;
};

// The operating mode that is asked for. It changes once the robot stands, and the robot comes to rest for that.
struct ModeRequest {
  OperatingMode mode = OperatingMode::Any;  // a number that is none of them is manual mode without the switch
  bool enabled = false;                     // the enabling switch of manual mode
  std::uint32_t beat = 0;                   // of the switch, as JogRequest::beat
};

// A conveyor or a rotary table, as whoever reads its encoder tells it.
struct BeltIn {
  double place = 0;        // mm or degrees; it counts on and on
  std::uint32_t beat = 0;  // another one each time that `place` is told
};

// A job that is to pause before a line of its file.
struct Breakpoint {
  std::uint32_t job = 0;   // from 1; 0: none
  std::uint32_t line = 0;  // from 1
};
using Breakpoints = std::array<Breakpoint, 8>;

// What one period takes in: drives as they were read, requests as PLC programs wrote them, all of one moment.
struct Inputs {
  std::array<DriveIn, kJoints> drives{};
  ServiceRequest service;
  bool edit = false;  // msgRobotServiceEditNum: a request without a number
  std::array<AxisRequest, kJoints> axes{};
  Commands commands{};
  CamTables cams{};
  std::array<BeltIn, kBelts> belts{};
  ProfileTables profiles{};
  // Parts of speed, acceleration and jerk of single axes; of the speed of the group.
  struct Factors {
    AxisNumbers velocity{1, 1, 1, 1, 1, 1, 1, 1};
    AxisNumbers acceleration{1, 1, 1, 1, 1, 1, 1, 1};
    AxisNumbers jerk{1, 1, 1, 1, 1, 1, 1, 1};
    double group = 1;
  } factors;
  // False while the board that asks has not been heard: a request of the time before is not taken for a new one.
  bool requests_known = true;
  double speed_override = 100;  // %
  bool hold = false;
  bool emergency = false;
  bool single_step = false;  // jobs pause before each line
  Breakpoints breakpoints{};
  JogRequest jog;
  ModeRequest mode;
};

// What is told of one axis, as AXIS_STATUS[n]. A request is acknowledged, and later done or aborted, by its number.
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
  // What it can do at most.
  double lower = 0, upper = 0;
  double most_velocity = 0, most_acceleration = 0, most_jerk = 0;
  double probe = 0;   // deg, what its touch probe recorded last
  double phase = 0;   // deg or mm of the axis that it follows, which it sees so much further on
  double torque = 0;  // N m (N), measured; 0: rated_torque is not known
  double push = 0;    // N m (N) of it that the arm does not need for how it moves; 0 without collision_limit
  // What it keeps to in motions by itself, by parameters that were written.
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

// The job that runs or ran last. `line`, from 1, is of the file of `called`: of that job, or of one that it called.
struct JobReport {
  JobState state = JobState::Idle;
  std::uint32_t job = 0;
  std::uint32_t line = 0;
  std::uint32_t cycles = 0;
  const char* name = "";     // lives as long as the controller
  const char* message = "";  // the same
  bool can_resume = false;   // JobResume goes on with it
  const char* called = "";   // lives as long as the controller
};

// What one period puts out. Set points in `drives` keep every limit of the URDF; an error stops on the path, and what
// is commanded then is still within limits.
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
  std::array<double, 6> product_frame{};  // the product's coordinates in those of the machine, as they were set last
  AxisNumbers acceleration{};             // deg/s^2, commanded
  JobReport job;
  OperatingMode mode = OperatingMode::Any;  // that holds now
  bool may_move = true;                     // as far as the mode and its enabling switch are concerned
  std::uint32_t tool = 0;                   // held now; 0: none
  const char* tool_name = "";               // lives as long as the controller
  // Why the task cannot go on, once its drives have no power: the module is to end. Null: it can.
  const char* broken = nullptr;
};

// What the task is made of; the module reads it from its properties.
struct Settings {
  std::string urdf;               // file
  std::vector<std::string> jobs;  // files; a job's number is its place here, from 1
  std::chrono::nanoseconds period{10'000'000};
  // Each of these: one number for all axes, or one of each.
  std::vector<double> counts_per_turn{1'320'000};  // of a joint, in DriveIn and DriveOut; below 0: the other way round
  std::vector<double> counts_per_mm{1000};         // of one that slides
  std::vector<double> gear{1};                     // DriveOut counts this many times more
  std::vector<double> zero{0};                     // deg or mm, where the joint is while its drive is at count 0
  bool absolute = true;                            // the drives know where they are without homing
  double time_to_speed = 0.25;                     // s, from rest to full speed of an axis with full acceleration
  double time_to_acceleration = 0.1;               // s, from none to full acceleration
  // deg/s^2 and deg/s^3 of each axis, mm of sliding ones; empty: by time_to_speed and time_to_acceleration.
  std::vector<double> acceleration;
  std::vector<double> jerk;
  // kg m2 of each axis, kg of sliding ones: what the motors' rotors are beside the arm's masses, gears included; empty:
  // none.
  std::vector<double> rotor_inertia;
  // N m of each axis, N of sliding ones: what 1000 thousandths of torque are in DriveIn and DriveOut; empty: not known.
  // And what may push against them beside what the arm needs; empty: anything.
  std::vector<double> rated_torque;
  std::vector<double> collision_limit;
  // mm, x y z of two opposite corners of the box that the tool's point does not leave, in the base's frame; empty:
  // none.
  std::vector<double> workspace;
  // mm; bodies of links, tools and zones that are nearer to each other touch.
  double clearance = 5;
  std::string ignore_collisions;  // links, tools and zones that may touch: "forearm gripper, shoulder table"
  double tool_speed = 1000;       // mm/s, full speed on lines and circles
  double tool_turn_speed = 180;   // deg/s, the same for orientation
  double emergency_factor = 1.5;  // of the accelerations, in an emergency stop
  double following_limit = 10;    // deg or mm an axis may be behind
  double regain_distance = 100;   // mm the tip may be away from where a job left its path, to go on with it
  // s from asking for a motion to its beginning, if the robot stands: what planning it has time for. More for many
  // short lines, as much again for each second that they take.
  double plan_time = 0.02;
  bool plan_in_tick = false;  // not beside it: where time is simulated, or no thread wanted
  // What the tick learns of the thread that plans beside it, and what is to count instead: a replay learns it again
  // from the recording (irp::learned()). Real-time safe. Null: it counts.
  bool (*learned)(bool what) noexcept = nullptr;
  // Calls work(with) on a thread of the controller. False: it crashed, and `why` says how (irp::guarded()). Null: a
  // crash ends the process.
  bool (*guarded)(void (*work)(void*) noexcept, void* with, char* why, std::size_t size) noexcept = nullptr;
  // Of an emergency stop: 0 or 1 (IEC 60204-1).
  StopCategory emergency_category = StopCategory::Category1;
};

// Fills in what a module's properties say, by the names of the members, urdf and jobs excepted: `property` gives the
// text of one, or an empty one. What is wrong keeps its value and is added to `errors`: do not run a robot then.
[[gnu::visibility("default")]] void take_properties(const std::function<std::string(const char*)>& property,
                                                    Settings& settings, std::vector<std::string>& errors);

// One robot of up to eight axes: planner, jobs, state machines of PLCopen Motion Control parts 1 and 4, drives of CiA
// 402. Degrees are millimetres where an axis slides. Used by one thread at a time.
class Controller {
 public:
  // Reads robot and jobs. Returns null with everything that is wrong in `errors`, "file:line:col: error: text". Not
  // real-time safe.
  [[gnu::visibility("default")]] static std::unique_ptr<Controller> load(const Settings& settings,
                                                                         std::vector<std::string>& errors);
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  // One period: reads `in`, sets all of `out`. It is called once per Settings::period, also while the robot stands.
  // Real-time safe if `signals` is: no allocation, no lock, no system call.
  virtual void step(const Inputs& in, Signals& signals, Outputs& out) noexcept = 0;
  // Names of the variables that jobs set or wait for, each once; Signals count in this order.
  [[nodiscard]] virtual const std::vector<std::string>& signals() const noexcept = 0;
  // So many drives it has; the others stay without power.
  [[nodiscard]] virtual std::size_t axis_count() const noexcept = 0;
  // What this arm can do, in words.
  [[nodiscard]] virtual const std::string& kind() const noexcept = 0;

 protected:
  Controller() = default;
};

}  // namespace indurop::robot
