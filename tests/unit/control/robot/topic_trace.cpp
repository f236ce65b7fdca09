// SPDX-License-Identifier: Apache-2.0
#include "topic_trace.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "control/robot/files/urdf.h"
#include "control/robot/job/job.h"

namespace indurop::robot {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    lines.push_back(begin == std::string::npos ? "" : line.substr(begin));
  }
  return lines;
}

std::map<std::string, std::array<double, 3>> points_of(const Topic& topic) {
  const ArmModel model = arm_from_urdf("arm.urdf", topic_urdf(topic)).value();
  ArmShape shape;
  shape.axes = model.arm.count();
  for (int i = 0; i < model.arm.count(); ++i) {
    shape.slides[static_cast<std::size_t>(i)] = model.arm.axis(i).slides();
  }
  std::vector<JobFile> files{{"main.job", topic_text(topic.name)}};
  for (const std::string& other : topic.others) {
    files.push_back({other + ".job", topic_text(other)});
  }
  ReadJobs read = parse_jobs(files, shape);
  static_cast<void>(place_frames(read.book, model.arm));
  std::map<std::string, std::array<double, 3>> points;
  for (const Point& point : read.book.points) {
    const Pose pose = point.target.is_pose ? point.target.pose : model.arm.forward(point.target.joints);
    const Vec3 place = 1000 * pose.position;
    points[point.name] = {place.x(), place.y(), place.z()};
  }
  return points;
}

// What holds at the start does not begin there; a statement, a job and a text do.
bool is_state(const std::string& trigger) {
  return trigger == "no question" || (trigger.find(" = ") != std::string::npos && !trigger.starts_with("at ") &&
                                      !trigger.starts_with("message ") && !trigger.starts_with("question "));
}

bool holds(const TopicSample& sample, const std::string& trigger) {
  const auto rest = [&](const char* word) {
    const std::string begin = std::string(word) + " ";
    return trigger.starts_with(begin) ? trigger.substr(begin.size()) : std::string();
  };
  if (const std::string text = rest("at"); !text.empty()) {
    return sample.statement == text;
  }
  if (const std::string text = rest("job"); !text.empty()) {
    return sample.called == text;
  }
  if (const std::string text = rest("message"); !text.empty()) {
    return sample.message == text;
  }
  if (const std::string text = rest("question"); !text.empty()) {
    return sample.question == text;
  }
  if (trigger == "no question") {
    return sample.question.empty();
  }
  const std::size_t equals = trigger.find(" = ");
  const auto value = sample.values.find(trigger.substr(0, equals));
  return equals != std::string::npos && value != sample.values.end() &&
         value->second == std::stod(trigger.substr(equals + 3));
}

// The first sample of a standstill, which may be shorter than a period.
bool is_rest(const std::vector<TopicSample>& samples, std::size_t i) {
  const auto speed = [&](std::size_t k) { return samples[k].speed < 0.5 ? 0 : samples[k].speed; };
  constexpr double kSlow = 3;     // mm/s
  constexpr double kSame = 1e-6;  // mm/s, more than rounding errors
  return speed(i) < kSlow && (i == 0 || speed(i - 1) > speed(i) + kSame) &&
         (i + 1 == samples.size() || speed(i + 1) >= speed(i) - kSame);
}

// The way from where the arm happened to be is no part of the task.
void start_at_first_point(std::vector<TopicSample>& samples) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (is_rest(samples, i)) {
      samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
  }
  const double begun = samples.front().time;
  for (TopicSample& sample : samples) {
    sample.time -= begun;
  }
}

// When the robot comes to rest after an interrupt, the last line of its job is reported for one period.
void drop_short_calls(std::vector<TopicSample>& samples) {
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (samples[i].called != samples[i - 1].called && samples[i].called != samples[i + 1].called) {
      samples[i].called = samples[i - 1].called;
      samples[i].statement = samples[i - 1].statement;
    }
  }
}

// Points that the robot does not come near, since they are out of its reach.
void drop_far_points(TopicTrace& trace) {
  constexpr double kFar = 150;  // mm
  std::erase_if(trace.points, [&](const auto& point) {
    return std::none_of(trace.samples.begin(), trace.samples.end(), [&](const TopicSample& sample) {
      return std::hypot(sample.tip[0] - point.second[0], sample.tip[1] - point.second[1],
                        sample.tip[2] - point.second[2]) < kFar;
    });
  });
}

}  // namespace

int TopicTrace::begin(const std::string& trigger, int nth) const {
  if (trigger == "rest") {
    const std::vector<std::size_t> found = rests();
    return static_cast<std::size_t>(nth) > found.size() ? -1
                                                        : static_cast<int>(found[static_cast<std::size_t>(nth) - 1]);
  }
  bool before = is_state(trigger) && holds(samples.front(), trigger);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool now = holds(samples[i], trigger);
    if (now && !before && --nth == 0) {
      return static_cast<int>(i);
    }
    before = now;
  }
  return -1;
}

std::vector<std::size_t> TopicTrace::edges(const std::string& signal, bool on) const {
  std::vector<std::size_t> found;
  bool before = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool now = samples[i].values.at(signal) != 0;
    if (now != before && now == on) {
      found.push_back(i);
    }
    before = now;
  }
  return found;
}

std::vector<std::size_t> TopicTrace::rests() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_rest(samples, i)) {
      found.push_back(i);
    }
  }
  return found;
}

TopicTrace trace_of(const Topic& topic, const std::vector<std::string>& signals) {
  std::map<std::string, std::vector<std::string>> lines{{"main", lines_of(topic_text(topic.name))}};
  for (const std::string& other : topic.others) {
    lines[other] = lines_of(topic_text(other));
  }
  TopicTrace trace;
  trace.points = points_of(topic);
  TopicRun run(topic);
  const Outputs& out = run.cell().out;
  const auto take = [&] {
    TopicSample sample;
    sample.time = TopicRun::kPeriod * static_cast<double>(trace.samples.size());
    sample.tip = out.position;
    sample.speed = out.tool_speed;
    sample.axis = out.command[0];
    sample.called = *out.job.called == '\0' ? "main" : out.job.called;
    if (const auto text = lines.find(sample.called); text != lines.end() && out.job.line > 0) {
      sample.statement = text->second.at(out.job.line - 1);
    }
    sample.message = out.job.message;
    sample.question = out.job.question.number != 0 ? out.job.question.text : "";
    for (const std::string& signal : signals) {
      sample.values[signal] = run.value(signal);
    }
    trace.samples.push_back(sample);
    return true;
  };
  if (!run.run(take) || out.job.state != JobState::Ended) {
    throw std::runtime_error(std::string(topic.name) + " does not end: " + out.job.message);
  }
  for (int i = 0; i < 10; ++i) {
    run.step();
    take();
  }
  start_at_first_point(trace.samples);
  drop_short_calls(trace.samples);
  drop_far_points(trace);
  return trace;
}

}  // namespace indurop::robot
