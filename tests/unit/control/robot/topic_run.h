// SPDX-License-Identifier: Apache-2.0
// Runs the jobs of topics/*.job with what the cell around the robot does in each of them: for their tests, and for the
// pictures in docs/robot.

#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "group_cell.h"

namespace indurop::robot {

struct Topic {
  const char* name;
  std::vector<std::string> others;  // jobs that it calls
  double wanted;                    // in OUT, at the end
  double within;
  const char* arm = "";  // a file of arms/, otherwise the arm of the cell
};

const std::vector<Topic>& topics();
// The text of topics/NAME.job; empty if there is none.
std::string topic_text(const std::string& name);
std::string topic_urdf(const Topic& topic);

class TopicRun {
 public:
  static constexpr double kPeriod = 0.01;  // s

  explicit TopicRun(const Topic& topic);
  // Runs the job and calls `each` after each period. Returns true when the job has ended, false if `each` does or if
  // it takes more than 200 s.
  [[nodiscard]] bool run(const std::function<bool()>& each);
  // Another period, after the end of the job.
  void step();
  [[nodiscard]] const Cell& cell() const noexcept { return cell_; }
  // A shared variable of the job; 0 if the job has no such variable.
  [[nodiscard]] double value(const std::string& name) const;

 private:
  void react();
  void answer();
  void set(const char* name, double value);

  std::string topic_;
  Cell cell_;
  std::map<std::string, double*> values_;
  int period_ = 0;
  std::uint32_t question_ = 0;  // the one that is open, and the period in which it was asked
  int asked_ = 0;
  int door_ = 0;  // periods that the door of the machine has moved to its open end
};

}  // namespace indurop::robot
