// SPDX-License-Identifier: Apache-2.0
// POINTER TO, REF_TO and REFERENCE TO: an address that knows the variable it points into, so that an access outside it
// is a fault of the module and does not reach another variable. Real-time safe, except for the faults.

#pragma once

#include <indurop/plc/fault.h>
#include <indurop/plc/lifetime.h>

#include <compare>
#include <cstddef>
#include <cstdint>

namespace indurop::iec {

template <class T>
struct Pointer {
  char* base = nullptr;     // start of the variable
  std::uint32_t size = 0;   // size of the variable in bytes
  std::uint32_t call = 0;   // the call that the variable belongs to; 0: permanent
  std::int64_t offset = 0;  // of the value pointed to, in bytes; may be outside until it is used

  Pointer() = default;
  Pointer(char* variable, std::uint32_t bytes, std::int64_t at, std::uint32_t of_call = 0) noexcept
      : base(variable), size(bytes), call(of_call), offset(at) {}
  template <class U>
  Pointer(const Pointer<U>& other) noexcept  // NOLINT(google-explicit-constructor): as the language converts
      : base(other.base), size(other.size), call(other.call), offset(other.offset) {}

  [[nodiscard]] std::uintptr_t address() const noexcept {
    return base == nullptr ? 0 : reinterpret_cast<std::uintptr_t>(base) + static_cast<std::uintptr_t>(offset);
  }
};

template <class A, class B>
bool operator==(const Pointer<A>& a, const Pointer<B>& b) noexcept {
  return a.address() == b.address();
}
template <class A, class B>
auto operator<=>(const Pointer<A>& a, const Pointer<B>& b) noexcept {
  return a.address() <=> b.address();
}

// ADR(x), where x is inside the variable `whole`.
template <class T, class Whole>
Pointer<T> address(T& value, Whole& whole) noexcept {
  static_assert(sizeof(Whole) <= UINT32_MAX);
  char* const base = reinterpret_cast<char*>(&whole);
  return {base, static_cast<std::uint32_t>(sizeof(Whole)), reinterpret_cast<char*>(&value) - base};
}
// The same for a variable of this call.
template <class T, class Whole>
Pointer<T> address(T& value, Whole& whole, const Lifetime& call) noexcept {
  Pointer<T> out = address(value, whole);
  out.call = call.number();
  return out;
}
// ADR(p^.x)
template <class T, class Whole>
Pointer<T> address_in(const Pointer<Whole>& pointer, T& value) noexcept {
  return {pointer.base, pointer.size, reinterpret_cast<char*>(&value) - pointer.base, pointer.call};
}

// p + n: n bytes further, whatever it points to.
template <class T>
Pointer<T> moved(Pointer<T> pointer, std::int64_t bytes) noexcept {
  pointer.offset =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(pointer.offset) + static_cast<std::uint64_t>(bytes));
  return pointer;
}

// Element `index` of the array that begins at the pointer: p^[i], p[i].
template <class Element, class T>
Element& element(Place place, const Pointer<T>& pointer, std::int64_t index) {
  constexpr auto kBytes = static_cast<std::int64_t>(sizeof(Element));
  if (pointer.base == nullptr) [[unlikely]] {
    fail(place, "a pointer that is NULL is used");
  }
  if (pointer.call != 0 && !Lifetime::lasts(pointer.call)) [[unlikely]] {
    fail(place, "a pointer to a variable of a call that has ended is used");
  }
  std::int64_t begin = 0;
  const bool far =
      __builtin_mul_overflow(index, kBytes, &begin) || __builtin_add_overflow(begin, pointer.offset, &begin);
  if (far || begin < 0 || begin > pointer.size - kBytes) [[unlikely]] {
    fail_range(place, "the byte a pointer leads to", begin, 0, pointer.size - kBytes);
  }
  char* const at = pointer.base + begin;
  if (reinterpret_cast<std::uintptr_t>(at) % alignof(Element) != 0) [[unlikely]] {
    fail(place, "a pointer leads to a place where no value of its type can lie");
  }
  return *reinterpret_cast<Element*>(at);
}

// s[first], the first character of a text. If counted from 0, the index after the longest text is accessible, too; it
// remains the terminator.
template <class Letter, std::int64_t first, class Text>
Letter& character(Place place, Text& text, std::int64_t index) {
  static_assert(sizeof(Letter) == sizeof text.data[0]);
  constexpr auto kMaxIndex = static_cast<std::int64_t>(sizeof(Text) / sizeof(Letter)) - 1;
  if (index < first || index > kMaxIndex) [[unlikely]] {
    fail_range(place, "index", index, first, kMaxIndex);
  }
  return reinterpret_cast<Letter&>(text.data[index - first]);
}

// p^
template <class T>
T& deref(Place place, const Pointer<T>& pointer) {
  return element<T>(place, pointer, 0);
}

}  // namespace indurop::iec
