// SPDX-License-Identifier: Apache-2.0
// Parses the items of a file: namespaces, includes, #define, pools; everything else is a declaration.

#include "glb2idl/parser.h"

#include <utility>

#include "glb2idl/declaration_parser.h"
#include "glb2idl/text.h"
#include "glb2idl/type_words.h"

namespace indurop::glb2idl {
namespace {

class Parser {
 public:
  Parser(const Sources& sources, std::uint32_t file, const Tokens& tokens, Diagnostics& diagnostics)
      : in_(tokens, diagnostics),
        values_(in_),
        descriptions_(sources, file, tokens.comments),
        declarations_(in_, values_, descriptions_, out_.broken) {}

  ast::File run() {
    while (!in_.at_end()) {
      const std::size_t before = in_.position();
      if (!item()) {
        declarations_.recover(before, false);
      }
    }
    return std::move(out_);
  }

 private:
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
    if (in_.peek().is("pool") && in_.peek(1).kind == TokenKind::Identifier && in_.peek(2).is("{") &&
        !in_.peek(1).is("struct")) {
      in_.error(
          in_.peek(1).at,
          fmt::format("the type of a pool's chunks comes first, write pool struct {{ ... }} {}[4];", in_.peek(1).text));
      return false;
    }
    const bool is_pool = pool_follows();
    if (is_pool) {
      in_.take();
    }
    auto found = declarations_.declaration(false);
    if (found && is_pool) {
      out_.items.emplace_back(ast::Pool{std::move(*found)});
    } else if (found) {
      out_.items.emplace_back(std::move(*found));
    }
    return found.has_value();
  }

  // "pool" is a word in front of a type only; elsewhere it is a name, also that of a type: pool x;
  [[nodiscard]] bool pool_follows() const {
    const Token& type = in_.peek(1);
    if (!in_.peek().is("pool") || type.newline_before) {
      return false;
    }
    const bool is_named = type.kind == TokenKind::Identifier &&
                          (in_.peek(2).kind == TokenKind::Identifier || in_.peek(2).is(".") || in_.peek(2).is("::"));
    return is_named || type.is("struct") || type.is("@") || is_type_word(type.text);
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
    return declarations_.finish("the namespace");
  }

  bool include() {
    const Token& name = in_.take();
    auto decoded = decode_quoted(name.text);
    if (!decoded || decoded->empty() || decoded->find('\0') != std::string::npos) {
      in_.error(name.at, "not a file name, write include \"other.glb\";");
      return false;
    }
    out_.items.emplace_back(ast::Include{name.at, std::move(*decoded)});
    return declarations_.finish("the include");
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
      in_.error(in_.peek().at, fmt::format("expected the end of the line after the value, found {}",
                                           TokenReader::spelled(in_.peek())));
      value.reset();
    }
    if (value) {
      out_.items.emplace_back(
          ast::Define{{std::string(name.text), name.at}, std::move(*value), descriptions_.find(in_, begin)});
    } else {
      out_.broken.emplace(name.text);
    }
    skip_line();
    return true;
  }

  ast::File out_;
  TokenReader in_;
  ExpressionParser values_;
  Descriptions descriptions_;
  DeclarationParser declarations_;
  int ignored_braces_ = 0;  // of namespaces, already reported
};

}  // namespace

ast::File parse(const Sources& sources, std::uint32_t file, const Tokens& tokens, Diagnostics& diagnostics) {
  return Parser(sources, file, tokens, diagnostics).run();
}

}  // namespace indurop::glb2idl
