// SPDX-License-Identifier: Apache-2.0
// LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND. A result has space for every possible value; it is cut when it
// is assigned to a shorter STRING. Positions count from 1; positions and lengths beyond the text are limited to the
// part that exists. A character of a STRING is one byte, that of a WSTRING two. Real-time safe.

#pragma once

#include <indurop/plc/types.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace indurop::iec {

namespace detail {

template <class T>
inline constexpr bool kIsJoined = false;

// Concatenated texts, which know their length and are not padded with the NULs that fill a variable: most of them are
// copied to a shorter variable at once.
template <class Letter, std::size_t N>
class Joined {
 public:
  using View = std::basic_string_view<Letter>;
  // The parts must have at most N characters together.
  template <std::same_as<View>... Parts>
  explicit Joined(Parts... parts) noexcept {  // NOLINT(cppcoreguidelines-pro-type-member-init): the rest is not read
    (append(parts), ...);
  }
  [[nodiscard]] View view() const noexcept { return {data_, size_}; }
  operator View() const noexcept { return view(); }  // NOLINT(google-explicit-constructor): like indurop::string
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return N; }

  friend bool operator==(const Joined& a, View b) noexcept { return a.view() == b; }

 private:
  void append(View part) noexcept {
    std::memcpy(data_ + size_, part.data(), part.size() * sizeof(Letter));
    size_ += part.size();
  }

  std::size_t size_ = 0;
  Letter data_[N + 1];  // NOLINT(modernize-avoid-c-arrays): std::array would have to be filled
};
template <class Letter, std::size_t N>
inline constexpr bool kIsJoined<Joined<Letter, N>> = true;
template <class Letter, std::size_t N>
struct TextTraits<Joined<Letter, N>>
    : TextTraits<std::conditional_t<std::same_as<Letter, char>, String<N>, WString<N>>> {};
// Returns the concatenated parts as an R: a Joined, or a variable that cuts what it has no space for.
template <class R, class... Parts>
R put_together(Parts... parts) noexcept {
  if constexpr (kIsJoined<R>) {
    return R(parts...);
  } else {
    R result;  // all NUL: only the characters are copied
    std::size_t size = 0;
    const auto append = [&](auto part) {
      const std::size_t n = std::min(part.size(), kTextSize<R> - 1 - size);
      std::memcpy(result.data + size, part.data(), n * sizeof *part.data());
      size += n;
    };
    (append(parts), ...);
    return result;
  }
}

// A Joined with the total size of all texts.
template <class T, class... More>
using JoinedOf =
    Joined<typename TextTraits<T>::Letter, kTextSize<T> + (std::size_t{0} + ... + (kTextSize<More> - 1)) - 1>;

// A text with space for every part of a T.
template <class T>
using PartOf = Sized<T, kTextSize<T>>;

// The maximum length and position: an INT cannot count further.
inline constexpr std::size_t kMaxCounted = std::numeric_limits<std::int16_t>::max();

// Returns `n` as a length or position that can be added to another one without overflow.
template <Integer T>
constexpr std::int64_t count(T n) noexcept {
  constexpr std::int64_t kLimit = std::int64_t{1} << 62;
  if (std::cmp_greater(n, kLimit)) {
    return kLimit;
  }
  return std::max(static_cast<std::int64_t>(n), -kLimit);
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
  return {View(text.data(), at), View(text.data() + at, to - at), View(text.data() + to, text.size() - to)};
}

}  // namespace detail

template <Text T>
std::int16_t len(const T& in) noexcept {
  return static_cast<std::int16_t>(std::min(in.size(), detail::kMaxCounted));
}

template <Text T, Integer L>
detail::PartOf<T> left(const T& in, L length) noexcept {
  const auto all = in.view();
  const auto size = static_cast<std::int64_t>(all.size());
  const std::int64_t wanted = std::clamp<std::int64_t>(detail::count(length), 0, size);
  return detail::put_together<detail::PartOf<T>>(all.substr(0, static_cast<std::size_t>(wanted)));
}

template <Text T, Integer L>
detail::PartOf<T> right(const T& in, L length) noexcept {
  const auto all = in.view();
  const auto size = static_cast<std::int64_t>(all.size());
  const std::int64_t wanted = std::clamp<std::int64_t>(detail::count(length), 0, size);
  return detail::put_together<detail::PartOf<T>>(all.substr(static_cast<std::size_t>(size - wanted)));
}

// Returns `length` characters from position `first` on.
template <Text T, Integer L, Integer P>
detail::PartOf<T> mid(const T& in, L length, P first) noexcept {
  const auto parts = detail::cut(in.view(), detail::count(first), detail::count(length));
  return detail::put_together<detail::PartOf<T>>(parts.inside);
}

// CONCAT, INSERT and REPLACE as the type of the variable they are assigned to, without a complete text in between.
template <Text R, SameLetters<R>... Parts>
R concat_as(const Parts&... parts) noexcept {
  return detail::put_together<R>(parts.view()...);
}
template <Text R, SameLetters<R> A, SameLetters<R> B, Integer P>
R insert_as(const A& in1, const B& in2, P after) noexcept {
  const auto parts = detail::cut(in1.view(), detail::count(after) + 1, 0);
  return detail::put_together<R>(parts.before, in2.view(), parts.after);
}
template <Text R, SameLetters<R> A, SameLetters<R> B, Integer L, Integer P>
R replace_as(const A& in1, const B& in2, L length, P first) noexcept {
  const auto parts = detail::cut(in1.view(), detail::count(first), detail::count(length));
  return detail::put_together<R>(parts.before, in2.view(), parts.after);
}

template <Text First, SameLetters<First>... More>
auto concat(const First& first, const More&... more) noexcept {
  return concat_as<detail::JoinedOf<First, More...>>(first, more...);
}

// Inserts `in2` after the character at position `after`; 0 is the front.
template <Text A, SameLetters<A> B, Integer P>
auto insert(const A& in1, const B& in2, P after) noexcept {
  return insert_as<detail::JoinedOf<A, B>>(in1, in2, after);
}

// Replaces `length` characters of `in1` from position `first` on by `in2`.
template <Text A, SameLetters<A> B, Integer L, Integer P>
auto replace(const A& in1, const B& in2, L length, P first) noexcept {
  return replace_as<detail::JoinedOf<A, B>>(in1, in2, length, first);
}

// Removes `length` characters from position `first` on: the function DELETE.
template <Text T, Integer L, Integer P>
detail::PartOf<T> erase(const T& in, L length, P first) noexcept {
  const auto parts = detail::cut(in.view(), detail::count(first), detail::count(length));
  return detail::put_together<detail::PartOf<T>>(parts.before, parts.after);
}

// The position of the first occurrence of `in2` in `in1`; 0 if there is none, or `in2` is empty.
template <Text A, SameLetters<A> B>
std::int16_t find(const A& in1, const B& in2) noexcept {
  const auto part = in2.view();
  const std::size_t at = part.empty() ? part.npos : in1.view().find(part);
  return at == part.npos ? std::int16_t{0} : static_cast<std::int16_t>(std::min(at + 1, detail::kMaxCounted));
}

}  // namespace indurop::iec
