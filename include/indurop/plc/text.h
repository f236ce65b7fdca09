// SPDX-License-Identifier: Apache-2.0
// LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND. A result has room for everything it can become; it is cut when
// it is assigned to a shorter STRING. Positions count from 1; positions and lengths that reach beyond the text mean the
// part of it that exists. A character of a STRING is a byte, that of a WSTRING two. Real-time safe.

#pragma once

#include <indurop/plc/convert.h>
#include <indurop/plc/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace indurop::iec {

namespace detail {

// Appends to a text that is still all NUL and has room.
template <Text T>
class Builder {
 public:
  template <class View>
  void append(View part) noexcept {
    std::copy(part.begin(), part.end(), text_.data + used_);
    used_ += part.size();
  }
  [[nodiscard]] const T& text() const noexcept { return text_; }

 private:
  T text_;
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
template <class View>
struct Cut {
  View before;
  View inside;
  View after;
};
template <class View>
Cut<View> cut(View text, std::int64_t first, std::int64_t length) noexcept {
  const auto size = static_cast<std::int64_t>(text.size());
  const std::int64_t begin = std::clamp<std::int64_t>(first - 1, 0, size);
  const std::int64_t end = std::clamp<std::int64_t>(first - 1 + std::max<std::int64_t>(length, 0), begin, size);
  const auto at = static_cast<std::size_t>(begin);
  const auto to = static_cast<std::size_t>(end);
  return {text.substr(0, at), text.substr(at, to - at), text.substr(to)};
}

// Of two texts behind each other.
template <class A, class B>
using Joined = Sized<A, kTextSize<A> + kTextSize<B> - 1>;

}  // namespace detail

template <Text T>
std::int16_t len(const T& in) noexcept {
  return detail::saturated<std::int16_t>(static_cast<double>(in.size()));
}

template <Text T, Integer L>
T left(const T& in, L length) noexcept {
  return detail::cut(in.view(), 1, detail::count(length)).inside;
}

template <Text T, Integer L>
T right(const T& in, L length) noexcept {
  const auto size = static_cast<std::int64_t>(in.size());
  const std::int64_t wanted = std::clamp<std::int64_t>(detail::count(length), 0, size);
  return detail::cut(in.view(), size - wanted + 1, wanted).inside;
}

// `length` characters from position `first` on.
template <Text T, Integer L, Integer P>
T mid(const T& in, L length, P first) noexcept {
  return detail::cut(in.view(), detail::count(first), detail::count(length)).inside;
}

template <Text First, SameLetters<First>... More>
auto concat(const First& first, const More&... more) noexcept {
  detail::Builder<detail::Sized<First, (detail::kTextSize<First> + ... + (detail::kTextSize<More> - 1))>> result;
  result.append(first.view());
  (result.append(more.view()), ...);
  return result.text();
}

// `in2` after the character at position `after`; 0 is the front.
template <Text A, SameLetters<A> B, Integer P>
detail::Joined<A, B> insert(const A& in1, const B& in2, P after) noexcept {
  const auto parts = detail::cut(in1.view(), detail::count(after) + 1, 0);
  detail::Builder<detail::Joined<A, B>> result;
  result.append(parts.before);
  result.append(in2.view());
  result.append(parts.after);
  return result.text();
}

// Without `length` characters from position `first` on: the function DELETE.
template <Text T, Integer L, Integer P>
T erase(const T& in, L length, P first) noexcept {
  const auto parts = detail::cut(in.view(), detail::count(first), detail::count(length));
  detail::Builder<T> result;
  result.append(parts.before);
  result.append(parts.after);
  return result.text();
}

// `in2` in the place of `length` characters of `in1` from position `first` on.
template <Text A, SameLetters<A> B, Integer L, Integer P>
detail::Joined<A, B> replace(const A& in1, const B& in2, L length, P first) noexcept {
  const auto parts = detail::cut(in1.view(), detail::count(first), detail::count(length));
  detail::Builder<detail::Joined<A, B>> result;
  result.append(parts.before);
  result.append(in2.view());
  result.append(parts.after);
  return result.text();
}

// The position where `in2` first stands in `in1`; 0 if it does not, or is empty.
template <Text A, SameLetters<A> B>
std::int16_t find(const A& in1, const B& in2) noexcept {
  const auto part = in2.view();
  const std::size_t at = part.empty() ? part.npos : in1.view().find(part);
  return at == part.npos ? std::int16_t{0} : detail::saturated<std::int16_t>(static_cast<double>(at + 1));
}

}  // namespace indurop::iec
