// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/history_position.h"

#include <fmt/format.h>
#include <indurop/detail/abi.h>

#include <charconv>

namespace indurop::tools {
namespace {

// Removes a number and the '.' after it, or the end of the text, and returns the number.
template <class Number>
bool take_number(std::string_view& text, int base, Number& number) {
  const std::string_view word = text.substr(0, text.find('.'));
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number, base);
  if (code != std::errc() || end != word.data() + word.size()) {
    return false;
  }
  text.remove_prefix(word.size());
  return true;
}

constexpr int kHexadecimal = 16;
constexpr int kDecimal = 10;

}  // namespace

std::uint64_t digest_of(std::span<const std::uint8_t> bytes) noexcept {
  const std::uint64_t digest = abi::fnv1a64(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return digest == 0 ? 1 : digest;
}

std::string to_text(const HistoryPosition& position) {
  std::string text = fmt::format("{}.{}", position.at_ns, position.real_minus_node_ns);
  for (const std::uint64_t digest : position.seen) {
    text += fmt::format(".{:x}", digest);
  }
  return text;
}

std::optional<HistoryPosition> history_position(std::string_view text, std::size_t items) {
  HistoryPosition position;
  if (!take_number(text, kDecimal, position.at_ns) || position.at_ns < 0 || !text.starts_with('.')) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  if (!take_number(text, kDecimal, position.real_minus_node_ns)) {
    return std::nullopt;
  }
  while (text.starts_with('.') && position.seen.size() < items) {
    text.remove_prefix(1);
    if (!take_number(text, kHexadecimal, position.seen.emplace_back())) {
      return std::nullopt;
    }
  }
  return text.empty() && position.seen.size() == items ? std::optional(std::move(position)) : std::nullopt;
}

}  // namespace indurop::tools
