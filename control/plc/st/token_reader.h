// SPDX-License-Identifier: Apache-2.0
// Reads tokens one by one: look ahead, accept, or expect with a message. Shared by the parts of the parser.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/plc/model/identifier.h"
#include "control/plc/st/lexer.h"

namespace indurop::plc::st {

// Parse functions that use it report missing tokens and then return nullopt or false.
class TokenReader {
 public:
  TokenReader(const std::vector<Token>& tokens, const Place& origin, Diagnostics& diagnostics)
      : tokens_(tokens), origin_(origin), diagnostics_(diagnostics) {}

  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const noexcept {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] const Token& previous() const noexcept { return tokens_[at_ == 0 ? 0 : at_ - 1]; }
  [[nodiscard]] bool at_end() const noexcept { return peek().kind == TokenKind::End; }
  [[nodiscard]] std::size_t position() const noexcept { return at_; }

  [[nodiscard]] Place place(const Token& token) const {
    Place out = origin_;
    out.line = token.line;
    out.column = token.column;
    return out;
  }
  [[nodiscard]] Place here() const { return place(peek()); }

  const Token& take() noexcept {
    const Token& token = peek();
    at_ += at_end() ? 0U : 1U;
    return token;
  }
  [[nodiscard]] bool next_is(std::initializer_list<std::string_view> words) const noexcept {
    return std::any_of(words.begin(), words.end(), [this](std::string_view word) { return peek().is(word); });
  }
  bool accept(std::string_view word) noexcept {
    const bool found = peek().is(word);
    at_ += found ? 1U : 0U;
    return found;
  }
  // Reports "expected '<word>' <where>" if the word is not next.
  bool expect(std::string_view word, std::string_view where) {
    if (accept(word)) {
      return true;
    }
    if (peek().is(":=") && (word == ")" || word == "THEN" || word == "DO" || word == "OF")) {
      error(peek(), "an assignment inside of an expression (ExST) is not supported, write it as a statement before");
    } else {
      missing(fmt::format("expected '{}' {}", word, where));
    }
    return false;
  }
  // Expects the ';' after a statement or declaration. If it is missing at the end of a line, that is reported and
  // reading continues.
  bool expect_end(std::string_view where) { return expect(";", where) || (at_ > 0 && peek().line > previous().line); }
  // Expects a name that is not a keyword; reports "expected the name of <what>".
  [[nodiscard]] bool expect_name(std::string_view what) {
    if (peek().kind == TokenKind::Word && !is_keyword(peek().text)) {
      return true;
    }
    const bool reserved = peek().kind == TokenKind::Word;
    error(peek(), fmt::format("expected the name of {}, found {}{}", what, spelled(peek()),
                              reserved ? ", which is a word of the language" : ""));
    return false;
  }

  // Reports a missing token: after the last token if the line ended, else at the token found instead.
  void missing(const std::string& text) {
    const Token& last = previous();
    if (at_ == 0 || peek().line == last.line || peek().follows_error) {
      error(peek(), fmt::format("{}, found {}", text, spelled(peek())));
      return;
    }
    Place at = place(last);
    at.column += static_cast<int>(last.text.size());
    diagnostics_.error(at, text);
  }
  void error(const Token& at, std::string text) {
    if (!at.follows_error) {
      diagnostics_.error(place(at), std::move(text));
    }
  }
  void error(const Place& at, std::string text) { diagnostics_.error(at, std::move(text)); }

  // Reports a feature of the language that is not supported: once, and the project is not checked any further.
  void unsupported(const Token& at, std::string text) {
    left_out_ = true;
    error(at, std::move(text));
  }
  [[nodiscard]] bool left_out() const noexcept { return left_out_; }
  // Skips to the position after the word, or to the end of the text.
  void skip_behind(std::string_view word) noexcept {
    while (!at_end() && !take().is(word)) {
    }
  }

  // Reports List<INT>, of function blocks with VAR_GENERIC.
  void refuse_generic() {
    if (!peek().is("<")) {
      return;
    }
    unsupported(
        peek(),
        "what has VAR_GENERIC is not supported, use VAR_IN_OUT with ARRAY[*], or a function block for each size");
    for (int open = 0; !at_end() && !next_is({";", "END_VAR"});) {
      const Token& token = take();
      open += token.is("<") ? 1 : token.is(">") ? -1 : 0;
      if (open == 0) {
        return;
      }
    }
  }

  // Returns true for END_IF and the like: the end of a construct around a list of statements or declarations.
  [[nodiscard]] static bool is_end_word(const Token& token) noexcept {
    return token.kind == TokenKind::Word && token.text.size() > 4 && same_name(token.text.substr(0, 4), "END_") &&
           is_keyword(token.text);
  }

  void warning(const Place& at, std::string text) { diagnostics_.warning(at, std::move(text)); }

  [[nodiscard]] static std::string spelled(const Token& token) {
    constexpr std::size_t kShown = 40;
    if (token.kind == TokenKind::End) {
      return "the end of the text";
    }
    if (token.kind == TokenKind::Text) {
      return "a text";
    }
    return fmt::format("'{}{}'", token.text.substr(0, kShown), token.text.size() > kShown ? "..." : "");
  }

 private:
  const std::vector<Token>& tokens_;
  const Place& origin_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  bool left_out_ = false;
};

}  // namespace indurop::plc::st
