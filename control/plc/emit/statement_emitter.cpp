// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/statement_emitter.h"

#include <fmt/format.h>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/lifetime.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/in_outs.h"
#include "control/plc/emit/loop_check.h"
#include "control/plc/lower/flow.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Statement;

const Type& boolean() {
  static const Type kType = [] {
    Type made;
    made.elementary = Elementary::Bool;
    return made;
  }();
  return kType;
}

// Returns the number of a statement of the running view: 3 for _flow[3] := ...
std::optional<std::uint64_t> flow_point(const Statement& one) {
  if (one.kind != Statement::Kind::Assign || one.target->kind != Expression::Kind::Index) {
    return std::nullopt;
  }
  const Expression& array = one.target->operands[0];
  const bool made = array.resolved && array.resolved->variable != nullptr && array.resolved->variable->declared->made;
  return made && lower::is_flow(array.name) ? std::optional(std::get<std::uint64_t>(one.target->operands[1].value))
                                            : std::nullopt;
}

bool is_coil(const Place& at) {
  return at.within && at.within->find(", coil ") != std::string::npos;
}

Type without_range(const Type& type) {
  Type plain = type;
  plain.range.reset();
  return plain;
}

}  // namespace

void StatementEmitter::list(std::span<const Statement> body) {
  for (std::size_t i = 0; i < body.size();) {
    if (const std::size_t emitted = flow(body.subspan(i)); emitted > 0) {
      i += emitted;
      continue;
    }
    const Statement& one = body[i++];
    comment(one.comment);
    tell_line(one);
    statement(one);
  }
}

// Emits all reports of power in a network at once: thousands of single assignments would take g++ longer than the rest.
std::size_t StatementEmitter::flow(std::span<const Statement> body) {
  const std::optional<std::uint64_t> first = flow_point(body[0]);
  if (!first) {
    return 0;
  }
  std::string row;
  std::size_t points = 0;
  while (points < body.size() && flow_point(body[points]) == *first + points) {
    row += (points > 0 ? ", " : "") + condition(*body[points].value);
    ++points;
  }
  out_.line(fmt::format("iec::put_flow({}.data() + {}, {});", expressions_.variable(body[0].target->operands[0]),
                        *first, row));
  return points;
}

bool StatementEmitter::is_line(const Statement& one) noexcept {
  return one.kind != Statement::Kind::Empty && one.kind != Statement::Kind::Label;
}

void StatementEmitter::tell_line(const Statement& one) {
  if (!is_line(one)) {
    return;
  }
  if (probes_.debug != nullptr) {
    out_.line(fmt::format("debugger.line({});", probes_.debug->lines.size()));
    probes_.debug->lines.push_back({one.at, &pou_});
  }
  if (probes_.coverage != nullptr && one.at.file) {
    out_.line(fmt::format("::plc_coverage.hit({});",
                          probes_.coverage->add(CoverageTable::Kind::Statement, one.at, pou_.title())));
  }
}

std::string StatementEmitter::counted(CoverageTable::Kind kind, const Place& at, std::string condition) const {
  if (probes_.coverage == nullptr || !at.file) {
    return condition;
  }
  return fmt::format("::plc_coverage.outcome({}, {})", probes_.coverage->add(kind, at, pou_.title()), condition);
}

void StatementEmitter::comment(const std::string& text) {
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    out_.line("// " + comment_text(text.substr(from, end - from)));
    from = end + 1;
  }
}

std::string StatementEmitter::condition(const Expression& expression) const {
  return expressions_.value(expression, boolean());
}

void StatementEmitter::statement(const Statement& one) {
  switch (one.kind) {
    case Statement::Kind::Empty:
      break;
    case Statement::Kind::Assign:
      assign(one);
      break;
    case Statement::Kind::Call:
      call(*one.value);
      break;
    case Statement::Kind::If:
      if_statement(one);
      break;
    case Statement::Kind::Case:
      case_statement(one);
      break;
    case Statement::Kind::For:
      for_statement(one);
      break;
    case Statement::Kind::While:
      out_.open(fmt::format("while ({})", condition(*one.value)));
      list(one.body);
      out_.close();
      break;
    case Statement::Kind::Repeat:
      out_.open("do");
      list(one.body);
      out_.close(fmt::format(" while (!{});", wrapped(condition(*one.value))));
      break;
    case Statement::Kind::Exit:
      out_.line("break;");
      break;
    case Statement::Kind::Continue:
      out_.line("continue;");
      break;
    case Statement::Kind::Return:
      leave(one, pou_.result != nullptr ? fmt::format("return {};", ExpressionEmitter::result_name(pou_)) : "return;");
      break;
    case Statement::Kind::Label:
      out_.line(fmt::format("label_{}:;", upper(one.label)));
      break;
    case Statement::Kind::Jump:
      leave(one, fmt::format("goto label_{};", upper(one.label)));
      break;
  }
}

void StatementEmitter::leave(const Statement& one, const std::string& how) {
  if (!one.value) {
    out_.line(how);
    return;
  }
  out_.open(fmt::format("if ({})", condition(*one.value)));
  out_.line(how);
  out_.close();
}

template <class Body>
void StatementEmitter::enabled(const Expression& call, Body body) {
  const Resolved& resolved = *call.resolved;
  if (resolved.enable == nullptr && resolved.enable_out == nullptr) {
    body();
    return;
  }
  const std::string flag = resolved.enable != nullptr ? condition(*resolved.enable->value) : "true";
  const std::string name = fmt::format("enabled_{}", ++loops_);
  out_.open("");
  out_.line(fmt::format("const bool {} = {};", name, flag));
  out_.open(fmt::format("if ({})", name));
  body();
  // A POU with its own ENO has set it.
  const bool sets = resolved.enable_out != nullptr && resolved.pou != nullptr && resolved.pou->find("ENO") != nullptr;
  if (sets) {
    out_.reopen("else");
    out_.line(expressions_.assign_output(*resolved.enable_out, "false", boolean()) + ";");
  }
  out_.close();
  if (resolved.enable_out != nullptr && !sets) {
    out_.line(expressions_.assign_output(*resolved.enable_out, name, boolean()) + ";");
  }
  out_.close();
}

void StatementEmitter::assign(const Statement& one) {
  const Type& to = *one.target->type;
  if (to.kind == Type::Kind::Block) {
    const std::string target = expressions_.variable(*one.target);
    out_.line(fmt::format("{} = {};", target, expressions_.variable(*one.value)));
    forget_in_outs(to, target, out_);
    return;
  }
  if (one.attempts) {
    out_.line(fmt::format("iec::attempt({}, {}, {});", expressions_.place(one.at), expressions_.variable(*one.target),
                          expressions_.variable(*one.value)));
    return;
  }
  const auto store = [&] {
    const std::string value = expressions_.value(*one.value, to);
    const bool coil = is_coil(one.target->at) && one.value->kind != Expression::Kind::Literal &&
                      to.kind == Type::Kind::Elementary && to.elementary == Elementary::Bool;
    out_.line(
        expressions_.assign(*one.target, coil ? counted(CoverageTable::Kind::Coil, one.target->at, value) : value) +
        ";");
  };
  if (one.value->kind == Expression::Kind::Call) {
    enabled(*one.value, store);
  } else {
    store();
  }
}

void StatementEmitter::call(const Expression& call) {
  enabled(call, [&] {
    const Expression& callee = call.operands[0];
    if (callee.type != nullptr && callee.type->kind == Type::Kind::Block) {
      block_call(call);
    } else if (call.type == nullptr) {
      out_.line(expressions_.variable(call) + ";");
    } else {
      out_.line(fmt::format("static_cast<void>({});", expressions_.variable(call)));
    }
  });
}

void StatementEmitter::block_call(const Expression& call) {
  const std::string instance = expressions_.variable(call.operands[0]);
  for (const Resolved::Actual& one : call.resolved->actuals) {
    if (one.argument->output) {
      continue;
    }
    const std::string member = one.parameter != nullptr ? cpp_name(std::string_view(one.member)) : one.member;
    const bool by_reference = one.parameter != nullptr && one.parameter->section == ast::Section::InOut;
    if (by_reference && one.type->open) {
      out_.line(fmt::format("{}.{} = {};", instance, member, expressions_.slice(*one.argument->value, *one.type)));
      continue;
    }
    out_.line(by_reference
                  ? fmt::format("{}.{} = &{};", instance, member, expressions_.variable(*one.argument->value))
                  : fmt::format("{}.{} = {};", instance, member, expressions_.value(*one.argument->value, *one.type)));
  }
  out_.line(expressions_.run(call.operands[0], instance) + "(scan);");
  for (const Resolved::Actual& one : call.resolved->actuals) {
    if (one.argument->output) {
      const std::string member = one.parameter != nullptr ? cpp_name(std::string_view(one.member)) : one.member;
      out_.line(expressions_.assign_output(*one.argument, instance + "." + member, *one.type) + ";");
    } else if (one.parameter != nullptr && one.parameter->in_methods && !outlasts_call(*one.argument->value)) {
      out_.line(fmt::format("{}.{} = nullptr;", instance, cpp_name(std::string_view(one.member))));
    }
  }
}

void StatementEmitter::if_statement(const Statement& one) {
  bool first = true;
  // A coil that sets or resets: its statement is counted with its power.
  const bool coil = one.branches.size() == 1 && one.branches[0].body.size() == 1 &&
                    one.branches[0].body[0].kind == Statement::Kind::Assign &&
                    is_coil(one.branches[0].body[0].target->at);
  for (const ast::Branch& branch : one.branches) {
    const Place& at = coil ? branch.body[0].target->at : branch.at;
    const std::string test = branch.condition ? counted(coil ? CoverageTable::Kind::Coil : CoverageTable::Kind::Branch,
                                                        at, condition(*branch.condition))
                                              : std::string();
    if (first) {
      out_.open(fmt::format("if ({})", test));
    } else {
      out_.reopen(branch.condition ? fmt::format("else if ({})", test) : "else");
    }
    first = false;
    if (coil) {
      statement(branch.body[0]);
    } else {
      list(branch.body);
    }
  }
  out_.close();
}

// Not emitted as a switch: EXIT inside of it must end the surrounding loop.
void StatementEmitter::case_statement(const Statement& one) {
  const Type& type = *one.value->type;
  const std::string name = fmt::format("case_{}", ++loops_);
  out_.open("");
  out_.line(fmt::format("const {} {} = {};", cpp_type(type), name, expressions_.value(*one.value)));
  bool first = true;
  for (const ast::Branch& branch : one.branches) {
    std::string text;
    for (const ast::CaseLabel& label : branch.labels) {
      const std::string low = expressions_.value(label.low, type);
      text += text.empty() ? "" : " || ";
      text += label.high ? fmt::format("({0} >= {1} && {0} <= {2})", name, low, expressions_.value(*label.high, type))
                         : fmt::format("{} == {}", name, low);
    }
    const std::string test = branch.labels.empty() ? "else" : fmt::format("{}if ({})", first ? "" : "else ", text);
    if (first) {
      out_.open(branch.labels.empty() ? "" : test);
    } else {
      out_.reopen(test);
    }
    first = false;
    list(branch.body);
  }
  if (!first) {
    out_.close();
  }
  out_.close();
}

void StatementEmitter::for_statement(const Statement& one) {
  const Resolved& resolved = *one.target->resolved;
  const Constant* known = one.by ? constant_of(*one.by) : nullptr;
  const std::int64_t step = !one.by ? 1 : known != nullptr ? as_int64(*known).value_or(0) : 0;
  const bool narrow = bits_of(one.target->type->elementary) < 64;
  const bool plain = resolved.meaning == Resolved::Meaning::Variable && !one.target->type->range &&
                     resolved.variable->section != ast::Section::InOut && !resolved.variable->aliased;
  if (probes_.debug == nullptr && step != 0 && narrow && plain && only_reads(one.body, *resolved.variable)) {
    counted_loop(one, step);
  } else {
    general_loop(one);
  }
}

// The variable is a constant inside the loop: the C++ compiler and the emitter know that it stays within the bounds.
void StatementEmitter::counted_loop(const Statement& one, std::int64_t step) {
  const Variable& variable = *one.target->resolved->variable;
  const Type& type = *one.target->type;
  const std::string name = expressions_.variable(*one.target);
  const std::string counter = fmt::format("counter_{}", ++loops_);
  const std::string end = fmt::format("end_{}", loops_);
  const Constant* first = constant_of(*one.value);
  const Constant* last = constant_of(*one.to);
  out_.open("");
  out_.line(fmt::format("std::int64_t {} = {};", counter, expressions_.value(*one.value, type)));
  out_.line(fmt::format("const std::int64_t {} = {};", end, expressions_.value(*one.to, type)));
  const std::string advance = step == 1 ? "++" + counter : fmt::format("{} += {}", counter, step);
  out_.open(fmt::format("for (; {} {} {}; {})", counter, step > 0 ? "<=" : ">=", end, advance));
  out_.line(fmt::format("const auto {} = static_cast<{}>({});", name, cpp_type(type), counter));
  if (first != nullptr && last != nullptr) {
    const std::int64_t a = *as_int64(*first);
    const std::int64_t b = *as_int64(*last);
    expressions_.index_check().enter_loop(variable, {std::min(a, b), std::max(a, b)});
  }
  list(one.body);
  expressions_.index_check().leave_loop(variable);
  out_.close();
  out_.line(fmt::format("{} = static_cast<{}>({});", name, cpp_type(type), counter));
  out_.close();
}

void StatementEmitter::general_loop(const Statement& one) {
  const Type& type = *one.target->type;
  const std::string name = expressions_.variable(*one.target);
  const std::string loop = fmt::format("loop_{}", ++loops_);
  const std::string begin = fmt::format("begin_{}", loops_);
  const std::string step = one.by ? expressions_.value(*one.by, without_range(type)) : "1";
  out_.open("");
  out_.line(fmt::format("const {} {} = {};", cpp_type(type), begin, expressions_.value(*one.value, type)));
  const std::string range = type.range ? fmt::format(", {}, {}", type.range->low, type.range->high) : "";
  out_.line(fmt::format("iec::Loop<{}> {}{{{}, {}{}}};", cpp_type(type), loop, expressions_.value(*one.to, type), step,
                        range));
  out_.line(fmt::format("{} = {};", name, begin));  // not before: the end may be computed from the variable
  out_.open(fmt::format("for (; {0}.runs({1}); {0}.next({1}))", loop, name));
  list(one.body);
  out_.close();
  out_.close();
}

}  // namespace indurop::plc
