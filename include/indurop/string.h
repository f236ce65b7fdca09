// SPDX-License-Identifier: Apache-2.0
// Bounded text as stored in a shared variable: `char name[16]` holds up to 15 characters and a terminating NUL.

#pragma once

#include <compare>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace indurop {

// Trivially copyable, no allocation, always terminated. Longer text is truncated. Real-time safe.
template <std::size_t N>
struct string {  // NOLINT(readability-identifier-naming): used like std::string
  static_assert(N >= 1, "a char array needs room for its terminating NUL");
  char data[N] = {};  // NOLINT: the layout of a C char array is the contract

  string() = default;
  constexpr string(std::string_view text) noexcept {
    assign(text);
  }                                                              // NOLINT(google-explicit-constructor): like char[N]
  constexpr string(const char* text) noexcept { assign(text); }  // NOLINT(google-explicit-constructor)

  constexpr void assign(std::string_view text) noexcept {
    const std::size_t n = text.size() < N ? text.size() : N - 1;
    if (std::is_constant_evaluated()) {
      for (std::size_t i = 0; i < N; ++i) {
        data[i] = i < n ? text[i] : '\0';
      }
      return;
    }
    std::memcpy(data, text.data(), n);
    std::memset(data + n, 0, N - n);
  }
  // A value written by another process may lack its NUL; this view never runs past the array.
  [[nodiscard]] std::string_view view() const noexcept { return {data, strnlen(data, N)}; }
  operator std::string_view() const noexcept { return view(); }  // NOLINT(google-explicit-constructor)
  [[nodiscard]] const char* c_str() const noexcept { return data; }
  [[nodiscard]] std::size_t size() const noexcept { return view().size(); }
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return N - 1; }

  friend bool operator==(const string& a, const string& b) noexcept { return a.view() == b.view(); }
  friend auto operator<=>(const string& a, const string& b) noexcept { return a.view() <=> b.view(); }
  friend bool operator==(const string& a, std::string_view b) noexcept { return a.view() == b; }
  friend bool operator==(const string& a, const char* b) noexcept { return a.view() == b; }
  template <class Stream>
  friend auto operator<<(Stream& out, const string& text) -> decltype(out << std::string_view{}) {
    return out << text.view();
  }
};

}  // namespace indurop
