// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/statement_parser.h"

#include <algorithm>
#include <iterator>

#include "control/plc/library/hidden.h"
#include "control/plc/model/make.h"
#include "control/plc/st/c_code.h"

namespace indurop::plc::st {
namespace {

constexpr int kMaxNesting = 64;  // nesting of statements

bool has_call(const ast::Expression& expression) {
  return expression.kind == ast::Expression::Kind::Call ||
         std::any_of(expression.operands.begin(), expression.operands.end(), has_call);
}

}  // namespace

ast::Body StatementParser::list(std::initializer_list<std::string_view> ends) {
  ast::Body out;
  while (!in_.at_end() && !in_.next_is(ends)) {
    if (ends.size() > 0 && *ends.begin() == "END_CASE" && at_case_label()) {
      break;
    }
    const std::size_t from = in_.position();
    if (in_.accept(";")) {
      continue;
    }
    if (in_.peek().kind == TokenKind::CCode) {
      if (auto known = c_code()) {
        out.push_back(std::move(*known));
      }
      continue;
    }
    if (TokenReader::is_end_word(in_.peek())) {
      break;  // the end of a surrounding construct: its parser reports missing words
    }
    before_.clear();
    if (auto one = statement()) {
      std::move(before_.begin(), before_.end(), std::back_inserter(out));
      out.push_back(std::move(*one));
    } else {
      recover(from);
    }
    before_.clear();
  }
  return out;
}

// Returns the statement that C code represents; none if it is not supported, which is recorded.
std::optional<ast::Statement> StatementParser::c_code() {
  const Place at = in_.here();
  const auto base = time_base(in_.take().text);
  if (!base) {
    c_code_ = c_code_ ? c_code_ : at;
    return std::nullopt;
  }
  const std::string_view ticks = base->unit_ns == 1 ? kTicksNs : base->unit_ns == 1000 ? kTicksUs : kTicksMs;
  return make::assign(make::name(at, base->variable), make::call(at, make::name(at, std::string(ticks)), {}));
}

// Skips to the position after the next ';', or before a word that ends a surrounding statement.
void StatementParser::recover(std::size_t from) {
  while (!in_.at_end() && !TokenReader::is_end_word(in_.peek())) {
    if (in_.position() > from && in_.next_is({"ELSE", "ELSIF", "UNTIL", "IF", "FOR", "WHILE", "REPEAT", "CASE"})) {
      return;
    }
    if (in_.take().is(";")) {
      return;
    }
  }
}

std::optional<ast::Statement> StatementParser::statement() {
  Statement out;
  const Token& first = in_.peek();
  out.at = in_.place(first);
  if (first.comment_line > 0 && (in_.position() == 0 || first.comment_line > in_.previous().line)) {
    out.comment = first.comment;
  }
  if (++depth_ > kMaxNesting) {
    in_.error(first, fmt::format("more than {} statements inside each other, use a function block", kMaxNesting));
    --depth_;
    return std::nullopt;
  }
  const bool ok = fill(out);
  --depth_;
  return ok ? std::optional(std::move(out)) : std::nullopt;
}

// The ';' after END_IF and the like is skipped by list(): CODESYS and TwinCAT omit it.
bool StatementParser::fill(Statement& out) {
  if (in_.accept("IF")) {
    return if_statement(out);
  }
  if (in_.accept("CASE")) {
    return case_statement(out);
  }
  if (in_.accept("FOR")) {
    return for_statement(out);
  }
  if (in_.accept("WHILE")) {
    return while_statement(out);
  }
  if (in_.accept("REPEAT")) {
    return repeat_statement(out);
  }
  if (in_.peek().is("__TRY")) {
    in_.unsupported(in_.peek(),
                    "__TRY is not supported: a fault is a C++ exception, which takes memory when it is thrown, so no "
                    "scan goes on after one; check divisors, indices and pointers before they are used");
    in_.skip_behind("__ENDTRY");
    return true;
  }
  if (in_.accept("EXIT")) {
    out.kind = Statement::Kind::Exit;
    return in_.expect_end("after EXIT");
  }
  if (in_.accept("CONTINUE")) {
    out.kind = Statement::Kind::Continue;
    return in_.expect_end("after CONTINUE");
  }
  if (in_.accept("RETURN")) {
    out.kind = Statement::Kind::Return;
    return in_.expect_end("after RETURN");
  }
  if (in_.accept("JMP")) {
    out.kind = Statement::Kind::Jump;
    if (!in_.expect_name("a label")) {
      return false;
    }
    out.label = in_.take().text;
    return in_.expect_end("after the label");
  }
  return simple(out);
}

// label: / name(arguments); / name := value; / name := other := value; / name S= value;
bool StatementParser::simple(Statement& out) {
  const Token& first = in_.peek();
  if (first.kind == TokenKind::Word && !is_keyword(first.text) && in_.peek(1).is(":")) {
    out.kind = Statement::Kind::Label;
    out.label = in_.take().text;
    in_.take();
    return true;
  }
  if ((first.kind != TokenKind::Word || is_keyword(first.text)) && first.kind != TokenKind::Address) {
    in_.error(first, fmt::format("expected a statement, found {}", TokenReader::spelled(first)));
    return false;
  }
  auto target = expressions_.designator();
  if (!target) {
    return false;
  }
  if (target->kind == ast::Expression::Kind::Call) {
    out.kind = Statement::Kind::Call;
    out.value = std::move(target);
    return in_.expect_end("after the call");
  }
  if (in_.peek().is("=")) {
    in_.error(in_.peek(), "'=' compares, write ':=' to assign");
    return false;
  }
  if (in_.next_is({"S", "R"}) && in_.peek(1).is("=")) {
    return set_or_reset(std::move(*target), out);
  }
  if (in_.peek().is("REF") && in_.peek(1).is("=")) {
    in_.take();
    in_.take();
    out.kind = Statement::Kind::Assign;
    out.binds = true;
    out.target = std::move(target);
    out.value = expressions_.expression();
    return out.value && in_.expect_end("after the variable");
  }
  if (in_.accept("?=")) {
    out.kind = Statement::Kind::Assign;
    out.attempts = true;
    out.target = std::move(target);
    out.value = expressions_.expression();
    return out.value && in_.expect_end("after the variable");
  }
  const bool can_be_property =
      target->kind == ast::Expression::Kind::Name || target->kind == ast::Expression::Kind::Member;
  if (can_be_property && in_.accept(";")) {
    std::vector<ast::Argument> read_alone(1);  // x.Speed; is a call without brackets
    out.kind = Statement::Kind::Call;
    const Place at = target->at;
    out.value = make::call(at, std::move(*target), std::move(read_alone));
    return true;
  }
  if (!in_.accept(":=")) {
    in_.missing("expected ':=' or '('");
    return false;
  }
  return assignment(std::move(*target), out);
}

// lamp S= button; is IF button THEN lamp := TRUE; END_IF;
bool StatementParser::set_or_reset(ast::Expression target, Statement& out) {
  const bool set = in_.take().is("S");
  in_.take();
  auto value = expressions_.expression();
  if (!value) {
    return false;
  }
  ast::Body body;
  body.push_back(make::assign(std::move(target), make::truth(out.at, set)));
  Statement made = make::when(std::move(*value), std::move(body));
  made.at = out.at;
  made.comment = std::move(out.comment);
  out = std::move(made);
  return in_.expect_end("after the value");
}

// a := b := c; is b := c; a := b;
bool StatementParser::assignment(ast::Expression target, Statement& out) {
  std::vector<ast::Expression> targets;
  targets.push_back(std::move(target));
  auto value = expressions_.expression();
  while (value && in_.accept(":=")) {
    targets.push_back(std::move(*value));
    value = expressions_.expression();
  }
  if (!value) {
    return false;
  }
  for (std::size_t i = targets.size() - 1; i > 0; --i) {
    if (has_call(targets[i])) {  // it would run twice
      in_.error(targets[i].at, "a call in the middle of an assignment of several variables, write one for each");
      return false;
    }
    Statement inner = make::assign(targets[i], std::move(*value));
    inner.at = out.at;
    before_.push_back(std::move(inner));
    value = std::move(targets[i]);
  }
  out.kind = Statement::Kind::Assign;
  out.target = std::move(targets.front());
  out.value = std::move(value);
  return in_.expect_end("after the value");
}

bool StatementParser::if_statement(Statement& out) {
  out.kind = Statement::Kind::If;
  bool more = true;
  while (more) {
    ast::Branch branch;
    branch.at = in_.here();
    branch.condition = expressions_.expression();
    if (!branch.condition || !in_.expect("THEN", "after the condition")) {
      skip_header("THEN");
    }
    branch.body = list({"ELSIF", "ELSE", "END_IF"});
    out.branches.push_back(std::move(branch));
    more = in_.accept("ELSIF");
  }
  if (in_.peek().is("ELSE")) {
    ast::Branch branch;
    branch.at = in_.place(in_.take());
    branch.body = list({"END_IF"});
    out.branches.push_back(std::move(branch));
  }
  return in_.expect("END_IF", fmt::format("to close the IF of line {}", out.at.line));
}

bool StatementParser::case_statement(Statement& out) {
  out.kind = Statement::Kind::Case;
  out.value = expressions_.expression();
  if (!out.value || !in_.expect("OF", "after the value")) {
    return false;
  }
  while (!in_.next_is({"ELSE", "END_CASE"}) && !in_.at_end() && !TokenReader::is_end_word(in_.peek())) {
    if (!case_branch(out)) {
      return false;
    }
  }
  if (in_.peek().is("ELSE")) {
    ast::Branch branch;
    branch.at = in_.place(in_.take());
    branch.body = list({"END_CASE"});
    out.branches.push_back(std::move(branch));
  }
  return in_.expect("END_CASE", fmt::format("to close the CASE of line {}", out.at.line));
}

bool StatementParser::case_branch(Statement& out) {
  ast::Branch branch;
  branch.at = in_.here();
  if (!labels(branch)) {
    return false;
  }
  branch.body = list({"END_CASE", "ELSE"});
  out.branches.push_back(std::move(branch));
  return true;
}

bool StatementParser::labels(ast::Branch& out) {
  do {
    auto low = expressions_.expression();
    if (!low) {
      return false;
    }
    ast::CaseLabel label{std::move(*low), std::nullopt};
    if (in_.accept("..")) {
      label.high = expressions_.expression();
      if (!label.high) {
        return false;
      }
    }
    out.labels.push_back(std::move(label));
  } while (in_.accept(","));
  return in_.expect(":", "after the values of this case");
}

// Returns whether values and a ':' are next, not a statement: a statement has a ':=' or ends before the ':'.
bool StatementParser::at_case_label() const {
  int depth = 0;
  for (std::size_t ahead = 0;; ++ahead) {
    const Token& token = in_.peek(ahead);
    const bool word = token.kind == TokenKind::Word && is_keyword(token.text) && !token.is("AND") && !token.is("OR") &&
                      !token.is("XOR") && !token.is("MOD") && !token.is("NOT") && !token.is("TRUE") &&
                      !token.is("FALSE");
    if (token.kind == TokenKind::End || token.is(";") || word || (depth == 0 && (token.is(":=") || token.is("=>")))) {
      return false;
    }
    if (depth == 0 && token.is(":")) {
      return ahead > 0;
    }
    depth += token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
  }
}

}  // namespace indurop::plc::st
