// SPDX-License-Identifier: Apache-2.0
// Splits a .glb text into tokens and comments. Knows characters, not grammar.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glb2idl/diagnostics.h"
#include "glb2idl/source.h"

namespace indurop::glb2idl {

enum class TokenKind : std::uint8_t { End, Identifier, Number, Text, Character, Symbol };

struct Token {
  TokenKind kind = TokenKind::End;
  bool newline_before = true;  // there is a line break, not escaped by a backslash, before this token
  Span at;
  std::string_view text;  // spelling, including quotes

  [[nodiscard]] bool is(std::string_view symbol) const noexcept {
    return (kind == TokenKind::Symbol || kind == TokenKind::Identifier) && text == symbol;
  }
};

struct Comment {
  std::uint32_t offset = 0;
  int first_line = 0;
  int last_line = 0;
  bool own_line = false;  // the comment is the first thing on its line
  std::string text;       // cleaned: no comment marks, one line, blanks collapsed
};

struct Tokens {
  std::vector<Token> list;  // ends with TokenKind::End
  std::vector<Comment> comments;
};

// Reports characters that cannot be a token and continues after them. The views refer to `sources`, which must outlive
// the tokens.
[[nodiscard]] Tokens tokenize(const Sources& sources, std::uint32_t file, Diagnostics& diagnostics);

}  // namespace indurop::glb2idl
