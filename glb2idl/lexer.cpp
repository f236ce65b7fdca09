// SPDX-License-Identifier: Apache-2.0
// Splits a .glb text into tokens and comments.

#include "glb2idl/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/utf8.h"

namespace indurop::glb2idl {
namespace {

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

constexpr std::array<std::string_view, 10> kTwoCharacterSymbols{
    "::", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "->"};
constexpr std::string_view kSymbols = "{}[]()<>;,=.:@#+-*/%&|^!~?";

// Returns the text of a comment for people, without marks, leading stars, repeated blanks and rulers.
std::string clean(std::string_view raw) {
  std::string out;
  const auto is_ruler = [](std::string_view word) {
    return word.size() > 2 && word.find_first_not_of("-=*#/~_+.<!") == std::string_view::npos && word != "...";
  };
  for (std::size_t i = 0; i < raw.size();) {
    const std::size_t end = std::min(raw.find('\n', i), raw.size());
    std::string_view line = raw.substr(i, end - i);
    const std::size_t start = line.find_first_not_of(" \t\r*/!<");
    line.remove_prefix(std::min(start, line.size()));
    while (!line.empty()) {
      const std::size_t length = std::min(line.find_first_of(" \t\r\f\v"), line.size());
      const std::string_view word = line.substr(0, length);
      if (!word.empty() && !is_ruler(word)) {
        out += out.empty() ? "" : " ";
        out += word;
      }
      line.remove_prefix(std::min(length + 1, line.size()));
    }
    i = end + 1;
  }
  return out;
}

class Lexer {
 public:
  Lexer(const Sources& sources, std::uint32_t file, Diagnostics& diagnostics)
      : sources_(sources), file_(file), text_(sources.file(file).text), diagnostics_(diagnostics) {}

  Tokens run() {
    check_encoding();
    while (at_ < text_.size()) {
      next();
    }
    Token end;
    end.at = span(text_.empty() ? 0 : text_.size() - 1, text_.size());
    end.text = "end of file";
    out_.list.push_back(end);
    return std::move(out_);
  }

 private:
  [[nodiscard]] Span span(std::size_t from, std::size_t to) const noexcept {
    return {file_, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
  }
  [[nodiscard]] char peek(std::size_t ahead = 0) const noexcept {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void check_encoding() {
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
      diagnostics_.error(span(0, 1), "the file is UTF-16, save it as UTF-8");
      at_ = text_.size();
      return;
    }
    if (const auto bad = base::first_invalid_utf8(text_)) {
      diagnostics_.error(span(*bad, *bad + 1), "this is not UTF-8, save the file as UTF-8");
    }
  }

  void push(TokenKind kind, std::size_t from) {
    Token token;
    token.kind = kind;
    token.newline_before = newline_;
    token.at = span(from, at_);
    token.text = text_.substr(from, at_ - from);
    out_.list.push_back(token);
    newline_ = false;
    line_used_ = true;
  }

  void next() {
    const char c = peek();
    if (c == '\n') {
      ++at_;
      newline_ = true;
      line_used_ = false;
    } else if (is_blank(c)) {
      ++at_;
    } else if (c == '\\' && (peek(1) == '\n' || (peek(1) == '\r' && peek(2) == '\n'))) {
      at_ += peek(1) == '\n' ? 2U : 3U;
    } else if (c == '/' && (peek(1) == '/' || peek(1) == '*')) {
      comment();
    } else if (is_letter(c)) {
      const std::size_t from = at_;
      while (is_letter(peek()) || is_digit(peek())) {
        ++at_;
      }
      push(TokenKind::Identifier, from);
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      number();
    } else if (c == '"' || c == '\'') {
      quoted(c);
    } else {
      symbol();
    }
  }

  void number() {
    const std::size_t from = at_;
    while (is_letter(peek()) || is_digit(peek()) || peek() == '.' || (peek() == '\'' && is_digit(peek(1))) ||
           ((peek() == '+' || peek() == '-') && exponent_before(from))) {
      ++at_;
    }
    push(TokenKind::Number, from);
  }
  [[nodiscard]] bool exponent_before(std::size_t from) const noexcept {
    const char before = text_[at_ - 1];
    const bool hex = text_.substr(from, 2) == "0x" || text_.substr(from, 2) == "0X";
    return hex ? before == 'p' || before == 'P' : before == 'e' || before == 'E';
  }

  void quoted(char quote) {
    const std::size_t from = at_++;
    while (peek() != quote) {
      if (at_ >= text_.size() || peek() == '\n') {
        diagnostics_.error(span(from, from + 1),
                           fmt::format("this text has no end, close it with {} on the same line", quote));
        newline_ = false;
        line_used_ = true;
        return;
      }
      at_ += peek() == '\\' && peek(1) != '\n' ? 2U : 1U;
    }
    ++at_;
    push(quote == '"' ? TokenKind::Text : TokenKind::Character, from);
  }

  void symbol() {
    const std::size_t from = at_;
    const std::string_view two = text_.substr(at_, 2);
    if (std::find(kTwoCharacterSymbols.begin(), kTwoCharacterSymbols.end(), two) != kTwoCharacterSymbols.end()) {
      at_ += 2;
      push(TokenKind::Symbol, from);
      return;
    }
    if (kSymbols.find(peek()) != std::string_view::npos && peek() != '\0') {
      ++at_;
      push(TokenKind::Symbol, from);
      return;
    }
    const char c = peek();
    do {
      ++at_;
    } while (at_ < text_.size() && base::continues_utf8(peek()));
    if (c == '\0') {
      diagnostics_.error(span(from, at_), "a NUL byte, is this a text file?");
      while (peek() == '\0' && at_ < text_.size()) {
        ++at_;
      }
    } else if (static_cast<unsigned char>(c) < 0x80) {
      diagnostics_.error(span(from, at_), "this character has no meaning here, remove it");
    } else if (!base::first_invalid_utf8(text_.substr(from, at_ - from))) {
      diagnostics_.error(span(from, from + 1),
                         "only ASCII letters, digits and '_' outside of comments and texts, replace it");
    }
  }

  void comment() {
    Comment found;
    const std::size_t from = at_;
    const bool block = peek(1) == '*';
    std::size_t end = block ? text_.find("*/", at_ + 2) : text_.find('\n', at_);
    if (end == std::string_view::npos) {
      if (block) {
        diagnostics_.error(span(from, from + 2), "this comment has no end, close it with */");
      }
      end = text_.size();
    }
    found.offset = static_cast<std::uint32_t>(from);
    found.first_line = sources_.line_of(span(from, from));
    found.own_line = !line_used_;
    const std::string_view body = text_.substr(from + 2, end - std::min(end, from + 2));
    found.last_line = found.first_line + static_cast<int>(std::count(body.begin(), body.end(), '\n'));
    found.text = base::first_invalid_utf8(body) ? std::string() : clean(body);
    std::erase_if(found.text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    at_ = std::min(text_.size(), block ? end + 2 : end);
    if (block && found.last_line > found.first_line) {
      newline_ = true;
      line_used_ = false;
    }
    out_.comments.push_back(std::move(found));
  }

  const Sources& sources_;
  std::uint32_t file_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  Tokens out_;
  std::size_t at_ = 0;
  bool newline_ = true;
  bool line_used_ = false;
};

}  // namespace

Tokens tokenize(const Sources& sources, std::uint32_t file, Diagnostics& diagnostics) {
  return Lexer(sources, file, diagnostics).run();
}

}  // namespace indurop::glb2idl
