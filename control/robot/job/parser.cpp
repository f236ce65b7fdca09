// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/parser.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "control/robot/path/spline.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kMostSteps = 20000;
constexpr const char* kStatements =
    "POINT, FRAME, TOOL, LOAD, BODY, KEEPOUT, PARAM, VAR, SPEED, ACC, ZONE, MOVJ, MOVL, MOVC, MOVS, SET, PULSE, WAIT, "
    "CALL, ON, OFF, RETURN, LABEL, GOTO, IF, ELSEIF, ELSE, WHILE, FOR, LOOP, TRY, RECOVER and END";

std::string name_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.find('.'));
}

}  // namespace

std::string JobParser::shown(const JobToken& token) {
  return token.kind == JobToken::Kind::End ? std::string("the end of the line") : in_quotes(token.text);
}

void JobParser::error(const JobToken& at, const std::string& text) {
  if (!failed_) {
    error_in(job().file, line_, at.column, text);
  }
  failed_ = true;
}

void JobParser::error_in(const std::string& file, std::size_t line, std::size_t column, const std::string& text) {
  errors_.add({base::Diagnostic::Severity::Error, file, {static_cast<int>(line), static_cast<int>(column)}, text});
}

bool JobParser::accept(std::string_view word) {
  const bool matches = peek().kind != JobToken::Kind::Number && same_word(peek().text, word);
  at_ += matches ? 1 : 0;
  return matches;
}

Step& JobParser::add(Op op) {
  Step step;
  step.op = op;
  step.line = static_cast<std::uint32_t>(line_);
  job().steps.push_back(step);
  return job().steps.back();
}

void JobParser::expect_end() {
  if (peek().kind != JobToken::Kind::End) {
    error(peek(), "unexpected " + shown(peek()) + "; one statement per line");
  }
}

void JobParser::read(const JobFile& file) {
  book_.jobs.push_back({name_of(file.path), file.path, {}, {}, 0});
  labels_.emplace_back();
  blocks_.clear();
  std::string_view rest = file.text;
  if (rest.starts_with("\xEF\xBB\xBF")) {
    rest.remove_prefix(3);
  }
  for (line_ = 1; !rest.empty() && job().steps.size() <= kMostSteps; ++line_) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    tokens_ = split_job_line(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    at_ = 0;
    failed_ = false;
    if (peek().kind != JobToken::Kind::End) {
      statement();
    }
  }
  JobToken start;
  failed_ = false;
  if (job().steps.size() > kMostSteps) {
    error(start, "more than " + std::to_string(kMostSteps) + " steps; split the job and use CALL");
  }
  for (const Block& block : blocks_) {
    error_in(file.path, block.line, 1, std::string(block.word) + " without END");
  }
}

void JobParser::statement() {
  struct Known {
    const char* word;
    void (*parse)(JobParser&);
  };
  static constexpr Known kKnown[] = {
      {"POINT", [](JobParser& p) { p.point(); }},
      {"FRAME", [](JobParser& p) { p.frame(); }},
      {"TOOL", [](JobParser& p) { p.tool(); }},
      {"LOAD", [](JobParser& p) { p.load(); }},
      {"BODY", [](JobParser& p) { p.body(); }},
      {"KEEPOUT", [](JobParser& p) { p.keepout(); }},
      {"SPEED", [](JobParser& p) { p.speed(); }},
      {"ZONE", [](JobParser& p) { p.zone(); }},
      {"ACC", [](JobParser& p) { p.acceleration(); }},
      {"MOVJ", [](JobParser& p) { p.move(Move::Joint); }},
      {"MOVL", [](JobParser& p) { p.move(Move::Line); }},
      {"MOVC", [](JobParser& p) { p.move(Move::Circle); }},
      {"MOVS", [](JobParser& p) { p.spline(); }},
      {"SET", [](JobParser& p) { p.set(); }},
      {"PULSE", [](JobParser& p) { p.pulse(); }},
      {"WAIT", [](JobParser& p) { p.wait(); }},
      {"CALL", [](JobParser& p) { p.call(); }},
      {"ON", [](JobParser& p) { p.arm(); }},
      {"OFF", [](JobParser& p) { p.disarm(); }},
      {"LABEL", [](JobParser& p) { p.label(); }},
      {"GOTO", [](JobParser& p) { p.jump(); }},
      {"IF", [](JobParser& p) { p.if_goto(); }},
      {"LOOP", [](JobParser& p) { p.loop(); }},
      {"END", [](JobParser& p) { p.end_block(); }},
      {"VAR", [](JobParser& p) { p.variable(); }},
      {"PARAM", [](JobParser& p) { p.parameters(); }},
      {"RETURN", [](JobParser& p) { p.add(Op::Return); }},
      {"ELSE", [](JobParser& p) { p.otherwise(false); }},
      {"ELSEIF", [](JobParser& p) { p.otherwise(true); }},
      {"WHILE", [](JobParser& p) { p.while_block(); }},
      {"FOR", [](JobParser& p) { p.for_block(); }},
      {"TRY", [](JobParser& p) { p.try_block(); }},
      {"RECOVER", [](JobParser& p) { p.recover(); }},
  };
  const auto* const known =
      std::find_if(std::begin(kKnown), std::end(kKnown), [this](const Known& each) { return accept(each.word); });
  if (known != std::end(kKnown)) {
    known->parse(*this);
  } else if (peek().kind == JobToken::Kind::Word && tokens_[at_ + 1].text == "=") {
    assign();
  } else {
    error(peek(), "unknown statement " + shown(peek()) + "; known are " + kStatements);
  }
  if (!failed_) {
    expect_end();
  }
}

bool JobParser::numbers(int count, double* to, const char* what) {
  for (int i = 0; i < count; ++i) {
    accept(",");
    if (peek().kind != JobToken::Kind::Number || !std::isfinite(peek().value)) {
      error(peek(), count == 1 ? std::string("expected ") + what + ", found " + shown(peek())
                               : "expected " + std::to_string(count) + " numbers: " + what + "; found " +
                                     shown(peek()) + " as number " + std::to_string(i + 1));
      return false;
    }
    to[i] = take().value;
  }
  return true;
}

void JobParser::joint_point(Target& target) {
  double q[kAxes] = {};
  const bool usual = shape_.axes == 6 && shape_.slides == ArmShape{}.slides;
  if (numbers(shape_.axes, q,
              usual ? "the angles of the six joints in degrees" : "one of each axis, degrees, mm where it slides")) {
    for (int i = 0; i < shape_.axes; ++i) {
      target.joints[i] = axis_value(i, q[i]);
    }
  }
}

bool JobParser::pose(Pose& pose) {
  double position[3];
  double rpy[3];
  if (!numbers(3, position, "x y z in mm")) {
    return false;
  }
  if (!accept("RPY")) {
    error(peek(), "expected RPY and roll, pitch and yaw in degrees, found " + shown(peek()));
    return false;
  }
  if (!numbers(3, rpy, "roll, pitch and yaw in degrees")) {
    return false;
  }
  pose.position = Vec3(position[0], position[1], position[2]) / 1000;
  pose.orientation = from_rpy({radians(rpy[0]), radians(rpy[1]), radians(rpy[2])});
  return true;
}

void JobParser::pose_point(Target& target) {
  target.is_pose = true;
  if (!pose(target.pose)) {
    return;
  }
  if (accept("POSTURE")) {
    posture(target);
  }
  while (!failed_ && accept("AXIS")) {
    held_axis(target);
  }
  if (!failed_ && accept("IN")) {
    const JobToken name = take();
    if (name.kind != JobToken::Kind::Word) {
      error(name, "expected the name of a frame, found " + shown(name));
      return;
    }
    point_frames_.push_back({book_.points.size(), book_.jobs.size() - 1, std::string(name.text), line_, name.column});
  }
}

void JobParser::posture(Target& target) {
  double posture = 0;
  if (!(numbers(1, &posture, "the posture, 0 to 7") && posture >= 0 && posture <= 7 &&
        posture == std::floor(posture))) {
    error(tokens_[at_ - 1],
          "a posture is a whole number from 0 to 7: 1 over the back, 2 other elbow, 4 wrist turned over, added");
    return;
  }
  target.posture = static_cast<std::uint8_t>(posture);
}

// Parses the axis that a pose leaves undetermined on arms with more than six axes.
void JobParser::held_axis(Target& target) {
  double axis = 0;
  double value = 0;
  if (!(numbers(1, &axis, "the number of an axis") && axis >= 1 && axis <= shape_.axes && axis == std::floor(axis))) {
    error(tokens_[at_ - 1], "axes have the numbers 1 to " + std::to_string(shape_.axes));
    return;
  }
  const int index = static_cast<int>(axis) - 1;
  if (numbers(1, &value, "where the axis is to stand")) {
    target.joints[index] = axis_value(index, value);
    target.held |= 1U << static_cast<unsigned>(index);
  }
}

double JobParser::axis_value(int axis, double written) const noexcept {
  return shape_.slides[static_cast<std::size_t>(axis)] ? written / 1000 : radians(written);
}

void JobParser::point() {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, "expected the name of the point, found " + shown(name));
    return;
  }
  if (!accept("=")) {
    error(peek(), "expected '=', found " + shown(peek()) + "; POINT " + std::string(name.text) +
                      " = JOINT 0 0 0 0 0 0, or = POSE 500 0 300 RPY 180 0 0");
    return;
  }
  Target target;
  if (accept("JOINT")) {
    joint_point(target);
  } else if (accept("POSE")) {
    pose_point(target);
  } else {
    error(peek(), "expected JOINT or POSE, found " + shown(peek()));
  }
  const std::string text(name.text);
  const auto [found, fresh] = point_places_.try_emplace(text, job().file + ":" + std::to_string(line_));
  if (!fresh) {
    error(name, "there is already a point " + in_quotes(text) + " at " + found->second);
  }
  if (fresh && !failed_) {
    book_.points.push_back(
        {text, target, job().file, {static_cast<int>(line_), static_cast<int>(name.column)}, -1, Quat::Identity(), {}});
  } else if (!point_frames_.empty() && point_frames_.back().owner == book_.points.size()) {
    point_frames_.pop_back();  // the frame of a point that does not exist
  }
}

void JobParser::reference(JobReference::To to, const char* what) {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, std::string("expected the name of a ") + what + ", found " + shown(name));
    return;
  }
  references_.push_back(
      {to, book_.jobs.size() - 1, job().steps.size() - 1, std::string(name.text), line_, name.column});
}

void JobParser::move(Move kind) {
  add(Op::Move).move = kind;
  if (kind == Move::Circle) {
    reference(JobReference::To::Mid, "point on the circle");
    accept(",");
  }
  if (!failed_) {
    reference(JobReference::To::Target, "point");
  }
  if (!failed_ && accept("OFFSET")) {
    offset();
  }
  if (kind == Move::Joint && !failed_ && accept("STRAIGHT")) {
    job().steps.back().value = 1;
  }
}

// Adds a step for each point of the spline.
void JobParser::spline() {
  const JobToken start = tokens_[at_ - 1];
  int points = 0;
  while (!failed_ && peek().kind != JobToken::Kind::End) {
    Step& step = add(Op::Move);
    step.move = Move::Spline;
    step.value = 1;
    reference(JobReference::To::Target, "point of the spline");
    accept(",");
    ++points;
  }
  if (points < 2) {
    error(start, "a spline goes through two points or more; MOVL goes to one");
  } else if (points > Spline::kMost) {
    error(start,
          "a spline of " + std::to_string(points) + " points; " + std::to_string(Spline::kMost) + " is the most");
  } else {
    job().steps.back().value = 0;
  }
}

void JobParser::speed() {
  const JobToken number = peek();
  double value = 0;
  if (!numbers(1, &value, "the speed, 50% or 250 mm/s")) {
    return;
  }
  Step& step = add(Op::Speed);
  if (accept("%")) {
    step.value = value / 100;
    if (!(value > 0 && value <= 100)) {
      error(number, "a speed is above 0 and at most 100 %");
    }
    return;
  }
  // "mm/s" is a word followed by a sign that no other statement has.
  const bool mm = accept("mm");
  const bool per_second = mm && accept("/") && accept("s");
  if (!per_second) {
    error(peek(), "expected % or mm/s, found " + shown(peek()));
    return;
  }
  step.index = 1;
  step.value = value / 1000;
  if (!(value > 0)) {
    error(number, "a speed is above 0");
  }
}

void JobParser::zone() {
  const JobToken number = peek();
  double value = 0;
  if (!numbers(1, &value, "the zone, 20 mm")) {
    return;
  }
  accept("mm");
  add(Op::Zone).value = value / 1000;
  if (!(value >= 0 && value <= 1000)) {
    error(number, "a zone is from 0 (stop at the point) to 1000 mm");
  }
}

void JobParser::acceleration() {
  const JobToken number = peek();
  double value = 0;
  if (!numbers(1, &value, "the acceleration, 50%")) {
    return;
  }
  if (!accept("%")) {
    error(peek(), "expected %, found " + shown(peek()));
    return;
  }
  add(Op::Acceleration).value = value / 100;
  if (!(value >= 1 && value <= 100)) {
    error(number, "an acceleration is from 1 to 100 % of the full one");
  }
}

}  // namespace indurop::robot
