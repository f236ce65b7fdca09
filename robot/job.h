// SPDX-License-Identifier: Apache-2.0
// Jobs in memory: points, and steps with all names resolved, so that running one is a matter of numbers.

#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/source_place.h"
#include "robot/body.h"
#include "robot/job_formula.h"
#include "robot/segment.h"
#include "robot/solid.h"

namespace indurop::robot {

enum class Op : std::uint8_t {
  Move,          // index: point, or kBack; mid: point; value: 1 if a joint motion is to be straight,
                 // or if points of a spline follow
  Speed,         // value: part of full speed, or m/s if index is 1
  Zone,          // value: m
  Acceleration,  // value: part of the full ones, of jerk too
  Tool,          // index: tool
  Load,          // index: of the book's loads
  Set,           // index: signal; formula; pulse
  SetOnPath,     // the same, of the motion before it: value: m before its end, behind its beginning if mid is 1;
                 // timeout above 0: s instead
  Assign,        // index: variable of the job; formula
  WaitUntil,     // formula; timeout
  WaitTime,      // value: s
  Call,          // index: job; formula: the first of its arguments; mid: how many
  Arm,           // index: job; formula; slot: of the book's interrupts
  Disarm,        // index: job
  Return,
  Try,      // index: what comes behind RECOVER; mid: the variable that takes the error's number
  EndTry,   // index: step behind all of it
  Recover,  // the first step behind RECOVER
  Goto,     // index: step; loops between here and there are left or entered
  If,       // formula; index: step if true, as Goto
  Unless,   // formula; index: step if false, behind a block
  Again,    // index: step at the beginning of the block
  Loop,     // value: times, 0: for ever; index: step behind its End
  End       // index: step of its Loop
};

struct Step {
  Op op = Op::Move;
  Move move = Move::Joint;
  std::uint32_t line = 0;
  int index = -1;
  int mid = -1;
  int formula = -1;
  int slot = -1;
  int guard = -1;        // step of the innermost TRY it is in
  bool by_tool = false;  // Move: the offset is along the axes of the tool
  double value = 0;
  double timeout = 0;  // s; 0: none
  double pulse = 0;    // s that it is on; 0: it is set
};

// Instead of a point: where an interrupt left the path.
inline constexpr int kBack = -2;

struct Point {
  std::string name;
  Target target;
  std::string file;
  base::SourcePlace place;
  int frame = -1;                // of the book, in which it was given; -1: the base
  Quat axes = Quat::Identity();  // of that frame
  // With each tool, of a pose for which an arm has to be searched; the book keeps them.
  std::vector<const Solutions*> known{};
};

// Where a workpiece or a pallet is: by its pose, or taught by three points.
struct WorkFrame {
  std::string name;
  std::string file;
  base::SourcePlace place;
  Pose pose;
  bool is_taught = false;
  std::array<int, 3> points{-1, -1, -1};  // origin, on x, on the side of y
  int tool = 0;                           // that touched them
};

// What the arm holds: its tip seen from the arm's end, or taught by points of joint angles that touch the same place.
struct Tool {
  std::string name;
  std::string file;
  base::SourcePlace place;
  Pose tip;
  std::vector<int> points{};
  bool is_taught = false;
  Body body{};  // seen from the arm's end; a mass of 0: not known
};

// KEEPOUT: what the arm keeps out of. BODY: a part of a tool, in the frame of the arm's end.
struct BodyLine {
  std::string name;  // of the zone, or of the tool
  std::string file;
  base::SourcePlace place;
  Solid solid;
  int frame = -1;  // of the book, in which it was given; -1: the base
  int tool = -1;   // of the book
};

struct Job {
  std::string name;  // of the file, without folder and ending
  std::string file;
  std::vector<Step> steps;
  std::vector<std::string>
      variables{};  // its own; parameters first, those without a name are the job's own limits of FOR
  std::size_t parameters = 0;
};

inline constexpr std::size_t kMostVariables = 32;  // of one job
inline constexpr std::size_t kMostInterrupts = 8;  // of all jobs

// A shared variable that jobs name, and where they do first.
struct NamedVariable {
  std::string name;
  std::string file;
  base::SourcePlace place;
};

struct JobBook {
  std::vector<Point> points;
  std::vector<WorkFrame> frames;
  std::vector<Tool> tools;  // the first one is none: the arm's end
  std::vector<Body> loads;  // seen from the arm's end; the first one is none
  std::vector<BodyLine> keepouts{}, bodies{};
  std::vector<Job> jobs;
  std::vector<std::string> signals;
  std::vector<NamedVariable> named{};  // likewise, with their places
  std::vector<Formula> formulas;
  // What ON watches: the job it calls once its condition becomes true.
  struct Interrupt {
    int formula = -1;
    int job = -1;
  };
  std::vector<Interrupt> interrupts{};

  // Index of the point called P<number>; -1 if there is none.
  [[nodiscard]] int numbered_point(std::uint32_t number) const noexcept;
  [[nodiscard]] Target target(int point, int tool) const noexcept;
  // Of all tools.
  [[nodiscard]] std::vector<Pose> tips() const;
  std::vector<int> numbered;                            // by number, filled by parse_jobs
  std::vector<std::shared_ptr<const Solutions>> known;  // Point::known points there
};

struct JobFile {
  std::string path;  // as it appears in messages
  std::string text;
};

struct ReadJobs {
  JobBook book;                               // counts only if there are no diagnostics
  std::vector<base::Diagnostic> diagnostics;  // errors, at most 100
};
// What a file has to know of the arm.
struct ArmShape {
  int axes = 6;
  std::array<bool, kAxes> slides{};
};
// All files together: points and jobs may be used before and beyond the file that declares them. Not real-time safe.
ReadJobs parse_jobs(const std::vector<JobFile>& files, const ArmShape& shape = {});

class Arm;

// Finds the tips of tools that are taught; a note says of each how well its points agree.
std::vector<base::Diagnostic> place_tools(JobBook& book, const Arm& arm);
// Puts frames where their points are, and points where their frames are. The parser knows nothing of the arm.
std::vector<base::Diagnostic> place_frames(JobBook& book, const Arm& arm);

}  // namespace indurop::robot
