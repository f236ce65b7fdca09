// SPDX-License-Identifier: Apache-2.0
// Checks the statements of the body of a POU.

#pragma once

#include <map>
#include <vector>

#include "control/plc/check/expression_checker.h"

namespace indurop::plc {

class StatementChecker {
 public:
  explicit StatementChecker(Context& context) : context_(context), expressions_(context) {}

  // Checks the whole body, including labels and jumps.
  void body(ast::Body& body);

 private:
  void list(ast::Body& body);
  void statement(ast::Statement& one);
  void bind(ast::Statement& one);
  void attempt(ast::Statement& one);
  void assign(ast::Statement& one);
  void copy_instance(ast::Statement& one, const Type& to);
  bool infer(ast::Statement& one);
  bool action_with_values(ast::Statement& one);
  void warn_about_endless(const ast::Statement& one);
  void condition(ast::Expression& expression);
  void if_statement(ast::Statement& one);
  void case_statement(ast::Statement& one);
  void case_label(ast::CaseLabel& label, const Type& type);
  void for_statement(ast::Statement& one);
  void collect_labels(ast::Body& body, bool outermost);

  struct Used {
    Integer low = 0;
    Integer high = 0;
    Place at;
  };
  Context& context_;
  ExpressionChecker expressions_;
  std::map<Integer, Used> used_;  // values of the CASE being checked, by the first value of each range
  int loops_ = 0;
};

}  // namespace indurop::plc
