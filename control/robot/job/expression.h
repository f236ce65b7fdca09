// SPDX-License-Identifier: Apache-2.0
// Expressions of jobs, by precedence: OR, AND, NOT, comparison, sum, product, sign.

#pragma once

#include <string_view>

#include "control/robot/job/draft.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

class ExpressionReader {
 public:
  ExpressionReader(JobLine& line, JobDraft& draft) : line_(line), draft_(draft) {}

  // Reads an expression. Returns the index of its formula in the book.
  int read(const char* what);
  // Reads the name of a shared variable. Returns its index in the book.
  int signal(const char* what);
  // Declares a variable of the job. Returns its index; -1 if the name is not possible.
  int declare(const JobToken& name);

 private:
  static bool is_reserved(std::string_view word) noexcept;
  Formula disjunction(const char* what, int depth);
  Formula conjunction(const char* what, int depth);
  Formula negation(const char* what, int depth);
  Formula comparison(const char* what, int depth);
  Formula sum(const char* what, int depth);
  Formula product(const char* what, int depth);
  Formula operand(const char* what, int depth);
  Formula named();

  JobLine& line_;
  JobDraft& draft_;
};

}  // namespace indurop::robot
