// SPDX-License-Identifier: Apache-2.0
#include "plc/front/encoding.h"

#include <cstdint>
#include <string_view>

namespace indurop::plc {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

void append(std::string& to, std::uint32_t code) {
  const auto byte = [&](std::uint32_t value) { to += static_cast<char>(static_cast<unsigned char>(value)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0U | (code >> 6U));
    byte(0x80U | (code & 0x3FU));
  } else if (code < 0x10000) {
    byte(0xE0U | (code >> 12U));
    byte(0x80U | ((code >> 6U) & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  } else {
    byte(0xF0U | (code >> 18U));
    byte(0x80U | ((code >> 12U) & 0x3FU));
    byte(0x80U | ((code >> 6U) & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  }
}

std::uint32_t byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

std::string from_utf16(std::string_view text, bool big) {
  const auto unit = [&](std::size_t at) {
    return big ? (byte_at(text, at) << 8U) | byte_at(text, at + 1) : (byte_at(text, at + 1) << 8U) | byte_at(text, at);
  };
  std::string out;
  for (std::size_t at = 0; at + 1 < text.size(); at += 2) {
    std::uint32_t code = unit(at);
    const bool first = code >= 0xD800 && code < 0xDC00;
    if (first && at + 3 < text.size() && unit(at + 2) >= 0xDC00 && unit(at + 2) < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10U) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = kReplacement;
    }
    append(out, code);
  }
  return out;
}

// How many bytes the character at the place has; 0: it is none of UTF-8.
std::size_t length_at(std::string_view text, std::size_t at) {
  const std::uint32_t first = byte_at(text, at);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (at + i >= text.size() || (byte_at(text, at + i) & 0xC0U) != 0x80) {
      return 0;
    }
  }
  return length;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_at(text, at);
    if (length == 0) {
      return false;
    }
    at += length;
  }
  return true;
}

}  // namespace

std::string as_utf8(std::string text) {
  using namespace std::string_view_literals;
  const std::string_view all = text;
  if (all.starts_with("\xFF\xFE"sv) || all.starts_with("\xFE\xFF"sv)) {
    return from_utf16(all.substr(2), all[0] == '\xFE');
  }
  if (all.size() >= 4 && (all[0] == '\0') != (all[1] == '\0') && (all[2] == '\0') != (all[3] == '\0')) {
    return from_utf16(all, all[0] == '\0');
  }
  if (is_utf8(all)) {
    return text;
  }
  std::string out;
  for (std::size_t at = 0; at < all.size(); ++at) {
    append(out, byte_at(all, at));
  }
  return out;
}

}  // namespace indurop::plc
