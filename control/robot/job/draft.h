// SPDX-License-Identifier: Apache-2.0
// The job that is being read, the last one of its book.

#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

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
  // Returns the value of an expression of numbers; none: it depends on anything else.
  [[nodiscard]] std::optional<double> constant(int formula) const;
  // Returns whether a condition is 0 whatever happens.
  [[nodiscard]] bool is_never(int formula) const { return constant(formula) == 0.0; }
  // Keeps formulas next to each other. Returns the index of the first one; -1 if there are none.
  int keep(std::vector<Formula> formulas) const;
  // Returns the index in the book of the shared variable that `name` reads, or sets. Keeps the first place of each use.
  int signal(const JobToken& name, bool set) const;
  // Adds a variable of the job that has no name, or the elements of an array after its first one.
  int add_hidden(std::size_t count = 1) const;
  // Returns the index of a variable of the job, for an array that of its first element; -1: there is none.
  [[nodiscard]] int variable_called(std::string_view name) const noexcept;
  // Returns the size of the array that begins at this variable; 0: it is none.
  [[nodiscard]] int array_at(int variable) const noexcept;

 private:
  JobBook& book_;
  const JobLine& line_;
};

}  // namespace indurop::robot
