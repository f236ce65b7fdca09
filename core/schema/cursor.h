// SPDX-License-Identifier: Apache-2.0
// Internal to core/schema/: scans the text of a value. Knows letters, words, quotes and escapes, but no types.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace indurop::schema {

// One character of a quoted text: a plain byte (or one written \xNN), or a Unicode character written \uNNNN.
struct Character {
  std::uint32_t code = 0;
  bool unicode = false;
};

class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const noexcept { return at_ == text_.size(); }
  [[nodiscard]] std::size_t column() const noexcept { return at_ + 1; }
  [[nodiscard]] std::string_view all() const noexcept { return text_; }
  [[nodiscard]] std::string_view rest() const noexcept { return text_.substr(at_); }

  void skip_spaces() noexcept;
  // Returns the next character after blanks, NUL at the end.
  char peek() noexcept;
  // Skips `c` if it is next after blanks.
  bool take(char c) noexcept;
  // Returns the letters up to a blank, bracket, comma or quote; `stop` ends it too. May be empty.
  std::string_view word(char stop = ' ') noexcept;

  // Returns true if a quote is next, as the two functions below require. They return null, or the error at column().
  bool at_quote() noexcept;
  const char* quoted(std::string& to);
  const char* quoted_unit(Character& to);

 private:
  const char* unit(Character& to);
  const char* escape(Character& to);

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace indurop::schema
