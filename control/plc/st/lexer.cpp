// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "control/plc/st/letters.h"
#include "core/base/utf8.h"

namespace indurop::plc::st {
namespace {

constexpr std::array<std::string_view, 9> kTwoCharacterSymbols{":=", "::", "=>", "<=", ">=", "<>", "**", "..", "?="};
constexpr std::string_view kSymbols = "+-*/&=<>()[],;:.^#|";

std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view kBlank = " \t\r\n*-=";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r\n*") - first + 1);
}

// Pragmas of editors that define how to show, check and export the program, or which parts of it are used.
constexpr std::array<std::string_view, 22> kPragmas{
    "ATTRIBUTE", "REGION", "ENDREGION", "WARNING",  "TEXT",    "INFO",  "ERROR",  "DEFINE",
    "UNDEFINE",  "ENABLE", "DISABLE",   "ANALYSIS", "LIBRARY", "FLOW",  "NOFLOW", "IMPLICIT",
    "OBSOLETE",  "PACK",   "IF",        "ELSIF",    "ELSE",    "END_IF"};

// Returns true for "extern long __tick; TX = __tick;", which Beremiz and OpenPLC pass to their C compiler.
bool is_c_code(std::string_view pragma) {
  pragma = trimmed(pragma);
  const auto* const end = std::find_if_not(pragma.begin(), pragma.end(), is_word);
  const std::string first = upper(pragma.substr(0, static_cast<std::size_t>(end - pragma.begin())));
  if (std::find(kPragmas.begin(), kPragmas.end(), first) != kPragmas.end()) {
    return false;
  }
  char quote = '\0';
  char before = '\0';
  for (const char c : pragma) {
    if (quote == '\0' && (c == ';' || c == '(' || (c == '=' && before != ':'))) {
      return true;
    }
    quote = quote == c ? '\0' : quote == '\0' && (c == '\'' || c == '"') ? c : quote;
    before = c;
  }
  return pragma.starts_with('#') || pragma.find("++") != std::string_view::npos;
}

class Lexer {
 public:
  Lexer(std::string_view text, const Place& at, Diagnostics& diagnostics)
      : text_(text),
        origin_(at),
        diagnostics_(diagnostics),
        line_(std::max(at.line, 1)),
        column_(std::max(at.column, 1)) {}

  std::vector<Token> run() {
    if (text_.starts_with("\xEF\xBB\xBF")) {
      at_ = 3;
    }
    while (at_ < text_.size()) {
      next();
    }
    begin();
    push(TokenKind::End);
    out_.back().follows_error = broken_;
    return std::move(out_);
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const noexcept {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void step(std::size_t count = 1) noexcept {
    for (; count > 0 && at_ < text_.size(); --count, ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        column_ = 1;
      } else if (!base::continues_utf8(text_[at_])) {
        ++column_;
      }
    }
  }
  void begin() noexcept {
    from_ = at_;
    from_line_ = line_;
    from_column_ = column_;
  }
  void push(TokenKind kind) {
    const std::string_view written = text_.substr(from_, at_ - from_);
    out_.push_back({kind, written, written, from_line_, from_column_, comment_, comment_line_});
    comment_ = {};
    comment_line_ = 0;
  }
  void follow_error(std::size_t last) {
    std::for_each(out_.end() - static_cast<std::ptrdiff_t>(last), out_.end(),
                  [](Token& one) { one.follows_error = true; });
  }
  void error(std::string text) {
    Place place = origin_;
    place.line = from_line_;
    place.column = from_column_;
    diagnostics_.error(place, std::move(text));
  }

  void next() {
    const char c = peek();
    begin();
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v') {
      step();
    } else if (c == '/' && peek(1) == '/') {
      line_comment();
    } else if ((c == '(' || c == '/') && peek(1) == '*') {
      block_comment(c == '(' ? ')' : '/');
    } else if (c == '{') {
      pragma();
    } else if (is_letter(c)) {
      word();
    } else if (is_digit(c)) {
      number();
      push(TokenKind::Number);
    } else if (c == '%' && is_letter(peek(1))) {
      address();
    } else if (c == '\'' || c == '"') {
      quoted(c, TokenKind::Text);
    } else {
      symbol();
    }
  }

  void line_comment() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    remember(text_.substr(at_ + 2, end - at_ - 2));
    step(end - at_);
  }

  void block_comment(char close) {
    const std::array<char, 2> mark{'*', close};
    const std::string_view end(mark.data(), mark.size());
    if (text_.substr(at_, 6) == "(*DBG:") {  // C code of the OpenPLC Editor 4, each line of which is a comment
      const std::size_t line = std::min(text_.find('\n', at_), text_.size());
      const std::size_t last = text_.substr(at_, line - at_).rfind(end);
      if (last != std::string_view::npos) {
        step(last + end.size());
        return;
      }
    }
    std::size_t length = nested_ ? nested_comment(end) : 0;
    if (length == 0) {
      nested_ = false;
      const std::size_t first = text_.find(end, at_ + 2);
      length = first == std::string_view::npos ? 0 : first + end.size() - at_;
    }
    if (length == 0) {
      error(fmt::format("this comment has no end, close it with {}", end));
      step(text_.size() - at_);
      broken_ = true;
      return;
    }
    step(length);
    remember(text_.substr(from_ + 2, at_ - from_ - 4));
  }

  // Returns the length of a comment; comments of one kind may be nested. 0 if that gives no end: then the first end is
  // used from there on, as in older editions of the standard.
  [[nodiscard]] std::size_t nested_comment(std::string_view end) const noexcept {
    int depth = 0;
    for (std::size_t at = at_; at + 1 < text_.size(); ++at) {
      if (text_[at] == text_[at_] && text_[at + 1] == '*') {
        ++depth;
        ++at;
      } else if (text_.substr(at, 2) == end) {
        --depth;
        ++at;
      }
      if (depth == 0) {
        return at + 1 - at_;
      }
    }
    return 0;
  }

  void remember(std::string_view text) noexcept {
    comment_ = trimmed(text);
    comment_line_ = comment_.empty() ? 0 : from_line_;
  }

  // Rejects pragmas that change the program and skips others.
  void pragma() {
    const bool twice = peek(1) == '{';
    const std::string_view close = twice ? "}}" : "}";
    const std::size_t end = text_.find(close, at_);
    const bool c_code = twice || (end != std::string_view::npos && is_c_code(text_.substr(at_ + 1, end - at_ - 1)));
    if (end == std::string_view::npos) {
      error(fmt::format("this pragma has no end, close it with {}", close));
    } else if (c_code) {
      step(end + close.size() - at_);
      push(TokenKind::CCode);
      return;
    } else if (const std::string word = upper(trimmed(text_.substr(at_ + 1, end - at_ - 1)).substr(0, 3));
               word.starts_with("IF") || word == "ELS") {
      error("conditional compilation is not supported, keep the text that is wanted");
    }
    step(end == std::string_view::npos ? text_.size() - at_ : end + close.size() - at_);
  }

  void word() {
    while (is_word(peek())) {
      step();
    }
    if (peek() != '#') {
      push(TokenKind::Word);
      return;
    }
    const std::string prefix = upper(text_.substr(from_, at_ - from_));
    step();
    const char quote = peek();
    if ((prefix == "STRING" && quote == '\'') || (prefix == "WSTRING" && quote == '"')) {  // STRING#'OK' is 'OK'
      begin();
      quoted(quote, TokenKind::Text);
      return;
    }
    if ((prefix == "CHAR" || prefix == "WCHAR") && (quote == '\'' || quote == '"')) {
      quoted(quote, TokenKind::Typed);
      return;
    }
    typed(prefix);
    push(TokenKind::Typed);
  }

  // Reads the text after "INT#", "T#", "D#", "Color#".
  void typed(std::string_view prefix) {
    const auto skip = [this](std::string_view others) {
      while (is_word(peek()) || (others.find(peek()) != std::string_view::npos && peek() != '\0')) {
        step();
      }
    };
    if (prefix == "D" || prefix == "DATE" || prefix == "LD" || prefix == "LDATE") {
      skip("-");
    } else if (prefix == "DT" || prefix == "DATE_AND_TIME" || prefix == "LDT" || prefix == "LDATE_AND_TIME") {
      skip("-:.");
    } else if (prefix == "TOD" || prefix == "TIME_OF_DAY" || prefix == "LTOD" || prefix == "LTIME_OF_DAY") {
      skip(":.");
    } else if (prefix == "T" || prefix == "TIME" || prefix == "LT" || prefix == "LTIME") {
      step(peek() == '-' || peek() == '+' ? 1 : 0);
      skip(".");
    } else {
      step((peek() == '-' || peek() == '+') && is_digit(peek(1)) ? 1 : 0);
      if (is_digit(peek())) {
        number();
      } else {
        skip("");
      }
    }
  }

  // Reads 12, 16#FF, 1.5, 1.5E-3; not the dots of 1..5.
  void number() {
    const auto digits = [this] {
      while (is_word(peek())) {
        step();
      }
    };
    digits();
    if (peek() == '#') {
      step();
      digits();
      return;
    }
    if (peek() == '.' && is_digit(peek(1))) {
      step();
      digits();
    }
    const char last = text_[at_ - 1];
    if ((last == 'e' || last == 'E') && (peek() == '+' || peek() == '-') && is_digit(peek(1))) {
      step();
      digits();
    }
  }

  void address() {
    step();
    while (is_word(peek()) || (peek() == '.' && is_digit(peek(1)))) {
      step();
    }
    step(peek() == '*' ? 1 : 0);  // %I*
    push(TokenKind::Address);
  }

  void quoted(char quote, TokenKind kind) {
    step();
    while (peek() != quote) {
      if (at_ >= text_.size() || peek() == '\n') {
        error(fmt::format("this text has no end, close it with {} on the same line", quote));
        push(TokenKind::Text);
        out_.back().text = quote == '"' ? "\"\"" : "''";
        push(TokenKind::Symbol);
        out_.back().text = ";";
        follow_error(2);
        return;
      }
      step(peek() == '$' && peek(1) != '\n' ? 2 : 1);
    }
    step();
    push(kind);
  }

  void symbol() {
    const std::string_view two = text_.substr(at_, 2);
    if (std::find(kTwoCharacterSymbols.begin(), kTwoCharacterSymbols.end(), two) != kTwoCharacterSymbols.end()) {
      step(2);
      push(TokenKind::Symbol);
      return;
    }
    const char c = peek();
    if (c != '\0' && kSymbols.find(c) != std::string_view::npos) {
      step();
      push(TokenKind::Symbol);
      return;
    }
    // One message for a run of such characters: a binary file has thousands.
    while (at_ < text_.size() && (static_cast<unsigned char>(peek()) >= 0x80 ||
                                  (static_cast<unsigned char>(peek()) < 0x20 && peek() != '\n') || peek() == c)) {
      step();
    }
    if (c == '\0') {
      error("a NUL byte, is this a text file?");
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      error("only ASCII letters, digits and '_' outside of comments and texts, replace it");
    } else {
      error("this character has no meaning here, remove it");
    }
  }

  std::string_view text_;
  const Place& origin_;
  Diagnostics& diagnostics_;
  std::vector<Token> out_;
  std::size_t at_ = 0;
  int line_;
  int column_;
  std::size_t from_ = 0;
  int from_line_ = 1;
  int from_column_ = 1;
  std::string_view comment_;
  int comment_line_ = 0;
  bool broken_ = false;  // a comment has no end: the text ends there
  bool nested_ = true;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, const Place& at, Diagnostics& diagnostics) {
  return Lexer(text, at, diagnostics).run();
}

}  // namespace indurop::plc::st
