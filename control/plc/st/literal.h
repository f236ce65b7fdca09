// SPDX-License-Identifier: Apache-2.0
// Evaluates the literals of IEC 61131-3: numbers in any base, times, dates, texts with $ escapes, direct addresses.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "control/plc/model/ast.h"

namespace indurop::plc::st {

// The value of a literal, or in `why` what is wrong with it and what to do.
struct Literal {
  std::optional<ast::LiteralValue> value;
  std::optional<Elementary> type;  // INT#5, T#1s; none: 5, 1.5
  bool negative = false;           // INT#-5: the value is 5
  std::string why;
};

// "12", "1_000", "16#FF", "1.5E3"
[[nodiscard]] Literal number_literal(std::string_view text);
// Evaluates "INT#16#FF", "BOOL#1", "T#1h2m3.5s", "TOD#12:30:00"; "STRING#" is not one. No value and no `why`: the
// prefix is not an elementary type ("Color#Red").
[[nodiscard]] Literal typed_literal(std::string_view text);
// Decodes "'it$'s$N'" without its quotes and escapes; in double quotes it is a WSTRING, whose value is UTF-8, too.
[[nodiscard]] Literal text_literal(std::string_view quoted);
// Returns the address "%IX0.3"; none if it is not one.
[[nodiscard]] std::optional<ast::DirectAddress> address_literal(std::string_view text);

}  // namespace indurop::plc::st
