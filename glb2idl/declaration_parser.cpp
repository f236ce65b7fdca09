// SPDX-License-Identifier: Apache-2.0
// Parses declarations.

#include "glb2idl/declaration_parser.h"

#include <array>
#include <memory>
#include <span>
#include <utility>

#include "glb2idl/type_words.h"

namespace indurop::glb2idl {
namespace {

constexpr std::array<std::string_view, 9> kStarters{"struct",  "enum", "typedef", "const", "namespace",
                                                    "include", "#",    "@",       "union"};
constexpr std::array<std::string_view, 4> kOutermost{"namespace", "include", "#", "typedef"};
constexpr std::array<std::string_view, 12> kMeaningless{"volatile", "static",       "extern",   "register",
                                                        "inline",   "mutable",      "auto",     "constinit",
                                                        "signal",   "thread_local", "restrict", "friend"};
constexpr std::array<std::string_view, 9> kForeign{"class",   "template",  "using",   "operator", "public",
                                                   "private", "protected", "virtual", "import"};

bool contains(std::span<const std::string_view> list, std::string_view word) noexcept {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

bool DeclarationParser::begins_declaration(const Token& token) const noexcept {
  return token.newline_before && (contains(kStarters, token.text) || is_type_word(token.text));
}

void DeclarationParser::recover(std::size_t begin, bool in_struct) {
  for (std::size_t failed = std::exchange(begin, in_.position()); failed < begin; ++failed) {
    in_.rewind(failed);
    note_broken();
  }
  in_.rewind(begin);
  int depth = 0;
  for (bool first = true; !in_.at_end(); first = false) {
    const Token& token = in_.peek();
    const bool next_named = token.newline_before && token.kind == TokenKind::Identifier &&
                            in_.peek(1).kind == TokenKind::Identifier && !in_.peek(1).newline_before;
    const bool outer = token.newline_before && contains(kOutermost, token.text);  // a '}' is missing
    if (!first && (outer || (depth == 0 && (begins_declaration(token) || next_named)))) {
      return;
    }
    if (token.is("}") && depth == 0 && in_struct) {
      return;
    }
    note_broken();
    depth += token.is("{") ? 1 : token.is("}") && depth > 0 ? -1 : 0;
    in_.take();
    if (depth == 0 && token.is(";")) {
      return;
    }
  }
}

void DeclarationParser::note_broken() {
  if (in_.peek().kind == TokenKind::Identifier) {
    broken_.emplace(in_.peek().text);
  }
}

std::optional<ast::Declaration> DeclarationParser::declaration(bool in_struct) {
  ast::Declaration result;
  const std::size_t begin = in_.position();
  if (!values_.annotations(result.annotations)) {
    return std::nullopt;
  }
  result.at = in_.peek().at;
  if (in_.accept("typedef")) {
    result.kind = ast::Declaration::Kind::Typedef;
  }
  while (in_.peek().is("const") || in_.peek().is("constexpr") || contains(kMeaningless, in_.peek().text)) {
    if (!in_.peek().is("const") && !in_.peek().is("constexpr")) {
      in_.error(in_.peek().at, fmt::format("'{}' has no meaning here, remove it", in_.peek().text));
    } else if (result.kind == ast::Declaration::Kind::Typedef || in_struct) {
      in_.error(in_.peek().at, "only constants are const, remove it");
    } else {
      result.kind = ast::Declaration::Kind::Constant;
    }
    in_.take();
  }
  auto type = type_spec();
  if (!type) {
    return std::nullopt;
  }
  result.type = std::move(*type);
  if (declarators_follow(result, in_struct)) {
    do {
      auto one = declarator(in_struct);
      if (!one) {
        return std::nullopt;
      }
      result.declarators.push_back(std::move(*one));
    } while (in_.accept(","));
  }
  result.at = join(result.at, in_.previous().at);
  const bool finished = finish("the declaration");
  result.description = descriptions_.find(in_, begin);
  if (!finished) {
    recover(in_.position(), in_struct);
  }
  return result;
}

bool DeclarationParser::declarators_follow(const ast::Declaration& found, bool in_struct) const noexcept {
  const bool body = found.type.structure || found.type.enumeration;
  const bool may_stand_alone = body && !in_struct && found.kind == ast::Declaration::Kind::Plain &&
                               (found.type.tag || found.type.kind == ast::TypeSpec::Kind::Enum);
  if (!may_stand_alone) {
    return true;
  }
  const Token& next = in_.peek();
  if (next.is(";") || next.kind == TokenKind::End) {
    return false;
  }
  if (!next.newline_before) {
    return true;
  }
  // A name on a new line is the variable's name or already the next declaration.
  const Token& after = in_.peek(1);
  return next.kind == TokenKind::Identifier && !is_type_word(next.text) && !contains(kStarters, next.text) &&
         (after.newline_before || (after.kind != TokenKind::Identifier && !after.is(".") && !after.is("::")));
}

bool DeclarationParser::finish(std::string_view what) {
  if (in_.accept(";") || in_.at_end() || in_.peek().newline_before || in_.peek().is("}")) {
    return true;
  }
  in_.error(in_.peek().at,
            fmt::format("expected ';' or a new line after {}, found {}", what, TokenReader::spelled(in_.peek())));
  return false;
}

std::optional<ast::TypeSpec> DeclarationParser::type_spec() {
  const Token& token = in_.peek();
  if (token.is("struct") || token.is("enum")) {
    return tagged_type(token.is("struct"));
  }
  if (is_type_word(token.text) && token.kind == TokenKind::Identifier) {
    return base_type();
  }
  if (token.is("union")) {
    in_.error(token.at, "a union cannot be shared, use a struct");
    return std::nullopt;
  }
  if (contains(kForeign, token.text)) {
    in_.error(token.at,
              fmt::format("'{}' is not known here, only data and functions are declared in a .glb", token.text));
    return std::nullopt;
  }
  if (token.kind != TokenKind::Identifier) {
    in_.error(token.at, fmt::format("expected a declaration, found {}", TokenReader::spelled(token)));
    return std::nullopt;
  }
  auto path = values_.path("a type");
  if (!path) {
    return std::nullopt;
  }
  ast::TypeSpec result;
  result.kind = ast::TypeSpec::Kind::Named;
  result.at = path->at;
  result.path = std::move(*path);
  return result;
}

std::optional<ast::TypeSpec> DeclarationParser::base_type() {
  ast::TypeSpec result;
  result.at = in_.peek().at;
  std::vector<std::string_view> words;
  const auto fixed = fixed_type(in_.peek().text);
  do {
    words.push_back(in_.peek().text);
    result.at = join(result.at, in_.take().at);
  } while (is_type_word(in_.peek().text) && in_.peek().kind == TokenKind::Identifier && !in_.peek().newline_before);
  if (words.size() == 1 && words[0] == "void") {
    result.kind = ast::TypeSpec::Kind::Void;
    return result;
  }
  const auto base = fixed && words.size() == 1 ? fixed : combined_type(words);
  if (!base) {
    const bool long_double = contains(words, "long") && contains(words, "double");
    in_.error(result.at, long_double ? "long double differs between machines, use double"
                                     : "these words together are not a type, use a type such as int32_t or double");
    return std::nullopt;
  }
  result.base = *base;
  return result;
}

std::optional<ast::TypeSpec> DeclarationParser::tagged_type(bool is_struct) {
  ast::TypeSpec result;
  result.kind = is_struct ? ast::TypeSpec::Kind::Struct : ast::TypeSpec::Kind::Enum;
  result.at = in_.take().at;
  if (!is_struct && (in_.peek().is("class") || in_.peek().is("struct"))) {
    in_.error(in_.take().at, "an enum has no 'class' here, remove it");
  }
  if (in_.peek().kind == TokenKind::Identifier) {
    const Token& tag = in_.take();
    result.tag = ast::Name{std::string(tag.text), tag.at};
    result.at = join(result.at, tag.at);
  }
  if (!is_struct && in_.peek().is(":")) {
    in_.error(in_.peek().at, "every enum is stored as int32_t, remove the type");
    while (!in_.at_end() && !in_.peek().is("{") && !in_.peek().is(";")) {
      in_.take();
    }
  }
  if (!in_.peek().is("{") && result.tag) {
    result.kind = ast::TypeSpec::Kind::Named;
    result.path = {{result.tag->text}, result.tag->at};
    return result;
  }
  if (!in_.expect("{", is_struct ? "to begin the struct" : "to begin the enum")) {
    return std::nullopt;
  }
  if (is_struct ? !struct_body(result) : !enum_body(result)) {
    return std::nullopt;
  }
  return result;
}

bool DeclarationParser::struct_body(ast::TypeSpec& to) {
  constexpr int kMaxDepth = 16;
  if (depth_ == kMaxDepth) {
    in_.error(to.at, fmt::format("structs are nested more than {} levels deep, name the inner ones", kMaxDepth));
    return false;
  }
  ++depth_;
  auto body = std::make_shared<ast::StructBody>();
  while (!in_.peek().is("}") && !in_.at_end()) {
    if (in_.accept(";")) {
      continue;
    }
    const std::size_t before = in_.position();
    auto field = declaration(true);
    if (field) {
      body->fields.push_back(std::move(*field));
    } else {
      recover(before, true);
    }
  }
  --depth_;
  to.structure = std::move(body);
  return in_.expect("}", "to close the struct");
}

bool DeclarationParser::enum_body(ast::TypeSpec& to) {
  auto body = std::make_shared<ast::EnumBody>();
  while (!in_.accept("}")) {
    const Token& name = in_.peek();
    if (name.kind != TokenKind::Identifier) {
      in_.error(name.at, fmt::format("expected the name of a value of the enum, found {}", TokenReader::spelled(name)));
      return false;
    }
    in_.take();
    ast::EnumBody::Item item{{std::string(name.text), name.at}, std::nullopt};
    if (in_.accept("=")) {
      item.value = values_.expression();
      if (!item.value) {
        return false;
      }
    }
    body->items.push_back(std::move(item));
    if (!in_.accept(",") && !in_.peek().is("}")) {
      in_.error(in_.peek().at,
                fmt::format("expected ',' or '}}' in the enum, found {}", TokenReader::spelled(in_.peek())));
      return false;
    }
  }
  to.enumeration = std::move(body);
  return true;
}

std::optional<ast::Declarator> DeclarationParser::declarator(bool in_struct) {
  ast::Declarator result;
  if (!declared_name(result, true)) {
    return std::nullopt;
  }
  if (in_.peek().is("(") && !in_struct) {
    if (!function(result)) {
      return std::nullopt;
    }
  } else if (!dimensions(result)) {
    return std::nullopt;
  }
  if (!trailing_annotations(result) || !deadline(result)) {
    return std::nullopt;
  }
  const bool braces = in_.peek().is("{") && !in_.peek().newline_before;
  if (braces || in_.accept("=")) {
    result.initial = values_.initializer();
    if (!result.initial || !trailing_annotations(result)) {
      return std::nullopt;
    }
  }
  return result;
}

bool DeclarationParser::declared_name(ast::Declarator& to, bool required) {
  if (in_.peek().is("*") || in_.peek().is("&") || in_.peek().is("&&")) {
    in_.error(in_.peek().at, "an address means nothing to another process, share the value itself");
    return false;
  }
  const Token& name = in_.peek();
  if (name.kind != TokenKind::Identifier) {
    if (required) {
      in_.error(name.at, fmt::format("expected a name, found {}", TokenReader::spelled(name)));
    }
    return !required;
  }
  in_.take();
  to.name = {std::string(name.text), name.at};
  return true;
}

bool DeclarationParser::dimensions(ast::Declarator& to) {
  if (in_.peek().is(":")) {
    in_.error(in_.peek().at, "bit fields differ between machines, use a whole integer");
    return false;
  }
  while (in_.peek().is("[")) {
    ast::Dimension found;
    found.at = in_.take().at;
    if (!in_.peek().is("]")) {
      found.size = values_.expression();
      if (!found.size) {
        return false;
      }
    }
    if (!in_.expect("]", "to close the array size")) {
      return false;
    }
    found.at = join(found.at, in_.previous().at);
    to.dims.push_back(std::move(found));
  }
  return true;
}

bool DeclarationParser::trailing_annotations(ast::Declarator& to) {
  if (in_.peek().is("@") && in_.peek().newline_before) {
    std::size_t i = 0;
    int depth = 0;
    for (; in_.peek(i).kind != TokenKind::End; ++i) {
      const Token& token = in_.peek(i);
      const bool name = i != 0 && in_.peek(i - 1).is("@");
      depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
      if (depth == 0 && !name && !token.is("@") && !token.is("(") && !token.is(")")) {
        break;
      }
    }
    if (!in_.peek(i).is(";") && !in_.peek(i).is(",") && !in_.peek(i).is("=")) {
      return true;
    }
  }
  return values_.annotations(to.annotations);
}

bool DeclarationParser::function(ast::Declarator& to) {
  to.is_function = true;
  in_.take();
  if (in_.peek().is("void") && in_.peek(1).is(")")) {
    in_.take();
  }
  while (!in_.accept(")")) {
    ast::Parameter parameter;
    auto type = type_spec();
    if (!type) {
      return false;
    }
    parameter.type = std::move(*type);
    if (!declared_name(parameter.declarator, false) || !dimensions(parameter.declarator)) {
      return false;
    }
    to.parameters.push_back(std::move(parameter));
    if (!in_.accept(",") && !in_.peek().is(")")) {
      in_.error(in_.peek().at,
                fmt::format("expected ',' or ')' in the parameters, found {}", TokenReader::spelled(in_.peek())));
      return false;
    }
  }
  return deadline(to);
}

bool DeclarationParser::deadline(ast::Declarator& to) {
  if (!to.is_function || to.deadline || !in_.peek().is("deadline") || in_.peek().newline_before) {
    return true;
  }
  in_.take();
  to.deadline = values_.expression();
  return to.deadline.has_value();
}

}  // namespace indurop::glb2idl
