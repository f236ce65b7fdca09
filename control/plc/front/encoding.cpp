// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/encoding.h"

#include <cstdint>
#include <string_view>

#include "core/base/utf8.h"

namespace indurop::plc {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

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
    base::append_utf8(out, code);
  }
  return out;
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
  if (!base::first_invalid_utf8(all)) {
    return text;
  }
  std::string out;
  for (std::size_t at = 0; at < all.size(); ++at) {
    base::append_utf8(out, byte_at(all, at));
  }
  return out;
}

}  // namespace indurop::plc
