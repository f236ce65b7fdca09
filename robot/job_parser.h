// SPDX-License-Identifier: Apache-2.0
// The parser of one job file: points and motion in job_parser.cpp, the rest in job_flow.cpp. Names of points, jobs and
// labels are noted with their places and resolved when all files have been read.

#pragma once

#include <map>

#include "base/diagnostics.h"
#include "robot/job.h"
#include "robot/job_text.h"

namespace indurop::robot {

// A name used before it is known.
struct JobReference {
  enum class To { Target, Mid, Job, Label };
  To to = To::Target;
  std::size_t job = 0;
  std::size_t step = 0;
  std::string name;
  std::size_t line = 0;
  std::size_t column = 0;
};

struct JobLabel {
  std::size_t step = 0;
  std::size_t line = 0;
};

class JobParser {
 public:
  JobParser(JobBook& book, base::Diagnostics& errors, const ArmShape& shape)
      : book_(book), errors_(errors), shape_(shape) {}

  // Reads one file as the next job of the book.
  void read(const JobFile& file);
  // Once all files have been read.
  void resolve();

 private:
  void statement();
  void point();
  bool numbers(int count, double* to, const char* what);
  void joint_point(Target& target);
  void pose_point(Target& target);
  void posture(Target& target);
  void held_axis(Target& target);
  [[nodiscard]] double axis_value(int axis, double written) const noexcept;
  void move(Move kind);
  void spline();
  void speed();
  void zone();
  void set();
  void wait();
  void jump(Op op);
  void if_goto();
  void label();
  void loop();
  void end_loop();
  void condition(Step& step, int& index);
  bool duration(double& seconds);
  int signal(const char* what);
  void reference(JobReference::To to, const char* what);
  void expect_end();

  [[nodiscard]] const JobToken& peek() const { return tokens_[at_]; }
  JobToken take() { return tokens_[at_].kind == JobToken::Kind::End ? tokens_[at_] : tokens_[at_++]; }
  bool accept(std::string_view word);
  void error(const JobToken& at, const std::string& text);
  void error_in(const std::string& file, std::size_t line, std::size_t column, const std::string& text);
  Step& add(Op op);
  [[nodiscard]] Job& job() { return book_.jobs.back(); }
  [[nodiscard]] static std::string shown(const JobToken& token);

  JobBook& book_;
  base::Diagnostics& errors_;
  const ArmShape shape_;
  std::vector<JobToken> tokens_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  bool failed_ = false;  // one message per line is enough
  std::vector<std::size_t> loops_;
  std::vector<JobReference> references_;
  std::vector<std::map<std::string, JobLabel, std::less<>>> labels_;  // of each job
  std::map<std::string, std::string, std::less<>> point_places_;
};

}  // namespace indurop::robot
