// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/list.h"

#include <fmt/format.h>

#include <map>

#include "control/plc/lower/accumulator.h"
#include "control/plc/lower/list_operators.h"
#include "control/plc/model/make.h"
#include "control/plc/st/expression_parser.h"
#include "control/plc/st/token_reader.h"

namespace indurop::plc::lower {
namespace {

using ast::Expression;
using ast::Operator;
using st::Token;
using st::TokenKind;

class ListLowering {
 public:
  ListLowering(const std::vector<Token>& tokens, st::TokenReader& in, const Place& origin, std::string prefix,
               const HasInput& has_input, Diagnostics& diagnostics)
      : in_(in),
        designators_(in),
        origin_(origin),
        has_input_(has_input),
        diagnostics_(diagnostics),
        joints_(find_joints(tokens, prefix)),
        accumulator_(std::move(prefix), lowered_) {}

  Lowered run(ListUse use) {
    while (!in_.at_end()) {
      const std::size_t before = in_.position();
      if (!instruction()) {
        skip_line(before);
      }
    }
    if (!open_.empty()) {
      in_.error(open_.back().at, "this '(' is never closed; write ')' on a line of its own");
    }
    if (use == ListUse::Statements) {
      accumulator_.drop();
    }
    lowered_.value = accumulator_.take();
    return std::move(lowered_);
  }

 private:
  struct Open {
    Place at;
    Operator op = Operator::None;
    bool negated = false;
    std::optional<Expression> before;
  };

  void skip_line(std::size_t before) {
    const int line = in_.position() == before ? in_.peek().line : in_.previous().line;
    while (!in_.at_end() && in_.peek().line == line) {
      in_.take();
    }
  }

  // Returns false after an error.
  bool instruction() {
    if (in_.accept(";")) {
      return true;
    }
    if (in_.peek().kind == TokenKind::Word && in_.peek(1).is(":")) {
      label(in_.take());
      in_.take();
      return true;
    }
    if (in_.peek().is(")")) {
      return close();
    }
    if (in_.peek().kind != TokenKind::Word && !in_.peek().is("&")) {
      in_.error(in_.peek(), fmt::format("expected an operator, found {}", st::TokenReader::spelled(in_.peek())));
      return false;
    }
    return operation(in_.take());
  }

  // Where the code after a label uses the loaded value, all paths to it bring it in one variable.
  void label(const Token& word) {
    const Place at = in_.place(word);
    const auto joint = joints_.find(upper(word.text));
    if (joint != joints_.end() && accumulator_.loaded()) {
      accumulator_.bring_to(joint->second);
    }
    accumulator_.drop();
    lowered_.body.push_back(make::label(at, std::string(word.text)));
    accumulator_.clear();
    if (joint != joints_.end()) {
      accumulator_.load_joint(at, joint->second);
    }
  }
  bool operation(const Token& word) {
    if (is_input(word)) {
      return input(word);
    }
    if (word.is("LD") || word.is("LDN")) {
      accumulator_.drop();
      auto value = operand();
      if (value) {
        accumulator_.load(word.is("LDN") ? make::negation(std::move(*value)) : std::move(*value));
      }
      return value.has_value();
    }
    if (word.is("ST") || word.is("STN") || word.is("S") || word.is("R")) {
      return store(word);
    }
    if (word.is("NOT")) {
      if (loaded(word)) {
        accumulator_.combine(make::negation(*accumulator_.take()));
      }
      return accumulator_.loaded();
    }
    if (const auto known = binary_word(word)) {
      return binary(word, known->op, known->negated);
    }
    if (const auto when = conditional(word.text, "JMP")) {
      return jump(word, *when);
    }
    if (const auto when = conditional(word.text, "RET")) {
      return leave(word, {}, *when);
    }
    if (const auto when = conditional(word.text, "CAL")) {
      return call(word, *when);
    }
    return function(word);
  }

  bool loaded(const Token& word) {
    if (!accumulator_.loaded()) {
      in_.error(word,
                fmt::format("nothing is loaded that {} could use; begin with LD", st::TokenReader::spelled(word)));
    }
    return accumulator_.loaded();
  }

  // Returns true for "CU c" with an instance c: it is "CAL c(CU := loaded value)" (Tables 53.3 and 54), also for names
  // that have another meaning before other variables: R, S, LD.
  [[nodiscard]] bool is_input(const Token& word) const {
    const Token& instance = in_.peek();
    return instance.kind == TokenKind::Word && instance.line == word.line && has_input_(instance.text, word.text) &&
           (in_.peek(1).kind == TokenKind::End || in_.peek(1).line != word.line || in_.peek(1).is(";"));
  }
  bool input(const Token& word) {
    const Place at = in_.place(word);
    const std::string instance(in_.take().text);
    if (!loaded(word)) {
      return false;
    }
    std::vector<ast::Argument> arguments;
    arguments.push_back(make::argument(std::string(word.text), use()));
    lowered_.body.push_back(make::call_statement(make::call(at, make::name(at, instance), std::move(arguments))));
    return true;
  }

  const Expression& use() {
    return accumulator_.use(!in_.at_end() && !in_.next_is({"LD", "LDN"}) && !in_.peek(1).is(":"));
  }
  bool store(const Token& word) {
    auto target = designators_.designator();
    if (!target || !loaded(word)) {
      return false;
    }
    const Expression& value = use();
    if (word.is("S") || word.is("R")) {
      ast::Body body;
      body.push_back(make::assign(std::move(*target), make::truth(in_.place(word), word.is("S"))));
      lowered_.body.push_back(make::when(value, std::move(body)));
    } else {
      lowered_.body.push_back(make::assign(std::move(*target), word.is("STN") ? make::negation(value) : value));
    }
    return true;
  }

  // Parses an expression that ends with its line, before a comma or a closing bracket opened before it: the operator of
  // the next line is not part of it.
  std::optional<Expression> operand() {
    std::vector<Token> tokens;
    int depth = 0;
    const int line = in_.peek().line;
    while (!in_.at_end() && in_.peek().line == line) {
      const Token& next = in_.peek();
      depth += next.is("(") || next.is("[") ? 1 : next.is(")") || next.is("]") ? -1 : 0;
      if (depth < 0 || (depth == 0 && (next.is(",") || next.is(";")))) {
        break;
      }
      tokens.push_back(in_.take());
    }
    Token end;
    end.line = line;
    end.column = tokens.empty() ? in_.previous().column : tokens.back().column + 1;
    tokens.push_back(end);
    st::TokenReader reader(tokens, origin_, diagnostics_);
    auto value = st::ExpressionParser(reader).expression();
    if (value && !reader.at_end()) {
      reader.error(reader.peek(),
                   fmt::format("{} is too much here, remove it", st::TokenReader::spelled(reader.peek())));
      return std::nullopt;
    }
    return value;
  }

  // Translates AND x; AND( x ... )
  bool binary(const Token& word, Operator op, bool negated) {
    if (!loaded(word)) {
      return false;
    }
    const bool deferred = in_.peek().is("(") && !closed_on_line();
    if (deferred) {
      in_.take();
      open_.push_back({in_.place(word), op, negated, accumulator_.take()});
      if (in_.peek().line == word.line && !in_.at_end()) {
        auto first = operand();
        if (first) {
          accumulator_.load(std::move(*first));
        }
        return first.has_value();
      }
      return true;
    }
    auto value = operand();
    if (value) {
      apply(in_.place(word), op, negated, std::move(*value));
    }
    return value.has_value();
  }

  // Returns true for ADD (a + b) on one line, which is a value in brackets.
  [[nodiscard]] bool closed_on_line() const {
    int depth = 0;
    for (std::size_t i = 0; in_.peek(i).kind != TokenKind::End && in_.peek(i).line == in_.peek().line; ++i) {
      depth += in_.peek(i).is("(") ? 1 : in_.peek(i).is(")") ? -1 : 0;
    }
    return depth == 0;
  }

  void apply(const Place& at, Operator op, bool negated, Expression operand) {
    operand = negated ? make::negation(std::move(operand)) : std::move(operand);
    Expression made = make::binary(op, *accumulator_.take(), std::move(operand));
    made.at = at;
    accumulator_.combine(std::move(made));
  }

  bool close() {
    const Token& bracket = in_.take();
    if (open_.empty()) {
      in_.error(bracket, "this ')' closes nothing; remove it");
      return false;
    }
    if (!loaded(bracket)) {
      return false;
    }
    Open open = std::move(open_.back());
    open_.pop_back();
    Expression inner = *accumulator_.take();
    accumulator_.load(std::move(*open.before));
    apply(open.at, open.op, open.negated, std::move(inner));
    return true;
  }

  bool jump(const Token& word, When when) {
    if (!in_.expect_name("a label")) {
      return false;
    }
    const std::string label(in_.take().text);
    const auto joint = joints_.find(upper(label));
    if (joint != joints_.end()) {
      if (!loaded(word)) {
        return false;
      }
      accumulator_.bring_to(joint->second);
    }
    if (when != When::Always) {
      return leave(word, label, when);
    }
    accumulator_.drop();
    const bool left = leave(word, label, when);
    accumulator_.clear();
    return left;
  }

  bool leave(const Token& word, std::string label, When when) {
    auto condition = condition_of(word, when);
    if (condition) {
      lowered_.body.push_back(make::leave(in_.place(word), std::move(label), std::move(*condition)));
    }
    return condition.has_value();
  }

  std::optional<Expression> condition_of(const Token& word, When when) {
    if (when == When::Always) {
      return make::truth(in_.place(word), true);
    }
    if (!loaded(word)) {
      return std::nullopt;
    }
    const Expression& value = use();
    return when == When::True ? value : make::negation(value);
  }

  bool call(const Token& word, When when) {
    auto callee = designators_.designator();
    auto condition = callee ? condition_of(word, when) : std::nullopt;
    if (!condition) {
      return false;
    }
    if (accumulator_.loaded() && !in_.next_is({"LD", "LDN"})) {  // it stays what it was before the call
      static_cast<void>(accumulator_.use(true));
    }
    if (callee->kind != Expression::Kind::Call) {
      const Place at = callee->at;
      callee = make::call(at, std::move(*callee), {});
    }
    ast::Statement statement = make::call_statement(std::move(*callee));
    if (when != When::Always) {
      ast::Body body;
      body.push_back(std::move(statement));
      statement = make::when(std::move(*condition), std::move(body));
    }
    lowered_.body.push_back(std::move(statement));
    return true;
  }

  // LIMIT 0, 10 has the accumulator as its first value; LIMIT(MN := 0, ...) does not.
  bool function(const Token& word) {
    const Place at = in_.place(word);
    std::vector<ast::Argument> arguments;
    const bool formal = in_.peek().is("(");
    if (formal) {
      accumulator_.drop();
      in_.take();
      while (!in_.accept(")")) {
        if (!formal_argument(arguments) ||
            (!in_.accept(",") && !in_.peek().is(")") && !in_.expect(")", "after the arguments"))) {
          return false;
        }
      }
    } else {
      if (!loaded(word)) {
        return false;
      }
      arguments.push_back(make::argument({}, *accumulator_.take()));
      while (!in_.at_end() && in_.peek().line == word.line) {
        auto value = operand();
        if (!value) {
          return false;
        }
        arguments.push_back(make::argument({}, std::move(*value)));
        if (!in_.accept(",")) {
          break;
        }
      }
    }
    accumulator_.combine(make::call(at, make::name(at, std::string(word.text)), std::move(arguments)));
    return true;
  }

  bool formal_argument(std::vector<ast::Argument>& arguments) {
    std::string name;
    bool output = false;
    if (in_.peek().kind == TokenKind::Word && (in_.peek(1).is(":=") || in_.peek(1).is("=>"))) {
      name = std::string(in_.take().text);
      output = in_.take().is("=>");
    }
    auto value = operand();
    if (value) {
      arguments.push_back(make::argument(std::move(name), std::move(*value)));
      arguments.back().output = output;
    }
    return value.has_value();
  }

  st::TokenReader& in_;
  st::ExpressionParser designators_;
  const Place& origin_;
  const HasInput& has_input_;
  Diagnostics& diagnostics_;
  Lowered lowered_;
  std::map<std::string, std::string> joints_;  // labels and the variables with the value loaded there
  Accumulator accumulator_;
  std::vector<Open> open_;
};

}  // namespace

Lowered lower_list(const st::Text& text, const std::string& prefix, const HasInput& has_input, ListUse use,
                   Diagnostics& diagnostics) {
  const auto tokens = st::tokenize(text.text, text.at, diagnostics);
  st::TokenReader in(tokens, text.at, diagnostics);
  return ListLowering(tokens, in, text.at, prefix, has_input, diagnostics).run(use);
}

}  // namespace indurop::plc::lower
