// SPDX-License-Identifier: Apache-2.0
// What a robot does while it runs the job of a topic, period by period.

#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "topic_run.h"

namespace indurop::robot {

struct TopicSample {
  double time = 0;              // s since the tip was at its first point
  std::array<double, 3> tip{};  // mm, set point
  double speed = 0;             // mm/s of the tip
  double axis = 0;              // deg or mm, set point of the first axis
  std::string called;           // name of the job that is executed; "main" is the job of the topic
  std::string statement;        // of that job
  std::string message;          // for the operator, and the open question
  std::string question;
  std::map<std::string, double> values;  // of shared variables
};

struct TopicTrace {
  std::vector<TopicSample> samples;
  std::map<std::string, std::array<double, 3>> points;  // mm, as declared

  // The first sample of the period `nth` (from 1) in which something begins that was not so in the period before it:
  // "at TEXT": the statement TEXT; "O8 = 1": a variable has this value; "job NAME": that job is executed; "message
  // TEXT", "question TEXT": the operator sees it; "no question": the question was answered or timed out; "rest": the
  // robot comes to a standstill. -1: there is none.
  [[nodiscard]] int begin(const std::string& trigger, int nth = 1) const;
  // Samples at which a variable begins to be on, or off.
  [[nodiscard]] std::vector<std::size_t> edges(const std::string& signal, bool on) const;
  // First samples of the periods of standstill.
  [[nodiscard]] std::vector<std::size_t> rests() const;
};

// Throws std::runtime_error if the job does not run to its end.
TopicTrace trace_of(const Topic& topic, const std::vector<std::string>& signals);

}  // namespace indurop::robot
