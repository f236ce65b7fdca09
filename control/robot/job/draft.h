// SPDX-License-Identifier: Apache-2.0
// The job that is being read, the last one of its book.

#pragma once

#include <cstddef>
#include <string_view>

#include "control/robot/job/job.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

class JobDraft {
 public:
  JobDraft(JobBook& book, const JobLine& line) : book_(book), line_(line) {}

  void begin(const JobFile& file);
  [[nodiscard]] JobBook& book() const noexcept { return book_; }
  [[nodiscard]] Job& job() const { return book_.jobs.back(); }
  [[nodiscard]] std::size_t index() const { return book_.jobs.size() - 1; }

  // Adds a step of the present line.
  Step& add(Op op);
  [[nodiscard]] Step& last() const { return job().steps.back(); }
  [[nodiscard]] Step& step(std::size_t index) const { return job().steps[index]; }
  // Returns the index of the step that is added next.
  [[nodiscard]] std::size_t next() const { return job().steps.size(); }

  // Returns the index of the formula in the book.
  int keep(Formula formula) const;
  // Returns the index of a variable of the job; -1: there is none.
  [[nodiscard]] int variable_called(std::string_view name) const noexcept;

 private:
  JobBook& book_;
  const JobLine& line_;
};

}  // namespace indurop::robot
