// SPDX-License-Identifier: Apache-2.0
// LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND. A result has room for everything it can become; it is cut when
// it is assigned to a shorter STRING. Positions count from 1; positions and lengths that reach beyond the text mean the
// part of it that exists. A character is a byte. Real-time safe.

#pragma once

#include <indurop/plc/convert.h>
#include <indurop/plc/types.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

namespace indurop::iec {

namespace detail {

// Appends to a text that is still all NUL and has room.
template <std::size_t N>
class Builder {
 public:
  void append(std::string_view part) noexcept {
    std::memcpy(text_.data + used_, part.data(), part.size());
    used_ += part.size();
  }
  [[nodiscard]] const indurop::string<N>& text() const noexcept { return text_; }

 private:
  indurop::string<N> text_;
  std::size_t used_ = 0;
};

// `n` as a length or position that may be added to another one without overflow.
template <Integer T>
constexpr std::int64_t count(T n) noexcept {
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  if (std::cmp_greater(n, kFar)) {
    return kFar;
  }
  return std::max(static_cast<std::int64_t>(n), -kFar);
}

// The text before, inside and after the `length` characters from position `first` on.
struct Cut {
  std::string_view before;
  std::string_view inside;
  std::string_view after;
};
inline Cut cut(std::string_view text, std::int64_t first, std::int64_t length) noexcept {
  const auto size = static_cast<std::int64_t>(text.size());
  const std::int64_t begin = std::clamp<std::int64_t>(first - 1, 0, size);
  const std::int64_t end = std::clamp<std::int64_t>(first - 1 + std::max<std::int64_t>(length, 0), begin, size);
  const auto at = static_cast<std::size_t>(begin);
  const auto to = static_cast<std::size_t>(end);
  return {text.substr(0, at), text.substr(at, to - at), text.substr(to)};
}

}  // namespace detail

template <std::size_t N>
std::int16_t len(const indurop::string<N>& in) noexcept {
  return detail::saturated<std::int16_t>(static_cast<double>(in.size()));
}

template <std::size_t N, Integer L>
indurop::string<N> left(const indurop::string<N>& in, L length) noexcept {
  return detail::cut(in.view(), 1, detail::count(length)).inside;
}

template <std::size_t N, Integer L>
indurop::string<N> right(const indurop::string<N>& in, L length) noexcept {
  const auto size = static_cast<std::int64_t>(in.size());
  const std::int64_t wanted = std::clamp<std::int64_t>(detail::count(length), 0, size);
  return detail::cut(in.view(), size - wanted + 1, wanted).inside;
}

// `length` characters from position `first` on.
template <std::size_t N, Integer L, Integer P>
indurop::string<N> mid(const indurop::string<N>& in, L length, P first) noexcept {
  return detail::cut(in.view(), detail::count(first), detail::count(length)).inside;
}

template <std::size_t... N>
auto concat(const indurop::string<N>&... in) noexcept {
  detail::Builder<(1 + ... + (N - 1))> result;
  (result.append(in.view()), ...);
  return result.text();
}

// `in2` after the character at position `after`; 0 is the front.
template <std::size_t A, std::size_t B, Integer P>
indurop::string<A + B - 1> insert(const indurop::string<A>& in1, const indurop::string<B>& in2, P after) noexcept {
  const detail::Cut parts = detail::cut(in1.view(), detail::count(after) + 1, 0);
  detail::Builder<A + B - 1> result;
  result.append(parts.before);
  result.append(in2.view());
  result.append(parts.after);
  return result.text();
}

// Without `length` characters from position `first` on: the function DELETE.
template <std::size_t N, Integer L, Integer P>
indurop::string<N> erase(const indurop::string<N>& in, L length, P first) noexcept {
  const detail::Cut parts = detail::cut(in.view(), detail::count(first), detail::count(length));
  detail::Builder<N> result;
  result.append(parts.before);
  result.append(parts.after);
  return result.text();
}

// `in2` in the place of `length` characters of `in1` from position `first` on.
template <std::size_t A, std::size_t B, Integer L, Integer P>
indurop::string<A + B - 1> replace(const indurop::string<A>& in1, const indurop::string<B>& in2, L length,
                                   P first) noexcept {
  const detail::Cut parts = detail::cut(in1.view(), detail::count(first), detail::count(length));
  detail::Builder<A + B - 1> result;
  result.append(parts.before);
  result.append(in2.view());
  result.append(parts.after);
  return result.text();
}

// The position where `in2` first stands in `in1`; 0 if it does not, or is empty.
template <std::size_t A, std::size_t B>
std::int16_t find(const indurop::string<A>& in1, const indurop::string<B>& in2) noexcept {
  const std::size_t at = in2.view().empty() ? std::string_view::npos : in1.view().find(in2.view());
  return at == std::string_view::npos ? std::int16_t{0} : detail::saturated<std::int16_t>(static_cast<double>(at + 1));
}

}  // namespace indurop::iec
