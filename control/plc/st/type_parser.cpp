// SPDX-License-Identifier: Apache-2.0
// Parses types in declarations.

#include "control/plc/st/declaration_parser.h"

namespace indurop::plc::st {
namespace {

constexpr int kMaxTypeDepth = 16;

}  // namespace

std::optional<ast::TypeSpec> DeclarationParser::type() {
  ast::TypeSpec out;
  const Token& token = in_.peek();
  out.at = in_.here();
  if (depth_ >= kMaxTypeDepth) {
    in_.error(token, fmt::format("types more than {} levels deep, give the inner ones names", kMaxTypeDepth));
    return std::nullopt;
  }
  ++depth_;
  bool ok = false;
  if (in_.accept("ARRAY")) {
    ok = array(out);
  } else if (in_.accept("STRUCT")) {
    out.overlaps = in_.peek(1).kind == TokenKind::Word && in_.accept("OVERLAP");
    ok = structure(out, "END_STRUCT");
  } else if (token.is("(")) {
    ok = enumeration(out);
  } else if (in_.peek().is("UNION") && in_.peek(1).kind == TokenKind::Word) {
    in_.take();
    out.overlaps = true;
    ok = structure(out, "END_UNION");
  } else if (in_.peek().is("REF_TO") || (in_.next_is({"POINTER", "REFERENCE"}) && in_.peek(1).is("TO"))) {
    ok = pointer(out);
  } else if (in_.expect_name("a type")) {
    ok = named(out);
  }
  --depth_;
  return ok ? std::optional(std::move(out)) : std::nullopt;
}

// INT, INT (0..5), INT (A, B), STRING[20], Motor
bool DeclarationParser::named(ast::TypeSpec& out) {
  const std::string_view word = in_.take().text;
  const auto elementary = elementary_named(word);
  if (!elementary) {
    out.kind = ast::TypeSpec::Kind::Named;
    out.name = word;
    while (in_.accept(".")) {
      if (!in_.expect_name("a type")) {
        return false;
      }
      out.name += "." + std::string(in_.take().text);
    }
    in_.refuse_generic();
    return starts(out);
  }
  out.elementary = *elementary;
  if (is_text(*elementary)) {
    return string_length(out);
  }
  if (!in_.peek().is("(")) {
    return true;
  }
  const Token& behind = in_.peek(2);
  if (in_.peek(1).kind == TokenKind::Word && (behind.is(",") || behind.is(")") || behind.is(":="))) {
    return enumeration(out);
  }
  in_.take();
  out.kind = ast::TypeSpec::Kind::Subrange;
  out.range.emplace();
  return dimension(*out.range) && in_.expect(")", "after the range");
}

// Motor(5, speed := 3); of elements of an array also Motor[(1), (2)]
bool DeclarationParser::starts(ast::TypeSpec& out) {
  const bool several = in_.peek().is("[") && in_.peek(1).is("(");
  if (!several && !in_.peek().is("(")) {
    return true;
  }
  if (several) {
    in_.take();
  }
  do {
    auto arguments = in_.peek().is("(") ? expressions_.arguments() : std::nullopt;
    if (!arguments) {
      in_.expect("(", "before what FB_Init is given");
      return false;
    }
    out.starts.push_back(std::move(*arguments));
  } while (several && in_.accept(","));
  return !several || in_.expect("]", "after what FB_Init is given");
}

bool DeclarationParser::string_length(ast::TypeSpec& out) {
  out.kind = ast::TypeSpec::Kind::String;
  const bool square = in_.peek().is("[");
  if (!square && !in_.peek().is("(")) {
    return true;
  }
  in_.take();
  out.length = expressions_.expression();
  return out.length && in_.expect(square ? "]" : ")", "after the length");
}

bool DeclarationParser::dimension(ast::Dimension& out) {
  auto low = expressions_.expression();
  if (!low || !in_.expect("..", "between the bounds")) {
    return false;
  }
  auto high = expressions_.expression();
  if (!high) {
    return false;
  }
  out.low = std::move(*low);
  out.high = std::move(*high);
  return true;
}

bool DeclarationParser::pointer(ast::TypeSpec& out) {
  out.kind = ast::TypeSpec::Kind::Pointer;
  const Token& word = in_.take();
  out.pointer = word.is("POINTER")  ? ast::PointerKind::PointerTo
                : word.is("REF_TO") ? ast::PointerKind::RefTo
                                    : ast::PointerKind::ReferenceTo;
  in_.accept("TO");
  auto element = type();
  if (!element) {
    return false;
  }
  out.element = std::make_shared<ast::TypeSpec>(std::move(*element));
  return true;
}

bool DeclarationParser::array(ast::TypeSpec& out) {
  out.kind = ast::TypeSpec::Kind::Array;
  if (!in_.expect("[", "after ARRAY")) {
    return false;
  }
  do {
    if (in_.accept("*")) {
      out.open = true;
      out.dimensions.emplace_back();
      continue;
    }
    if (out.open) {
      in_.error(in_.peek(), "either all bounds of an array are *, or none");
      return false;
    }
    if (!dimension(out.dimensions.emplace_back())) {
      return false;
    }
  } while (in_.accept(","));
  if (!in_.expect("]", "after the bounds") || !in_.expect("OF", "before the type of the elements")) {
    return false;
  }
  auto element = type();
  if (!element) {
    return false;
  }
  out.element = std::make_shared<ast::TypeSpec>(std::move(*element));
  return true;
}

bool DeclarationParser::structure(ast::TypeSpec& out, std::string_view end) {
  out.kind = ast::TypeSpec::Kind::Struct;
  while (!in_.at_end() && !in_.peek().is(end)) {
    const std::size_t from = in_.position();
    if (!declaration({}, out.fields)) {
      recover(end);
    }
    if (in_.position() == from) {
      break;
    }
  }
  return in_.expect(end, fmt::format("to close the {} of line {}", end.substr(4), out.at.line));
}

bool DeclarationParser::enumeration(ast::TypeSpec& out) {
  out.kind = ast::TypeSpec::Kind::Enum;
  in_.take();
  do {
    ast::EnumValue one;
    one.at = in_.here();
    if (!in_.expect_name("an enumeration's value")) {
      return false;
    }
    one.name = in_.take().text;
    if (in_.accept(":=")) {
      one.value = expressions_.expression();
      if (!one.value) {
        return false;
      }
    }
    out.values.push_back(std::move(one));
  } while (in_.accept(","));
  if (!in_.expect(")", "after the last value")) {
    return false;
  }
  // (A, B) INT, as written by some editors
  const auto base = in_.peek().kind == TokenKind::Word ? elementary_named(in_.peek().text) : std::nullopt;
  if (base) {
    out.elementary = *base;
    in_.take();
  }
  return true;
}

}  // namespace indurop::plc::st
