// SPDX-License-Identifier: Apache-2.0
// Jobs in memory: points, and steps with all names resolved, so that running a job needs only numbers.

#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "control/robot/collision/solid.h"
#include "control/robot/job/formula.h"
#include "control/robot/job/place_formula.h"
#include "control/robot/job/push_way.h"
#include "control/robot/kinematics/body.h"
#include "control/robot/path/segment.h"
#include "core/base/diagnostic.h"
#include "core/base/source_place.h"

namespace indurop::robot {

enum class Op : std::uint8_t {
  Move,   // index: point, or kBack and so on; mid: point; value: 1 if a joint motion has to be straight, or if
          // more points of a spline follow; formula: first one of its offset; slot: extras of the book
  Place,  // index: computed place of the book; mid: place formula of the book
  // The next four may have a formula, which `value` is multiplied with.
  Speed,         // value: part of full speed, or m/s if index is 1
  Zone,          // value: m
  Acceleration,  // value: part of the full accelerations and jerks
  Axis,          // only of a motion's own settings: index: axis from 0; value: rad or m at its end
  Tool,          // index: tool
  Load,          // index: load of the book
  Weave,         // slot: wave of the book, -1: none
  Correct,       // slot: correction of the book, -1: ends it; index: frame of its axes, -1: the base; mid: 1 for PRESS
  Set,           // index: signal; formula; pulse
  SetOnPath,     // as Set, during the motion before it: value: m before its end, after its start if mid is 1;
                 // timeout above 0: s instead of m
  Follow,        // index: signal; formula that it follows from here on, -1: no longer
  Assign,        // index: variable of the job; formula. An element of an array: index: its first one; mid: its size;
                 // formula: of the element's number, followed by that of the value
  WaitUntil,     // formula; timeout; index: step after a timeout, -1: the job fails
  WaitTime,      // value: s
  Ask,           // slot: question of the book; timeout; index: as WaitUntil
  Call,          // index: job; formula: its first argument; mid: number of arguments; slot: variable for its result
  Push,          // slot: push of the book
  Track,         // index: computed place of the frame, -1: none moves; mid: frame along or about which it does; value:
                 // belt, from 1; slot: 1 if it is a table
  Arm,           // index: job; formula; slot: interrupt of the book
  Disarm,        // index: job
  Return,        // formula: the result, -1: none
  Raise,         // formula: number of the error; mid: text of the book, -1: none
  Message,       // mid: text of the book
  Try,           // index: step after RECOVER; mid: variable that receives the error number
  EndTry,        // index: step after the whole TRY
  Recover,       // the first step after RECOVER
  Goto,          // index: step; loops between this step and that one are left or entered
  If,            // formula; index: step if true, like Goto
  Unless,        // formula; index: step if false, after a block
  Again,         // index: step at the beginning of the block
  Loop,          // value: number of passes, 0: endless; index: step after its End
  End            // index: step of its Loop
};

struct Step {
  Op op = Op::Move;
  Move move = Move::Joint;
  std::uint32_t line = 0;
  std::uint32_t column = 1;  // of a setting in the line of a motion
  int index = -1;
  int mid = -1;
  int formula = -1;
  int slot = -1;
  int guard = -1;        // step of the innermost TRY around it
  bool by_tool = false;  // Move: the offset is along the axes of the tool
  bool turns = false;    // Move: the offset turns, too; three more formulas
  double value = 0;
  double timeout = 0;  // s; 0: none
  double pulse = 0;    // s that the output is on; 0: it is set permanently
};

// Stand for a point: the place where an interrupt left the path, where the robot is, and where UNTIL ended a motion.
inline constexpr int kBack = -2;
inline constexpr int kHere = -3;
inline constexpr int kFound = -4;

// A text for the operator: parts that are written, and numbers.
struct JobText {
  struct Part {
    std::string text{};
    int formula = -1;  // -1: the text counts
  };
  std::vector<Part> parts{};
};

// An ASK statement: what the operator is asked, and what the answer may be.
struct JobQuestion {
  int text = -1;                       // of the book
  std::vector<std::string> choices{};  // empty: it asks for a number
  int lower = -1;                      // formula: range of that number; the next formula is its upper end
  double step = 1;                     // answers are whole multiples of it above the lower end
  int variable = -1;                   // of the job, receives the answer; -1: none
};

// A CORRECT or PRESS statement: how motions are shifted from here on.
struct JobCorrection {
  int formula = -1;      // evaluated in each period: first one of x, y and z in mm; PRESS: wanted and measured force of
                         // each direction, N
  bool by_tool = false;  // along the axes of the tool, instead of those of a frame
  double limit = 0;      // m, of each of them; PRESS: of all directions together
  double rate = 0;       // m/s, likewise
  int beat = -1;         // signal that changes with each measurement; -1: none
  double age = 0;        // s after which it has to have changed
  int directions = 0;    // PRESS: in how many the tool presses; 0: it is a CORRECT
  double most = 0;       // N that are measured at most, of all directions together
  // Of each direction: its axis, 0: x; and the stiffness of the contact in N/m.
  std::array<std::size_t, 3> along{};
  std::array<double, 3> stiffness{};
  [[nodiscard]] bool presses() const noexcept { return directions > 0; }
};

// A PUSH statement: an axis pushes until a condition holds, or all of its torque has been there for a time.
struct JobPush {
  PushWay way{};
  int until = -1;      // formula; -1: none
  double hold = 0;     // s that it pushes with all of the torque
  double timeout = 0;  // s; 0: none
  bool stays = false;  // it does not return to where it began
};

// What the line of a motion says besides its points.
struct MotionExtras {
  std::vector<Step> settings{};  // SPEED, ZONE, ACC and AXIS of this motion only
  int until = -1;                // formula: the motion ends where it becomes true
  bool has_to_find = false;      // it is an error if it does not
  std::uint32_t seed = 0;        // of the search for a free motion
  double within = kUsualSearch;  // s that this search may take
  int sync = -1;                 // of the book: begins together with motions of other robots
};

// A point or a frame that a job computes.
struct ComputedPlace {
  bool is_frame = false;
  int index = -1;  // in the book
};

struct Point {
  std::string name;
  Target target;
  std::string file;
  base::SourcePlace place;
  int frame = -1;                // frame of the book in which it was given; -1: the base
  Quat axes = Quat::Identity();  // of that frame
  Pose in_frame{};               // its pose in that frame
  int computed = -1;             // computed place of the book; -1: no job computes it
  // Solutions for each tool, if the point is a pose whose solutions have to be searched for; the book owns them.
  std::vector<const Solutions*> known{};
  std::array<int, kAxes> axis_columns{};  // of the words AXIS in its line; 0: it has none
};

// The position of a workpiece, a pallet or a camera: given by its pose, taught by three points, or found from points
// whose places in the frame are known, too.
struct WorkFrame {
  std::string name;
  std::string file;
  base::SourcePlace place;
  Pose pose;
  bool is_taught = false;
  std::array<int, 3> points{-1, -1, -1};  // origin, a point on x, a point on the side of y
  std::vector<int> matched{};             // points of the base
  std::vector<Vec3> in_frame{};           // the same places in the frame; empty: it is found in another way
  int tool = 0;                           // tool that touched the points
  int computed = -1;                      // computed place of the book; -1: no job computes it
};

// A tool: its tip seen from the arm's end, either given or taught by joint points at which the tip touches one place.
struct Tool {
  std::string name;
  std::string file;
  base::SourcePlace place;
  Pose tip;
  std::vector<int> points{};
  bool is_taught = false;
  Body body{};  // seen from the arm's end; a mass of 0: unknown
};

// One line that declares a body. KEEPOUT: a zone that the arm must not enter. BODY: part of a tool, in the frame of the
// arm's end.
struct BodyLine {
  std::string name;  // of the zone or of the tool
  std::string file;
  base::SourcePlace place;
  Solid solid;
  int frame = -1;  // frame of the book in which it was given; -1: the base
  int tool = -1;   // tool of the book
};

struct Job {
  std::string name;  // name of the file, without folder and extension
  std::string file;
  std::vector<Step> steps;
  // Its own; parameters first. Those without a name hold elements of arrays, limits of FOR and values of SWITCH.
  std::vector<std::string> variables{};
  std::size_t parameters = 0;
  struct Array {
    int first = 0;  // variable
    int size = 0;
  };
  std::vector<Array> arrays{};
  bool returns_value = false;  // by a RETURN
};

inline constexpr std::size_t kMaxVariables = 128;   // per job, elements of arrays included
inline constexpr std::size_t kMaxComputed = 32;     // points and frames that jobs compute, of all jobs together
inline constexpr std::size_t kMaxInterrupts = 128;  // of all jobs together
inline constexpr std::size_t kMaxPriorities = 3;    // of interrupts, so many of which may be inside each other
inline constexpr std::size_t kMaxLoops = 8;         // inside each other

// A shared variable or a SYNC that jobs use, and the first place where it is used. A variable that is both read and set
// has two entries.
struct NamedVariable {
  std::string name;
  std::string file;
  base::SourcePlace place;
  bool set = false;
};

struct JobBook {
  std::vector<Point> points;
  std::vector<WorkFrame> frames;
  std::vector<Tool> tools;  // the first one is no tool: the arm's end
  std::vector<Body> loads;  // seen from the arm's end; the first one is no load
  std::vector<BodyLine> keepouts{}, bodies{};
  std::vector<Job> jobs;
  std::vector<std::string> signals;
  std::vector<NamedVariable> named{};  // the same signals, with their places and uses
  std::vector<Formula> formulas;
  std::vector<PlacePart> place_parts{};  // of all place formulas
  std::vector<PlaceFormula> places{};
  std::vector<ComputedPlace> computed{};
  std::vector<MotionExtras> extras{};
  std::vector<JobText> texts{};
  std::vector<JobQuestion> questions{};
  std::vector<JobCorrection> corrections{};
  std::vector<Wave> waves{};
  std::vector<JobPush> pushes{};
  std::vector<NamedVariable> syncs{};
  // An ON statement: its condition, and the job that it calls when the condition becomes true. One with a lower
  // priority number interrupts the jobs of others.
  struct Interrupt {
    static constexpr int kLast = 100;  // without a PRIORITY
    int formula = -1;
    int job = -1;
    int priority = kLast;
  };
  std::vector<Interrupt> interrupts{};

  [[nodiscard]] const Job& job(int index) const noexcept { return jobs[static_cast<std::size_t>(index)]; }
  // What the line of this motion says; null: nothing.
  [[nodiscard]] const MotionExtras* extras_of(const Step& motion) const noexcept {
    return motion.slot < 0 ? nullptr : &extras[static_cast<std::size_t>(motion.slot)];
  }
  // Returns whether jobs compute the point or its frame, so that it need not be where the files say it is.
  [[nodiscard]] bool is_computed(const Point& point) const noexcept {
    return point.computed >= 0 || (point.frame >= 0 && frames[static_cast<std::size_t>(point.frame)].computed >= 0);
  }
  // Returns the index of the point P<number>; -1 if there is none.
  [[nodiscard]] int numbered_point(std::uint32_t number) const noexcept;
  [[nodiscard]] Target target(int point, int tool) const noexcept;
  // The tips of all tools.
  [[nodiscard]] std::vector<Pose> tips() const;
  std::vector<int> numbered;                            // by number, filled by parse_jobs
  std::vector<std::shared_ptr<const Solutions>> known;  // owns what Point::known points to
};

struct JobFile {
  std::string path;  // as shown in messages
  std::string text;
};

struct ReadJobs {
  JobBook book;                               // valid only if there are no diagnostics
  std::vector<base::Diagnostic> diagnostics;  // errors, at most 100
};
// The properties of the arm that the parser needs.
struct ArmShape {
  int axes = 6;
  std::array<bool, kAxes> slides{};
};
// Parses all files together: points and jobs may be used before they are declared and in other files. Not real-time
// safe.
ReadJobs parse_jobs(const std::vector<JobFile>& files, const ArmShape& shape = {});

class Arm;

// Computes the tips of taught tools; a note states for each of them how well its points agree.
std::vector<base::Diagnostic> place_tools(JobBook& book, const Arm& arm);
// Computes frames from their points, and points from their frames; a note states how well matched points agree. The
// parser itself does not know the arm.
std::vector<base::Diagnostic> place_frames(JobBook& book, const Arm& arm);

}  // namespace indurop::robot
