// SPDX-License-Identifier: Apache-2.0
// Splits Structured Text into tokens. It knows characters and the forms of literals, not grammar.

#pragma once

#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/elementary.h"

namespace indurop::plc::st {

enum class TokenKind : std::uint8_t {
  End,
  Word,     // identifier or keyword
  Number,   // 12, 1_000, 16#FF, 1.5E3
  Typed,    // prefix#rest: INT#5, T#1h2m, D#2024-01-01, Color#Red
  Text,     // 'str$N', quotes included
  Address,  // %IX0.0
  Symbol,
  CCode,  // {{ ... }}, or { ... } with statements of C
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;     // spelling
  std::string_view written;  // position in the file; for a generated token, of the text that it replaces
  int line = 1;
  int column = 1;
  std::string_view comment;    // the last one between the previous token and this one; without its delimiters
  int comment_line = 0;        // line where it begins; 0: none
  bool follows_error = false;  // replaces unreadable text: errors caused by that were reported

  // Compares with a keyword in any case.
  [[nodiscard]] bool is(std::string_view word) const noexcept {
    return (kind == TokenKind::Word || kind == TokenKind::Symbol) && same_name(text, word);
  }
};

// Returns a list that ends with TokenKind::End. Reports text that cannot be a token and continues after it. The views
// refer to `text`. `at` is the place of the first character.
[[nodiscard]] std::vector<Token> tokenize(std::string_view text, const Place& at, Diagnostics& diagnostics);

}  // namespace indurop::plc::st
