// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/declaration_parser.h"

#include <array>

#include "control/plc/st/literal.h"

namespace indurop::plc::st {
namespace {

struct SectionWord {
  std::string_view word;
  ast::Section section;
};
constexpr std::array<SectionWord, 9> kSections{{{"VAR", ast::Section::Local},
                                                {"VAR_INPUT", ast::Section::Input},
                                                {"VAR_OUTPUT", ast::Section::Output},
                                                {"VAR_IN_OUT", ast::Section::InOut},
                                                {"VAR_TEMP", ast::Section::Temp},
                                                {"VAR_GLOBAL", ast::Section::Global},
                                                {"VAR_EXTERNAL", ast::Section::External},
                                                {"VAR_STAT", ast::Section::Local},
                                                {"VAR_INST", ast::Section::Local}}};

}  // namespace

std::optional<ast::Access> access_word(const Token& word) noexcept {
  if (word.is("PUBLIC")) {
    return ast::Access::Public;
  }
  if (word.is("PRIVATE")) {
    return ast::Access::Private;
  }
  if (word.is("PROTECTED")) {
    return ast::Access::Protected;
  }
  if (word.is("INTERNAL")) {
    return ast::Access::Internal;
  }
  return std::nullopt;
}

bool DeclarationParser::at_variables() const {
  const std::string_view word = in_.peek().text;
  return in_.peek().kind == TokenKind::Word && (same_name(word, "VAR") || same_name(word.substr(0, 4), "VAR_")) &&
         is_keyword(word);
}

void DeclarationParser::recover(std::string_view end) {
  while (!in_.at_end() && !in_.peek().is(end)) {
    const bool other_end = in_.peek().kind == TokenKind::Word && in_.peek().text.size() > 4 &&
                           same_name(in_.peek().text.substr(0, 4), "END_") && !in_.peek().is("END_STRUCT") &&
                           !in_.peek().is("END_UNION");
    if (other_end || in_.take().is(";")) {
      return;
    }
  }
}

std::optional<DeclarationParser::Block> DeclarationParser::block() {
  const Token& word = in_.take();
  const auto* known =
      std::find_if(kSections.begin(), kSections.end(), [&](const SectionWord& s) { return word.is(s.word); });
  if (known == kSections.end()) {
    in_.unsupported(word,
                    fmt::format("{} is not supported, use {}", word.text,
                                word.is("VAR_GENERIC") ? "VAR_IN_OUT with ARRAY[*], or a function block for each size"
                                                       : "VAR_GLOBAL and VAR_EXTERNAL"));
    return std::nullopt;
  }
  Block out;
  out.section = known->section;
  out.is_static = word.is("VAR_STAT");
  out.of_instance = word.is("VAR_INST");
  while (true) {
    // VAR PUBLIC; the words are names of variables if no other name follows.
    const auto access = in_.peek(1).kind == TokenKind::Word ? access_word(in_.peek()) : std::nullopt;
    if (access) {
      out.access = access;
      in_.take();
      continue;
    }
    if (in_.accept("CONSTANT")) {
      out.constant = true;
    } else if (in_.accept("RETAIN") || in_.accept("PERSISTENT")) {
      out.retain = true;
    } else if (in_.accept("NON_RETAIN")) {
      out.non_retain = true;
    } else {
      return out;
    }
  }
}

void DeclarationParser::variables(std::vector<ast::Variable>& to) {
  const Token& first = in_.peek();
  const auto kind = block();
  while (!in_.at_end() && !in_.peek().is("END_VAR")) {
    if (in_.accept(";")) {
      continue;  // a surplus one, which editors accept
    }
    const std::size_t from = in_.position();
    if (!kind || !declaration(*kind, to)) {
      recover("END_VAR");
    }
    if (in_.position() == from) {
      break;  // the end of another construct
    }
  }
  if (in_.expect("END_VAR", fmt::format("to close the {} of line {}", first.text, first.line))) {
    in_.accept(";");
  }
}

std::string DeclarationParser::comment(const Token& first, int before) const {
  if (in_.peek().comment_line > 0 && in_.peek().comment_line == in_.previous().line) {
    return std::string(in_.peek().comment);
  }
  return first.comment_line > before ? std::string(first.comment) : std::string();
}

// Declares names without further data: their uses are no further errors.
bool DeclarationParser::broken(std::vector<ast::Variable>& found, std::vector<ast::Variable>& to) {
  for (ast::Variable& one : found) {
    one.type.kind = ast::TypeSpec::Kind::Inferred;
    to.push_back(std::move(one));
  }
  return false;
}

// Parses a, b AT %IX0.0, before the type. Returns false if the rest does not belong to them.
bool DeclarationParser::names(const Block& block, std::vector<ast::Variable>& found) {
  do {
    ast::Variable one;
    one.section = block.section;
    one.constant = block.constant;
    one.retain = block.retain;
    one.non_retain = block.non_retain;
    one.is_static = block.is_static;
    one.of_instance = block.of_instance;
    one.access = block.access;
    one.at = in_.here();
    if (!in_.peek().is("AT")) {
      if (!in_.expect_name("a variable")) {
        const bool goes_on = in_.peek().kind == TokenKind::Word && (in_.peek(1).is(",") || in_.peek(1).is(":"));
        if (!goes_on) {
          return false;
        }
        in_.take();  // a, END_IF, b : INT; the others are declared
        continue;
      }
      one.name = in_.take().text;
    }
    if (in_.accept("AT") && !address(one)) {
      return false;
    }
    found.push_back(std::move(one));
  } while (in_.accept(","));
  return true;
}

// a, b AT %IX0.0 : INT := 5;
bool DeclarationParser::declaration(const Block& block, std::vector<ast::Variable>& to) {
  const int before = in_.previous().line;
  const Token& first = in_.peek();
  std::vector<ast::Variable> found;
  if (!names(block, found)) {
    return false;
  }
  auto spec = in_.expect(":", "after the name, before the type") ? type() : std::nullopt;
  if (!spec) {
    return broken(found, to);
  }
  if (found.size() == 1 && !found.front().address && in_.accept("AT") && !address(found.front())) {
    return broken(found, to);  // Level : UINT AT %MW0, as OpenPLC has it
  }
  const auto edge = in_.accept("R_EDGE")   ? ast::Edge::Rising
                    : in_.accept("F_EDGE") ? ast::Edge::Falling
                                           : ast::Edge::None;
  std::optional<ast::Initial> initial;
  const bool binds = spec->kind == ast::TypeSpec::Kind::Pointer && in_.peek().is("REF") && in_.peek(1).is("=");
  if (binds) {
    in_.take();
    in_.take();
  }
  if (binds || in_.accept(":=")) {
    initial = expressions_.initial(spec->kind == ast::TypeSpec::Kind::Array);
    if (!initial) {
      return broken(found, to);
    }
  }
  if (!in_.expect_end("after the declaration")) {
    return broken(found, to);
  }
  const std::string text = comment(first, before);
  for (ast::Variable& one : found) {
    one.type = *spec;
    one.initial = initial;
    one.edge = edge;
    one.comment = text;
    to.push_back(std::move(one));
  }
  return true;
}

bool DeclarationParser::address(ast::Variable& out) {
  out.address = in_.peek().kind == TokenKind::Address ? address_literal(in_.peek().text) : std::nullopt;
  if (!out.address) {
    in_.error(in_.peek(),
              fmt::format("expected an address as %IX0.3 after AT, found {}", TokenReader::spelled(in_.peek())));
    return false;
  }
  in_.take();
  return true;
}

void DeclarationParser::types(std::vector<ast::TypeDeclaration>& to) {
  const int line = in_.previous().line;
  while (!in_.at_end() && !in_.peek().is("END_TYPE")) {
    const std::size_t from = in_.position();
    if (!one_type(to)) {
      recover("END_TYPE");
    }
    if (in_.position() == from) {
      break;
    }
  }
  if (in_.expect("END_TYPE", fmt::format("to close the TYPE of line {}", line))) {
    in_.accept(";");
  }
}

bool DeclarationParser::one_type(std::vector<ast::TypeDeclaration>& to) {
  ast::TypeDeclaration out;
  if (in_.peek(1).kind == TokenKind::Word && access_word(in_.peek())) {
    in_.take();  // TwinCAT only: defines which libraries can access it
  }
  const int before = in_.previous().line;
  const Token& first = in_.peek();
  out.at = in_.here();
  if (!in_.expect_name("a type")) {
    return false;
  }
  out.name = in_.take().text;
  std::shared_ptr<ast::TypeSpec> base;
  if (in_.accept("EXTENDS")) {
    auto named = type();
    if (!named) {
      return false;
    }
    base = std::make_shared<ast::TypeSpec>(std::move(*named));
  }
  if (!in_.expect(":", "after the type's name")) {
    return false;
  }
  auto spec = type();
  if (!spec) {
    return false;
  }
  if (base && spec->kind != ast::TypeSpec::Kind::Struct) {
    in_.error(first, "only a STRUCT extends another one");
  } else if (base) {
    spec->element = std::move(base);
  }
  if (in_.accept(":=")) {
    out.initial = expressions_.initial();
    if (!out.initial) {
      return false;
    }
  }
  // After END_STRUCT the ';' is often omitted.
  const bool closed = in_.accept(";") || spec->kind == ast::TypeSpec::Kind::Struct || in_.expect_end("after the type");
  out.type = std::move(*spec);
  out.comment = comment(first, before);
  to.push_back(std::move(out));
  return closed;
}

}  // namespace indurop::plc::st
