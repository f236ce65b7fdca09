// SPDX-License-Identifier: Apache-2.0
// Text functions.

#include "glb2idl/text.h"

#include <fmt/format.h>

namespace indurop::glb2idl {
namespace {

std::optional<unsigned> digit(char c) noexcept {
  if (c >= '0' && c <= '9') {
    return static_cast<unsigned>(c - '0');
  }
  if (c >= 'a' && c <= 'f') {
    return static_cast<unsigned>(c - 'a' + 10);
  }
  if (c >= 'A' && c <= 'F') {
    return static_cast<unsigned>(c - 'A' + 10);
  }
  return std::nullopt;
}

// Reads a number of at most `most` digits at the beginning of `text` and removes them from it.
std::optional<unsigned> take_number(std::string_view& text, unsigned base, std::size_t most) noexcept {
  unsigned value = 0;
  std::size_t used = 0;
  while (used < most && used < text.size()) {
    const auto d = digit(text[used]);
    if (!d || *d >= base) {
      break;
    }
    value = value * base + *d;
    ++used;
  }
  text.remove_prefix(used);
  return used == 0 || value > 0xFF ? std::nullopt : std::optional<unsigned>(value);
}

}  // namespace

std::optional<std::string> decode_quoted(std::string_view quoted) {
  constexpr std::string_view kLetters = "ntrabfv0'\"\\?";
  constexpr std::string_view kMeanings("\n\t\r\a\b\f\v\0'\"\\?", 12);
  std::string out;
  std::string_view rest = quoted.substr(1, quoted.size() - 2);
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c != '\\') {
      out += c;
      continue;
    }
    if (rest.empty()) {
      return std::nullopt;
    }
    const bool hex = rest.front() == 'x';
    const bool octal = rest.front() >= '0' && rest.front() <= '7';
    if (hex || octal) {
      rest.remove_prefix(hex ? 1 : 0);
      const auto value = take_number(rest, hex ? 16 : 8, hex ? 2 : 3);
      if (!value) {
        return std::nullopt;
      }
      out += static_cast<char>(*value);
      continue;
    }
    const std::size_t known = kLetters.find(rest.front());
    if (known == std::string_view::npos) {
      return std::nullopt;
    }
    out += kMeanings[known];
    rest.remove_prefix(1);
  }
  return out;
}

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7F || c == '?') {
      out += fmt::format("\\{:03o}", static_cast<unsigned>(byte));
    } else {
      out += c;
    }
  }
  return out;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

std::string join_names(std::span<const std::string> parts, std::string_view between) {
  std::string out;
  for (const std::string& part : parts) {
    out += out.empty() ? "" : std::string(between);
    out += part;
  }
  return out;
}

std::string comment_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  // Two question marks and a slash are a backslash to a preprocessor with trigraphs.
  while (out.ends_with('\\') || out.ends_with("?\?/")) {
    out += " .";
  }
  return out;
}

}  // namespace indurop::glb2idl
