// SPDX-License-Identifier: Apache-2.0
// Steps through tokens: looks ahead, accepts, expects with a message. Shared by the parts of the parser.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "glb2idl/lexer.h"

namespace indurop::glb2idl {

// Parse functions that use it report a missing token and then return nullopt or false.
class TokenReader {
 public:
  TokenReader(const Tokens& tokens, Diagnostics& diagnostics) : tokens_(tokens.list), diagnostics_(diagnostics) {}

  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const noexcept {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] const Token& previous() const noexcept { return tokens_[at_ == 0 ? 0 : at_ - 1]; }
  [[nodiscard]] const Token& at(std::size_t position) const noexcept { return tokens_[position]; }
  [[nodiscard]] bool at_end() const noexcept { return peek().kind == TokenKind::End; }
  [[nodiscard]] std::size_t position() const noexcept { return at_; }
  void rewind(std::size_t position) noexcept { at_ = position; }

  const Token& take() noexcept {
    const Token& token = peek();
    if (!at_end()) {
      ++at_;
    }
    return token;
  }
  bool accept(std::string_view symbol) noexcept {
    if (!peek().is(symbol)) {
      return false;
    }
    take();
    return true;
  }
  // Reports "expected <symbol> <where>" if the symbol is not next.
  bool expect(std::string_view symbol, std::string_view where) {
    if (accept(symbol)) {
      return true;
    }
    const Token& found = peek();
    if (found.newline_before) {  // the line ended too early: report the place after it
      const Span last = previous().at;
      error({last.file, last.offset + last.length, 1}, fmt::format("expected '{}' {}", symbol, where));
    } else {
      error(found.at, fmt::format("expected '{}' {}, found {}", symbol, where, spelled(found)));
    }
    return false;
  }
  void error(Span at, std::string text) { diagnostics_.error(at, std::move(text)); }

  [[nodiscard]] static std::string spelled(const Token& token) {
    constexpr std::size_t kShown = 40;
    if (token.kind == TokenKind::End) {
      return "the end of the file";
    }
    if (token.kind == TokenKind::Text) {
      return "a text";
    }
    return fmt::format("'{}{}'", token.text.substr(0, kShown), token.text.size() > kShown ? "..." : "");
  }

 private:
  const std::vector<Token>& tokens_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

}  // namespace indurop::glb2idl
