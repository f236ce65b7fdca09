// SPDX-License-Identifier: Apache-2.0
// Parses object orientation of the third edition: METHOD, PROPERTY (of CODESYS), CLASS, INTERFACE, the words in the
// first line of a POU; NAMESPACE.

#include "control/plc/st/project_parser.h"

namespace indurop::plc::st {
namespace {

// Returns the end of a construct: END_METHOD for METHOD, and so on.
std::string end_of(const Token& word) {
  return "END_" + upper(word.text);
}

}  // namespace

// FUNCTION_BLOCK ABSTRACT Name, METHOD PUBLIC FINAL OVERRIDE Name. These words are names if no other name follows.
void ProjectParser::modifiers(ast::Pou& out) {
  while (in_.next_is({"ABSTRACT", "FINAL", "OVERRIDE", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL"}) &&
         in_.peek(1).kind == TokenKind::Word && !is_keyword(in_.peek(1).text) && !in_.peek(1).is("EXTENDS") &&
         !in_.peek(1).is("IMPLEMENTS")) {
    const Token& word = in_.take();
    out.access = access_word(word).value_or(out.access);
    out.is_abstract = out.is_abstract || word.is("ABSTRACT");
    out.is_final = out.is_final || word.is("FINAL");
    out.overrides = out.overrides || word.is("OVERRIDE");
  }
}

// EXTENDS Base IMPLEMENTS First, Second
void ProjectParser::inheritance(ast::Pou& out) {
  while (in_.next_is({"EXTENDS", "IMPLEMENTS"}) && in_.peek(1).kind == TokenKind::Word) {
    std::vector<ast::NameAt>& to = in_.take().is("EXTENDS") ? out.bases : out.interfaces;
    if (!names(to, "a function block, class or interface")) {
      return;
    }
  }
}

bool ProjectParser::at_method() const {
  return in_.peek().is("METHOD") || (in_.peek().is("PROPERTY") && in_.peek(1).kind == TokenKind::Word);
}

void ProjectParser::methods(ast::Pou& to) {
  while (at_method()) {
    if (in_.peek().is("METHOD")) {
      method(to);
    } else {
      property(to);
    }
  }
}

// METHOD PUBLIC Name : INT VAR_INPUT ... END_VAR ... END_METHOD
void ProjectParser::method(ast::Pou& to) {
  const Token& word = in_.take();
  ast::Pou out;
  out.kind = ast::Pou::Kind::Method;
  out.comment = word.comment;
  modifiers(out);
  out.at = in_.here();
  bool ok = name(out.name, "a method");
  if (ok && in_.accept(":")) {
    out.result = declarations_.type();
    ok = out.result.has_value();
  }
  in_.accept(";");
  code(out, "END_METHOD");
  if (in_.expect("END_METHOD", fmt::format("to close the METHOD of line {}", word.line))) {
    in_.accept(";");
  }
  if (ok) {
    to.methods.push_back(std::move(out));
  }
}

// Parses variables and statements up to `end`, which is not consumed.
void ProjectParser::code(ast::Pou& out, std::string_view end) {
  while (declarations_.at_variables()) {
    declarations_.variables(out.variables);
  }
  out.body = body(end);
  if (const auto at = statements_.take_c_code()) {
    in_.error(*at, "C code in { } is not supported, write it in ST, or as a module of its own");
  }
}

// PROPERTY Name : INT GET ... END_GET SET ... END_SET END_PROPERTY
void ProjectParser::property(ast::Pou& to) {
  const Token& word = in_.take();
  ast::Pou one;
  one.kind = ast::Pou::Kind::Method;
  one.comment = word.comment;
  modifiers(one);
  one.at = in_.here();
  bool ok = name(one.name, "a property") && in_.expect(":", "after the name, before the type of the property");
  if (ok) {
    one.result = declarations_.type();
    ok = one.result.has_value();
  }
  in_.accept(";");
  const std::size_t before = to.methods.size();
  while (in_.next_is({"GET", "SET"})) {
    accessor(one, ok, to);
  }
  if (ok && to.methods.size() == before) {  // of an interface, or ABSTRACT
    to.methods.push_back(accessor_of(one, ast::Accessor::Get));
    to.methods.push_back(accessor_of(one, ast::Accessor::Set));
  }
  if (in_.expect("END_PROPERTY", fmt::format("to close the PROPERTY of line {}", word.line))) {
    in_.accept(";");
  }
}

// The value assigned to a property has its name in SET.
ast::Pou ProjectParser::accessor_of(const ast::Pou& property, ast::Accessor which) {
  ast::Pou out = property;
  out.accessor = which;
  if (which == ast::Accessor::Set) {
    ast::Variable value;
    value.section = ast::Section::Input;
    value.at = out.at;
    value.name = out.name;
    value.type = *out.result;
    out.variables.push_back(std::move(value));
    out.result.reset();
  }
  return out;
}

void ProjectParser::accessor(const ast::Pou& property, bool known, ast::Pou& to) {
  const Token& word = in_.take();
  const ast::Accessor which = word.is("GET") ? ast::Accessor::Get : ast::Accessor::Set;
  ast::Pou out;
  if (known) {
    out = accessor_of(property, which);
  }
  const ast::Access access = out.access;
  while (const auto own = access_word(in_.peek())) {  // GET PRIVATE
    out.access = *own;
    in_.take();
  }
  out.access = std::max(out.access, access);
  code(out, end_of(word));
  if (in_.expect(end_of(word), fmt::format("to close the {} of line {}", upper(word.text), word.line))) {
    in_.accept(";");
  }
  if (known) {
    to.methods.push_back(std::move(out));
  }
}

// CLASS and INTERFACE have no body of their own.
void ProjectParser::object(ast::Pou::Kind kind, std::vector<ast::Pou>& to) {
  const Token& word = in_.previous();
  const std::string end = end_of(word);
  ast::Pou out;
  out.kind = kind;
  out.comment = word.comment;
  modifiers(out);
  out.at = in_.here();
  const bool ok = name(out.name, kind == ast::Pou::Kind::Class ? "a class" : "an interface");
  uses(out);
  inheritance(out);
  in_.accept(";");
  while (!in_.at_end() && !in_.peek().is(end)) {
    if (kind == ast::Pou::Kind::Class && declarations_.at_variables()) {
      declarations_.variables(out.variables);
    } else if (at_method()) {
      methods(out);
    } else {
      const Token& stray = in_.peek();
      in_.error(stray, fmt::format("{} has {}methods and properties, not {}", upper(word.text),
                                   kind == ast::Pou::Kind::Class ? "variables, " : "", TokenReader::spelled(stray)));
      while (!in_.at_end() && !in_.peek().is(end) && !at_method()) {
        in_.take();
      }
    }
  }
  if (in_.expect(end, fmt::format("to close the {} of line {}", upper(word.text), word.line))) {
    in_.accept(";");
  }
  if (ok) {
    to.push_back(std::move(out));
  }
}

// NAMESPACE INTERNAL A.B USING C; ... END_NAMESPACE
void ProjectParser::space(Project& out) {
  const Token& word = in_.take();
  if (in_.peek().is("INTERNAL") && in_.peek(1).kind == TokenKind::Word) {
    in_.take();
  }
  constexpr std::ptrdiff_t kDeepest = 32;
  const ast::Scope around = scope_;
  std::vector<ast::NameAt> path;
  const bool named = names(path, "a namespace");
  const std::string whole = scope_.space + "." + (named ? path.front().name : "");
  if (std::count(whole.begin(), whole.end(), '.') > kDeepest) {
    in_.error(word, fmt::format("more than {} namespaces inside each other, use fewer", kDeepest));
    while (!in_.at_end()) {
      in_.take();
    }
    return;
  }
  if (named) {
    scope_.space += (scope_.space.empty() ? "" : ".") + path.front().name;
  }
  in_.accept(";");
  while (!in_.at_end() && !in_.peek().is("END_NAMESPACE")) {
    if (!element(out) && !in_.accept(";")) {
      const Token& stray = in_.take();
      in_.error(stray,
                fmt::format("a NAMESPACE holds types, functions, function blocks, classes and interfaces, not {}",
                            TokenReader::spelled(stray)));
      while (!in_.at_end() &&
             !in_.next_is({"END_NAMESPACE", "NAMESPACE", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "CLASS", "INTERFACE"})) {
        in_.take();
      }
    }
  }
  scope_ = around;
  if (in_.expect("END_NAMESPACE", fmt::format("to close the NAMESPACE of line {}", word.line))) {
    in_.accept(";");
  }
}

// Parses the USING of a POU, in its first lines.
void ProjectParser::uses(ast::Pou& out) {
  while (in_.peek().is("USING") && in_.peek(1).kind == TokenKind::Word) {
    using_directive(out.scope.uses);
  }
}

void ProjectParser::using_directive(std::vector<ast::NameAt>& to) {
  constexpr std::size_t kMaxNamespaces = 100;
  const Token& word = in_.take();
  static_cast<void>(names(to, "a namespace") && in_.expect_end("after USING"));
  if (to.size() > kMaxNamespaces) {
    in_.error(word, fmt::format("more than {} namespaces are used here, write their names where they are needed",
                                kMaxNamespaces));
    to.resize(kMaxNamespaces);
  }
}

// First, Second.Inner
bool ProjectParser::names(std::vector<ast::NameAt>& to, std::string_view what) {
  do {
    ast::NameAt one;
    one.at = in_.here();
    if (!name(one.name, what)) {
      return false;
    }
    while (in_.accept(".")) {
      std::string inner;
      if (!name(inner, what)) {
        return false;
      }
      one.name += "." + inner;
    }
    in_.refuse_generic();
    to.push_back(std::move(one));
  } while (in_.accept(","));
  return true;
}

}  // namespace indurop::plc::st
