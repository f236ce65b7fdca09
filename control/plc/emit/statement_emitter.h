// SPDX-License-Identifier: Apache-2.0
// Emits checked statements as C++.

#pragma once

#include <span>
#include <string>

#include "control/plc/emit/expression_emitter.h"
#include "control/plc/emit/probes.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

class StatementEmitter {
 public:
  StatementEmitter(const Pou& pou, TextWriter& out, const Probes& probes)
      : pou_(pou), out_(out), probes_(probes), expressions_(pou) {}

  void list(std::span<const ast::Statement> body);

  // Returns whether a debugger can stop at the statement.
  static bool is_line(const ast::Statement& one) noexcept;

 private:
  std::size_t flow(std::span<const ast::Statement> body);
  void tell_line(const ast::Statement& one);
  // Returns `condition` with counters for its outcome.
  [[nodiscard]] std::string counted(CoverageTable::Kind kind, const Place& at, std::string condition) const;
  void statement(const ast::Statement& one);
  void assign(const ast::Statement& one);
  void call(const ast::Expression& call);
  void block_call(const ast::Expression& call);
  void if_statement(const ast::Statement& one);
  void case_statement(const ast::Statement& one);
  void for_statement(const ast::Statement& one);
  void counted_loop(const ast::Statement& one, std::int64_t step);
  void general_loop(const ast::Statement& one);
  void leave(const ast::Statement& one, const std::string& how);
  void comment(const std::string& text);
  [[nodiscard]] std::string condition(const ast::Expression& expression) const;
  // Emits `body` so that it runs only if EN of the call is true, and sets ENO.
  template <class Body>
  void enabled(const ast::Expression& call, Body body);

  const Pou& pou_;
  TextWriter& out_;
  Probes probes_;
  ExpressionEmitter expressions_;
  int loops_ = 0;  // numbers the helper variables of loops
};

}  // namespace indurop::plc
