// SPDX-License-Identifier: Apache-2.0
// Which differences between two versions of a module their user accepts: "O* == 0, joint < 0.01".

#pragma once

#include <indurop/result.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"

namespace indurop::tools {

class AcceptedDifferences {
 public:
  // No rule: nothing may differ.
  AcceptedDifferences() = default;
  // Rules are a variable or glob, one of == < <=, and a number >= 0 or inf; commas separate them. Errors: the text says
  // which rule is wrong and how to write it.
  static Result<AcceptedDifferences, base::Problem> parse(std::string_view text);

  // Returns true if some rule is for this variable, and all that are accept a difference that is as large. Infinite: it
  // is not known, or no number.
  [[nodiscard]] bool accept(std::string_view variable, double largest) const;
  // Rules for none of these variables, as they were written.
  [[nodiscard]] std::vector<std::string> unmatched(const std::vector<std::string>& variables) const;

 private:
  struct Rule {
    std::string text;
    std::string pattern;
    schema::Comparison comparison = schema::Comparison::Equal;
    double limit = 0;
  };
  static Result<Rule, base::Problem> parse_rule(std::string_view text);
  std::vector<Rule> rules_;
};

}  // namespace indurop::tools
