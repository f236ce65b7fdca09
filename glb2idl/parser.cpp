// SPDX-License-Identifier: Apache-2.0
// Declarations: namespaces, includes, constants, types, variables, shared functions.

#include "glb2idl/parser.h"

#include <array>
#include <span>
#include <utility>

#include "glb2idl/expression_parser.h"
#include "glb2idl/text.h"
#include "glb2idl/token_reader.h"
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

class Parser {
 public:
  Parser(const Sources& sources, std::uint32_t file, const Tokens& tokens, Diagnostics& diagnostics)
      : sources_(sources), file_(file), comments_(tokens.comments), in_(tokens, diagnostics), values_(in_) {}

  ast::File run() {
    while (!in_.at_end()) {
      const std::size_t before = in_.position();
      if (!item()) {
        recover(before, false);
      }
    }
    return std::move(out_);
  }

 private:
  // ---- recovery

  [[nodiscard]] bool begins_declaration(const Token& token) const noexcept {
    return token.newline_before && (contains(kStarters, token.text) || is_type_word(token.text));
  }

  // Skips the rest of a declaration that failed somewhere behind `begin`; remembers the names in it.
  void recover(std::size_t begin, bool in_struct) {
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
  void note_broken() {
    if (in_.peek().kind == TokenKind::Identifier) {
      out_.broken.emplace(in_.peek().text);
    }
  }

  // ---- items of a file

  bool item() {
    if (in_.accept(";")) {
      return true;
    }
    if (in_.peek().is("#") && in_.peek().newline_before) {
      return directive();
    }
    if (in_.peek().is("namespace")) {
      return name_space();
    }
    if (in_.peek().is("include") && in_.peek(1).kind == TokenKind::Text) {
      in_.take();
      return include();
    }
    if (in_.peek().is("}") && ignored_braces_ > 0) {
      in_.take();
      --ignored_braces_;
      return true;
    }
    if (in_.peek().is("}")) {
      in_.error(in_.take().at, "this '}' closes nothing, remove it");
      return true;
    }
    auto found = declaration(false);
    if (found) {
      out_.items.emplace_back(std::move(*found));
    }
    return found.has_value();
  }

  bool name_space() {
    in_.take();
    auto path = values_.path("a namespace");
    if (!path) {
      return false;
    }
    if (in_.peek().is("{")) {
      in_.error(in_.take().at,
                fmt::format("a namespace has no braces here, write 'namespace {};': it holds until the next "
                            "'namespace'",
                            join_names(path->parts, ".")));
      ++ignored_braces_;
      out_.items.emplace_back(ast::Namespace{std::move(*path)});
      return true;
    }
    out_.items.emplace_back(ast::Namespace{std::move(*path)});
    return finish("the namespace");
  }

  bool include() {
    const Token& name = in_.take();
    auto decoded = decode_quoted(name.text);
    if (!decoded || decoded->empty() || decoded->find('\0') != std::string::npos) {
      in_.error(name.at, "not a file name, write include \"other.glb\";");
      return false;
    }
    out_.items.emplace_back(ast::Include{name.at, std::move(*decoded)});
    return finish("the include");
  }

  bool directive() {
    const Token& hash = in_.take();
    const Token& word = in_.peek();
    if (word.newline_before) {
      return true;  // '#' alone on its line
    }
    in_.take();
    if (word.is("define")) {
      return define();
    }
    if (word.is("include")) {
      if (in_.peek().kind == TokenKind::Text && !in_.peek().newline_before) {
        return include();
      }
      in_.error(word.at,
                "only .glb files can be included, write #include \"other.glb\"; the types of <stdint.h> are built in");
    } else if (!word.is("pragma") || !in_.peek().is("once")) {
      in_.error(join(hash.at, word.at),
                fmt::format("#{} is not known here, remove it; a file included twice is read once", word.text));
    }
    skip_line();
    return true;
  }

  void skip_line() {
    while (!in_.at_end() && !in_.peek().newline_before) {
      in_.take();
    }
  }

  bool define() {
    const std::size_t begin = in_.position();
    const Token& name = in_.peek();
    if (name.kind != TokenKind::Identifier || name.newline_before) {
      in_.error(in_.previous().at, "the constant's name is missing: #define NAME value");
      skip_line();
      return true;
    }
    in_.take();
    const Token& next = in_.peek();
    if (next.newline_before) {
      in_.error(name.at, fmt::format("'{}' has no value, write #define {} 1 or remove it", name.text, name.text));
      return true;
    }
    if (next.is("(") && next.at.offset == name.at.offset + name.at.length) {
      in_.error(name.at, "macros with arguments are not known here, write the values out");
      out_.broken.emplace(name.text);
      skip_line();
      return true;
    }
    auto value = values_.expression(true);
    if (value && !in_.peek().newline_before && !in_.accept(";")) {
      in_.error(in_.peek().at, fmt::format("expected the end of the line behind the value, found {}",
                                           TokenReader::spelled(in_.peek())));
      value.reset();
    }
    if (value) {
      out_.items.emplace_back(ast::Define{{std::string(name.text), name.at}, std::move(*value), description(begin)});
    } else {
      out_.broken.emplace(name.text);
    }
    skip_line();
    return true;
  }

  // ---- declarations

  std::optional<ast::Declaration> declaration(bool in_struct) {
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
    result.description = description(begin);
    if (!finished) {
      recover(in_.position(), in_struct);
    }
    return result;
  }

  // A type alone is a declaration if it has a name or is an enum.
  [[nodiscard]] bool declarators_follow(const ast::Declaration& found, bool in_struct) const noexcept {
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
    // On a new line: the variable's name, or already the next declaration?
    const Token& after = in_.peek(1);
    return next.kind == TokenKind::Identifier && !is_type_word(next.text) && !contains(kStarters, next.text) &&
           (after.newline_before || (after.kind != TokenKind::Identifier && !after.is(".") && !after.is("::")));
  }

  // A declaration ends with ';' or with its line.
  bool finish(std::string_view what) {
    if (in_.accept(";") || in_.at_end() || in_.peek().newline_before || in_.peek().is("}")) {
      return true;
    }
    in_.error(in_.peek().at,
              fmt::format("expected ';' or a new line behind {}, found {}", what, TokenReader::spelled(in_.peek())));
    return false;
  }

  std::optional<ast::TypeSpec> type_spec() {
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

  std::optional<ast::TypeSpec> base_type() {
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
                                       : "these words are no type together, use a type such as int32_t or double");
      return std::nullopt;
    }
    result.base = *base;
    return result;
  }

  std::optional<ast::TypeSpec> tagged_type(bool is_struct) {
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

  bool struct_body(ast::TypeSpec& to) {
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

  bool enum_body(ast::TypeSpec& to) {
    auto body = std::make_shared<ast::EnumBody>();
    while (!in_.accept("}")) {
      const Token& name = in_.peek();
      if (name.kind != TokenKind::Identifier) {
        in_.error(name.at,
                  fmt::format("expected the name of a value of the enum, found {}", TokenReader::spelled(name)));
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

  std::optional<ast::Declarator> declarator(bool in_struct) {
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

  bool declared_name(ast::Declarator& to, bool required) {
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

  bool dimensions(ast::Declarator& to) {
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

  // On a new line an annotation belongs to this declaration only if that goes on behind it.
  bool trailing_annotations(ast::Declarator& to) {
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

  bool function(ast::Declarator& to) {
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

  // Before or behind the annotations.
  bool deadline(ast::Declarator& to) {
    if (!to.is_function || to.deadline || !in_.peek().is("deadline") || in_.peek().newline_before) {
      return true;
    }
    in_.take();
    to.deadline = values_.expression();
    return to.deadline.has_value();
  }

  // ---- descriptions

  // The comment behind the declaration that began with token `begin` and has just been read, else the one above it.
  std::string description(std::size_t begin) {
    const std::size_t here = in_.position();
    const Span last = in_.previous().at;
    const std::uint32_t end = last.offset + last.length;
    const std::uint32_t line = sources_.line_of(last);
    const auto first_behind = std::lower_bound(comments_.begin(), comments_.end(), end,
                                               [](const Comment& c, std::uint32_t at) { return c.offset < at; });
    if (first_behind != comments_.end() && first_behind->first_line == line &&
        first_behind->offset < in_.peek().at.offset && !first_behind->text.empty()) {
      return first_behind->text;
    }
    in_.rewind(begin);
    const Span first = in_.peek().at;
    in_.rewind(here);
    return comment_above(sources_.line_of(first), first.offset);
  }

  [[nodiscard]] std::string comment_above(std::uint32_t line, std::uint32_t offset) const {
    const std::string file_name = sources_.file(file_).path.substr(sources_.file(file_).path.rfind('/') + 1);
    std::string text;
    auto i = std::lower_bound(comments_.begin(), comments_.end(), offset,
                              [](const Comment& c, std::uint32_t at) { return c.offset < at; });
    while (i != comments_.begin()) {
      --i;
      if (!i->own_line || i->last_line + 1 != line || i->text == file_name) {
        break;
      }
      text = text.empty() || i->text.empty() ? i->text + text : i->text + " " + text;
      line = i->first_line;
    }
    return text;
  }

  const Sources& sources_;
  std::uint32_t file_;
  const std::vector<Comment>& comments_;
  TokenReader in_;
  ExpressionParser values_;
  ast::File out_;
  int depth_ = 0;
  int ignored_braces_ = 0;  // of namespaces, already reported
};

}  // namespace

ast::File parse(const Sources& sources, std::uint32_t file, const Tokens& tokens, Diagnostics& diagnostics) {
  return Parser(sources, file, tokens, diagnostics).run();
}

}  // namespace indurop::glb2idl
