// SPDX-License-Identifier: Apache-2.0
// Expressions of jobs, by precedence: OR, AND, NOT, comparison, sum, product, sign and function.

#pragma once

#include <string_view>
#include <vector>

#include "control/robot/job/draft.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

class PlaceFormulaReader;

class ExpressionReader {
 public:
  ExpressionReader(JobLine& line, JobDraft& draft) : line_(line), draft_(draft) {}

  // Reads places by `places`, before the first expression is read.
  void use(PlaceFormulaReader& places) noexcept { places_ = &places; }

  // Reads an expression. Returns the index of its formula in the book.
  int read(const char* what) { return draft_.keep(formula(what)); }
  // Reads an expression that is not kept in the book yet.
  Formula formula(const char* what);
  // Reads `count` expressions with commas between them. `example`: how to write them.
  std::vector<Formula> list(int count, const char* what, const char* example);
  enum class Use { Read, Set };
  // Reads the name of a shared variable. Returns its index in the book.
  int signal(const char* what, Use use);

  // A variable of the job, or an element of an array of it.
  struct Place {
    int variable = -1;  // for an element: the first one of its array
    int size = 0;       // of the array; 0: no element with a computed number
    Formula element{};  // its number
  };
  // Returns whether the line continues with a variable of the job.
  [[nodiscard]] bool at_variable() const;
  // Reads such a variable.
  Place place();
  // Declares a variable of the job. Returns its index; -1 if the name is not possible.
  int declare(const JobToken& name);
  // Declares an array of the job, "a[10]". Returns its first index; -1 if that is not possible.
  int declare_array(const JobToken& name, int& size);

 private:
  static bool is_reserved(std::string_view word) noexcept;
  Formula disjunction(const char* what, int depth);
  Formula conjunction(const char* what, int depth);
  Formula negation(const char* what, int depth);
  Formula comparison(const char* what, int depth);
  Formula sum(const char* what, int depth);
  Formula product(const char* what, int depth);
  Formula operand(const char* what, int depth);
  Formula in_brackets(int depth);
  Formula function(int depth);
  Formula coordinate(Coordinate which);
  Formula named(int depth);
  Place place(int depth);

  JobLine& line_;
  JobDraft& draft_;
  PlaceFormulaReader* places_ = nullptr;
};

}  // namespace indurop::robot
