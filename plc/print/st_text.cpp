// SPDX-License-Identifier: Apache-2.0
#include "plc/print/st_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;
using ast::Statement;

struct Spelling {
  Operator op;
  std::string_view text;
  int strength;  // of precedence
};

constexpr std::array<Spelling, 17> kSpellings{{{Operator::Not, "NOT ", 9},
                                               {Operator::Negate, "-", 9},
                                               {Operator::Plus, "+", 9},
                                               {Operator::Power, " ** ", 8},
                                               {Operator::Multiply, " * ", 7},
                                               {Operator::Divide, " / ", 7},
                                               {Operator::Modulo, " MOD ", 7},
                                               {Operator::Add, " + ", 6},
                                               {Operator::Subtract, " - ", 6},
                                               {Operator::Less, " < ", 5},
                                               {Operator::Greater, " > ", 5},
                                               {Operator::LessEqual, " <= ", 5},
                                               {Operator::GreaterEqual, " >= ", 5},
                                               {Operator::Equal, " = ", 4},
                                               {Operator::NotEqual, " <> ", 4},
                                               {Operator::And, " AND ", 3},
                                               {Operator::Xor, " XOR ", 2}}};
constexpr Spelling kOr{Operator::Or, " OR ", 1};

const Spelling& spelling(Operator op) {
  const auto* found = std::find_if(kSpellings.begin(), kSpellings.end(), [&](const Spelling& s) { return s.op == op; });
  return found == kSpellings.end() ? kOr : *found;
}

std::string literal_text(const Expression& expression) {
  if (const bool* truth = std::get_if<bool>(&expression.value)) {
    return *truth ? "TRUE" : "FALSE";
  }
  if (const auto* number = std::get_if<std::uint64_t>(&expression.value)) {
    return std::to_string(*number);
  }
  if (const auto* real = std::get_if<double>(&expression.value)) {
    const std::string text = fmt::format("{}", *real);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  if (const auto* time = std::get_if<std::int64_t>(&expression.value)) {
    constexpr std::int64_t kMillisecondNs = 1'000'000;
    const std::string_view type = name_of(expression.value_type.value_or(Elementary::Time));
    return *time % kMillisecondNs == 0 ? fmt::format("{}#{}ms", type, *time / kMillisecondNs)
                                       : fmt::format("{}#{}ns", type, *time);
  }
  return "'" + std::get<std::string>(expression.value) + "'";
}

std::string text_of(const Expression& expression, int around = 0);

std::string call_text(const Expression& call) {
  std::string text = text_of(call.operands.front()) + "(";
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const ast::Argument& argument = call.arguments[i];
    text += i == 0 ? "" : ", ";
    text += argument.negated ? "NOT " : "";
    text += argument.name.empty() ? "" : argument.name + (argument.output ? " => " : " := ");
    text += argument.value ? text_of(*argument.value) : "";
  }
  return text + ")";
}

std::string index_text(const Expression& expression) {
  std::string text = text_of(expression.operands.front()) + "[";
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    text += (i == 1 ? "" : ", ") + text_of(expression.operands[i]);
  }
  return text + "]";
}

// `around`: how strongly the operator binds that it is an operand of.
std::string text_of(const Expression& expression, int around) {
  switch (expression.kind) {
    case Expression::Kind::Literal:
      return literal_text(expression);
    case Expression::Kind::Name:
      return expression.value_enum.empty() ? expression.name : expression.value_enum + "#" + expression.name;
    case Expression::Kind::Direct:
      return to_string(expression.address);
    case Expression::Kind::Member:
      return text_of(expression.operands.front()) + "." + expression.name;
    case Expression::Kind::Bit:
      if (expression.width > 1) {
        const char size = expression.width == 8 ? 'B' : expression.width == 16 ? 'W' : 'D';
        return fmt::format("{}.%{}{}", text_of(expression.operands.front()), size, expression.bit / expression.width);
      }
      return fmt::format("{}.{}", text_of(expression.operands.front()), expression.bit);
    case Expression::Kind::Index:
      return index_text(expression);
    case Expression::Kind::Deref:
      return text_of(expression.operands.front()) + "^";
    case Expression::Kind::Call:
      return call_text(expression);
    case Expression::Kind::Unary:
    case Expression::Kind::Binary:
      break;
  }
  const Spelling& op = spelling(expression.op);
  const bool unary = expression.kind == Expression::Kind::Unary;
  const std::string text = unary ? std::string(op.text) + text_of(expression.operands[0], op.strength)
                                 : text_of(expression.operands[0], op.strength) + std::string(op.text) +
                                       text_of(expression.operands[1], op.strength + 1);
  return op.strength < around ? "(" + text + ")" : text;
}

class Writer {
 public:
  void list(const ast::Body& body, int depth) {
    for (const Statement& each : body) {
      statement(each, depth);
    }
  }

  std::string take() { return std::move(out_); }

 private:
  void line(int depth, std::string_view text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + std::string(text) + "\n";
  }

  void statement(const Statement& each, int depth) {
    if (!each.comment.empty()) {
      line(depth, "(* " + each.comment + " *)");
    }
    switch (each.kind) {
      case Statement::Kind::Empty:
        break;
      case Statement::Kind::Assign:
        line(depth, text_of(*each.target) + " := " + text_of(*each.value) + ";");
        break;
      case Statement::Kind::Call:
        line(depth, text_of(*each.value) + ";");
        break;
      case Statement::Kind::If:
        branches(each, depth);
        break;
      case Statement::Kind::Label:
        line(depth, each.label + ":");
        break;
      case Statement::Kind::Jump:
      case Statement::Kind::Return: {
        const std::string where = each.kind == Statement::Kind::Jump ? "JMP " + each.label : std::string("RETURN");
        line(depth, each.value ? "IF " + text_of(*each.value) + " THEN " + where + "; END_IF;" : where + ";");
        break;
      }
      case Statement::Kind::Exit:
        line(depth, "EXIT;");
        break;
      case Statement::Kind::Continue:
        line(depth, "CONTINUE;");
        break;
      case Statement::Kind::Case:
      case Statement::Kind::For:
      case Statement::Kind::While:
      case Statement::Kind::Repeat:
        loop(each, depth);
        break;
    }
  }

  void branches(const Statement& each, int depth) {
    bool first = true;
    for (const ast::Branch& branch : each.branches) {
      line(depth,
           branch.condition ? (first ? "IF " : "ELSIF ") + text_of(*branch.condition) + " THEN" : std::string("ELSE"));
      list(branch.body, depth + 1);
      first = false;
    }
    line(depth, "END_IF;");
  }

  void loop(const Statement& each, int depth) {
    switch (each.kind) {
      case Statement::Kind::For:
        line(depth, fmt::format("FOR {} := {} TO {}{} DO", text_of(*each.target), text_of(*each.value),
                                text_of(*each.to), each.by ? " BY " + text_of(*each.by) : ""));
        list(each.body, depth + 1);
        line(depth, "END_FOR;");
        break;
      case Statement::Kind::While:
        line(depth, "WHILE " + text_of(*each.value) + " DO");
        list(each.body, depth + 1);
        line(depth, "END_WHILE;");
        break;
      case Statement::Kind::Repeat:
        line(depth, "REPEAT");
        list(each.body, depth + 1);
        line(depth, "UNTIL " + text_of(*each.value) + " END_REPEAT;");
        break;
      default:
        cases(each, depth);
    }
  }

  void cases(const Statement& each, int depth) {
    line(depth, "CASE " + text_of(*each.value) + " OF");
    for (const ast::Branch& branch : each.branches) {
      std::string labels;
      for (const ast::CaseLabel& label : branch.labels) {
        labels += (labels.empty() ? "" : ", ") + text_of(label.low) + (label.high ? ".." + text_of(*label.high) : "");
      }
      line(depth + 1, labels.empty() ? "ELSE" : labels + ":");
      list(branch.body, depth + 2);
    }
    line(depth, "END_CASE;");
  }

  std::string out_;
};

}  // namespace

std::string st_text(const ast::Pou& pou) {
  Writer writer;
  writer.list(pou.body, 1);
  return pou.name + "\n" + writer.take();
}

}  // namespace indurop::plc
