// SPDX-License-Identifier: Apache-2.0
// WSTRING: text of two bytes for each character, UTF-16. It has the same functions as indurop::string.

#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace indurop::iec {

// Trivially copyable, no allocation, always terminated; the same bytes as `uint16_t name[N]` of a .glb file. Longer
// text is truncated. Real-time safe.
template <std::size_t N>
struct WideText {
  static_assert(N >= 1, "a text needs room for its terminating NUL");
  char16_t data[N] = {};  // NOLINT: the layout of a C array is the contract

  WideText() = default;
  constexpr WideText(std::u16string_view text) noexcept {  // NOLINT(google-explicit-constructor): like indurop::string
    std::copy_n(text.data(), std::min(text.size(), N - 1), data);
  }
  constexpr WideText(const char16_t* text) noexcept  // NOLINT(google-explicit-constructor)
      : WideText(std::u16string_view(text)) {}

  [[nodiscard]] constexpr std::u16string_view view() const noexcept {
    return {data, static_cast<std::size_t>(std::find(data, data + N, u'\0') - data)};
  }
  constexpr operator std::u16string_view() const noexcept { return view(); }  // NOLINT(google-explicit-constructor)
  [[nodiscard]] std::size_t size() const noexcept { return view().size(); }

  friend bool operator==(const WideText& a, const WideText& b) noexcept { return a.view() == b.view(); }
  friend auto operator<=>(const WideText& a, const WideText& b) noexcept { return a.view() <=> b.view(); }
};

}  // namespace indurop::iec
