// SPDX-License-Identifier: Apache-2.0
// What the C++ that PLC programs become needs besides the library of the standard: values between the program and the
// shared variables, loops. Real-time safe.

#pragma once

#include <indurop/detail/access.h>
#include <indurop/plc/clock.h>
#include <indurop/plc/log.h>
#include <indurop/plc/types.h>
#include <indurop/var.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace indurop::iec {

// Copies between the types of a PLC program and those of shared variables: numbers, BOOL and enumerations into each
// other, times as nanoseconds, arrays by element, structs with copy_fields() of the generated code.
template <class To, class From>
constexpr void copy_value(To& to, const From& from) {
  if constexpr (std::is_same_v<To, From>) {
    to = from;
  } else if constexpr (Timelike<To>) {
    to.ns = static_cast<std::int64_t>(from);
  } else if constexpr (Timelike<From>) {
    to = static_cast<To>(from.ns);
  } else if constexpr (Text<To> && Text<From>) {
    to = To(from.view());
  } else if constexpr (std::is_scalar_v<To>) {
    to = static_cast<To>(from);
  } else {
    copy_fields(to, from);
  }
}

template <class To, class From, std::size_t N>
constexpr void copy_value(std::array<To, N>& to, const std::array<From, N>& from) {
  if constexpr (std::is_same_v<To, From>) {
    to = from;
  } else {
    for (std::size_t i = 0; i < N; ++i) {
      copy_value(to[i], from[i]);
    }
  }
}

// A WSTRING is shared as numbers.
template <std::size_t N>
constexpr void copy_value(WideText<N>& to, const std::array<std::uint16_t, N>& from) {
  std::copy(from.begin(), from.end() - 1, to.data);  // the last one stays its end
}
template <std::size_t N>
constexpr void copy_value(std::array<std::uint16_t, N>& to, const WideText<N>& from) {
  std::copy(from.data, from.data + N, to.begin());
}

// Writes a shared variable, or a part of it, if the program changed it: what others wrote meanwhile stays.
template <class Shared, class T>
void write_changed(const Shared& to, const T& now, const T& before) {
  if (!(now == before)) {
    typename Shared::whole_type value{};
    copy_value(value, now);
    to = value;
  }
}

// A shared number as programs need it: of thousands, an indurop::Leaf each would take g++ longer than the program.
template <class Tag, class T, std::uint32_t Offset>
struct SharedNumber {
  using whole_type = T;
  using tag_type = Tag;
  indurop::Place place;

  constexpr SharedNumber(indurop::Place at, indurop::detail::Make /*unused*/) noexcept : place(at) {}
  [[nodiscard]] T get() const noexcept { return indurop::detail::load<Tag, T>(Offset); }
  void operator=(T value) const noexcept { indurop::detail::store<Tag, T>(Offset, value); }  // NOLINT(*assign*)
};

// A number of the program that is shared.
struct SharedWord {
  const abi::Ref* shared;
  void* now;     // of the program
  void* before;  // what it was at the beginning of the scan; null: the program does not write it
};
template <class Bits, std::size_t N>
void read_words(const std::array<SharedWord, N>& words) noexcept {
  for (const SharedWord& one : words) {
    Bits value;  // NOLINT(cppcoreguidelines-init-variables)
    __atomic_load(static_cast<const Bits*>(one.shared->entry), &value, __ATOMIC_ACQUIRE);
    std::memcpy(one.now, &value, sizeof value);
    if (one.before != nullptr) {
      std::memcpy(one.before, &value, sizeof value);
    }
  }
}
// Those the program changed: what others wrote meanwhile stays.
template <class Bits, std::size_t N>
void write_words(const std::array<SharedWord, N>& words) noexcept {
  for (const SharedWord& one : words) {
    Bits now;     // NOLINT(cppcoreguidelines-init-variables)
    Bits before;  // NOLINT(cppcoreguidelines-init-variables)
    std::memcpy(&now, one.now, sizeof now);
    std::memcpy(&before, one.before, sizeof before);
    if (now != before) {
      indurop::detail::scalar_write<Bits>(one.shared->entry, now);
    }
  }
}

// FOR whose end, step or variable only the running program knows. It ends where the variable would overflow, or leave
// its subrange, in which it then stays.
template <Integer T>
class Loop {
 public:
  constexpr Loop(T end, T step) noexcept : end_(end), step_(step) {}
  constexpr Loop(T end, T step, T low, T high) noexcept : end_(end), step_(step), low_(low), high_(high) {}

  [[nodiscard]] constexpr bool runs(T value) const noexcept {
    return !over_ && (step_ >= T{} ? value <= end_ : value >= end_);
  }
  constexpr void next(T& value) noexcept {
    T after{};
    over_ = __builtin_add_overflow(value, step_, &after);
    const bool whole = low_ == std::numeric_limits<T>::min() && high_ == std::numeric_limits<T>::max();
    over_ = over_ || after < low_ || after > high_;
    value = over_ && !whole ? value : after;
  }

 private:
  T end_;
  T step_;
  T low_ = std::numeric_limits<T>::min();
  T high_ = std::numeric_limits<T>::max();
  bool over_ = false;
};

// A UNION: bytes that are the place of all its fields. The code that uses it is compiled without strict aliasing.
template <class... Fields>
struct Overlap {
  static constexpr std::size_t kBytes = std::max({sizeof(Fields)...});
  alignas(std::max({alignof(Fields)...})) std::array<unsigned char, kBytes> bytes{};
  friend bool operator==(const Overlap&, const Overlap&) = default;
};
template <class Field, class Union>
auto& overlaid(Union& value) noexcept {
  if constexpr (std::is_const_v<Union>) {
    return reinterpret_cast<const Field&>(value.bytes);
  } else {
    return reinterpret_cast<Field&>(value.bytes);
  }
}

// For an output that the caller does not want.
template <class T>
constexpr T& scratch(T&& value = T{}) noexcept {
  return value;
}

// An array of equal elements.
template <class Array>
constexpr Array filled(const typename Array::value_type& value) noexcept {
  Array out{};
  for (auto& one : out) {
    one = value;
  }
  return out;
}

}  // namespace indurop::iec
