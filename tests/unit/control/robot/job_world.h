// SPDX-License-Identifier: Apache-2.0
// Shared variables and a robot for jobs, which follow commands at once.

#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/job/runner.h"

namespace indurop::robot {

class World final : public Signals, public MotionPort {
 public:
  explicit World(const std::vector<std::string>& names) : names_(names) {}
  double read(std::size_t index) noexcept override { return values[names_[index]]; }
  void write(std::size_t index, double value) noexcept override {
    values[names_[index]] = value;
    written.emplace_back(names_[index], value);
  }
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return at_rest; }
  Fault move(const MoveCommand&) noexcept override {
    ++moves;
    return {};
  }
  std::map<std::string, double> values;
  std::vector<std::pair<std::string, double>> written;
  int moves = 0;
  bool at_rest = true;

 private:
  const std::vector<std::string>& names_;
};

struct Ended {
  JobState state = JobState::Idle;
  std::uint32_t line = 0;
  std::string message;
};

// Runs it to its end, at most `periods`.
inline Ended run(const JobBook& book, World& world, int periods = 20'000) {
  JobRunner sut(book);
  sut.start(0);
  for (int i = 0; i < periods && sut.running(); ++i) {
    sut.step(0.001, world, world);
  }
  const JobReport report = sut.report();
  return {report.state, report.line, report.message};
}

}  // namespace indurop::robot
