// SPDX-License-Identifier: Apache-2.0
#include "core/schema/cursor.h"

#include <charconv>

#include "core/base/utf8.h"

namespace indurop::schema {
namespace {

using namespace std::string_view_literals;

bool is_space(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

}  // namespace

void Cursor::skip_spaces() noexcept {
  while (!at_end() && is_space(text_[at_])) {
    ++at_;
  }
}

char Cursor::peek() noexcept {
  skip_spaces();
  return at_end() ? '\0' : text_[at_];
}

bool Cursor::take(char c) noexcept {
  const bool there = peek() == c && !at_end();
  at_ += there ? 1 : 0;
  return there;
}

std::string_view Cursor::word(char stop) noexcept {
  skip_spaces();
  const std::size_t begin = at_;
  while (!at_end() && !is_space(text_[at_]) && text_[at_] != stop &&
         R"(,[]{}"')"sv.find(text_[at_]) == std::string_view::npos) {
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

bool Cursor::at_quote() noexcept {
  return peek() == '"' || peek() == '\'';
}

const char* Cursor::quoted(std::string& to) {
  if (!at_quote()) {
    return "expected text between quotes";
  }
  const char quote = text_[at_++];
  while (at_end() || text_[at_] != quote) {
    Character c;
    if (const char* wrong = unit(c)) {
      return wrong;
    }
    if (c.unicode) {
      base::append_utf8(to, c.code);
    } else {
      to += static_cast<char>(c.code);
    }
  }
  ++at_;
  return nullptr;
}

const char* Cursor::quoted_unit(Character& to) {
  constexpr const char* kWrong = "expected one character between quotes";
  if (!at_quote()) {
    return kWrong;
  }
  const char quote = text_[at_++];
  if (!at_end() && text_[at_] == quote) {
    return kWrong;
  }
  if (const char* wrong = unit(to)) {
    return wrong;
  }
  if (at_end() || text_[at_] != quote) {
    return kWrong;
  }
  ++at_;
  return nullptr;
}

const char* Cursor::unit(Character& to) {
  if (at_end()) {
    return "the closing quote is missing";
  }
  to = {static_cast<unsigned char>(text_[at_++]), false};
  return to.code == '\\' ? escape(to) : nullptr;
}

// Reads the part of an escape after the backslash.
const char* Cursor::escape(Character& to) {
  constexpr std::string_view kShort = "n\nt\tr\rb\bf\f0\0\\\\\"\"''//"sv;  // letter, then its meaning
  if (at_end()) {
    return "the closing quote is missing";
  }
  const char c = text_[at_];
  if (c == 'x' || c == 'u') {
    const std::size_t digits = c == 'x' ? 2 : 4;
    const char* begin = text_.data() + at_ + 1;
    if (text_.size() - at_ <= digits || std::from_chars(begin, begin + digits, to.code, 16).ptr != begin + digits) {
      return c == 'x' ? "\\x needs 2 hex digits" : "\\u needs 4 hex digits";
    }
    to.unicode = c == 'u';
    at_ += 1 + digits;
    return nullptr;
  }
  for (std::size_t i = 0; i < kShort.size(); i += 2) {
    if (kShort[i] == c) {
      to.code = static_cast<unsigned char>(kShort[i + 1]);
      ++at_;
      return nullptr;
    }
  }
  return R"(unknown escape; there are \n \t \r \b \f \0 \\ \" \' \/ \xNN \uNNNN)";
}

}  // namespace indurop::schema
