// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/line.h"

#include <cmath>

namespace indurop::robot {

void JobLine::begin(const std::string& file) {
  file_ = file;
  number_ = 0;
}

void JobLine::next(std::string_view text) {
  tokens_ = split_job_line(text);
  keywords_.clear();
  at_ = 0;
  ++number_;
  failed_ = false;
}

base::SourcePlace JobLine::place(const JobToken& token) const noexcept {
  return {static_cast<int>(number_), static_cast<int>(token.column)};
}

bool JobLine::is_word(const JobToken& token, std::string_view word) {
  const bool matches = token.kind != JobToken::Kind::Number && same_word(token.text, word);
  if (matches) {
    keywords_.push_back({token.column, word});
  }
  return matches;
}

bool JobLine::accept(std::string_view word) {
  const bool matches = is_word(peek(), word);
  at_ += matches ? 1 : 0;
  return matches;
}

bool JobLine::accept_unit(std::string_view unit) {
  const std::size_t sign = unit.find('/');
  return sign == std::string_view::npos
             ? accept(unit)
             : accept(unit.substr(0, sign)) && accept("/") && accept_unit(unit.substr(sign + 1));
}

void JobLine::expect_end() {
  if (!at_end()) {
    error(peek(), "unexpected " + shown(peek()) + "; one statement per line");
  }
}

bool JobLine::numbers(int count, double* to, const char* what) {
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

bool JobLine::numbers_ahead(int count) const {
  std::size_t next = at_;
  for (int i = 0; i < count; ++i, ++next) {
    if (i > 0 && tokens_[next].text == ",") {
      ++next;
    }
    if (tokens_[next].kind != JobToken::Kind::Number) {
      return false;
    }
  }
  const JobToken& then = tokens_[next];
  return then.kind == JobToken::Kind::End || then.text == ":" || then.text == ")" || then.text == "," ||
         (then.kind == JobToken::Kind::Word && !same_word(then.text, "MOD"));
}

bool JobLine::duration(double& seconds) {
  const JobToken number = peek();
  if (!numbers(1, &seconds, "a time, 0.5s or 200 ms")) {
    return false;
  }
  const bool ms = accept("ms");
  if (!ms && !accept("s")) {
    error(peek(), "expected s or ms, found " + shown(peek()));
    return false;
  }
  seconds = ms ? seconds / 1000 : seconds;
  if (!(seconds >= 0 && seconds <= 86400)) {
    error(number, "a time is from 0 to 86400 s");
    return false;
  }
  return true;
}

bool JobLine::rpy(Quat& orientation) {
  double rpy[3];
  if (!numbers(3, rpy, "roll, pitch and yaw in degrees")) {
    return false;
  }
  orientation = from_rpy({radians(rpy[0]), radians(rpy[1]), radians(rpy[2])});
  return true;
}

bool JobLine::pose(Pose& pose) {
  double position[3];
  if (!numbers(3, position, "x y z in mm")) {
    return false;
  }
  if (!accept("RPY")) {
    error(peek(), "expected RPY and roll, pitch and yaw in degrees, found " + shown(peek()));
    return false;
  }
  pose.position = Vec3(position[0], position[1], position[2]) / 1000;
  return rpy(pose.orientation);
}

void JobLine::error(const JobToken& at, const std::string& text) {
  if (!failed_) {
    error_in(file_, number_, at.column, text);
  }
  failed_ = true;
}

void JobLine::error_in(const std::string& file, std::size_t line, std::size_t column, const std::string& text) {
  errors_.add({base::Diagnostic::Severity::Error, file, {static_cast<int>(line), static_cast<int>(column)}, text});
}

std::string JobLine::shown(const JobToken& token) {
  return token.kind == JobToken::Kind::End ? std::string("the end of the line") : in_quotes(token.text);
}

}  // namespace indurop::robot
