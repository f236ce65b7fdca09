// SPDX-License-Identifier: Apache-2.0
// The errors that end a PLC program: a division by zero, an index outside an array. Thrown as an exception, which the
// node reports as a module fault with the text below; nothing else of the PLC library throws.

#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>

namespace indurop::iec {

// The place in the program of a calculation. Both texts are literals of the generated code.
struct Place {
  const char* at;   // "prog.st:12:5", or for drawn networks "rung 3, block ADD"
  const char* pou;  // "MAIN"
};

// The exception with a text such as "prog.st:12:5: division by zero in MAIN". The text is stored in the exception
// itself; it is cut to the space there.
class Fault : public std::exception {
 public:
  Fault(Place place, const char* reason) noexcept {
    std::snprintf(text_, sizeof text_, "%s: %s in %s", place.at, reason, place.pou);
  }
  [[nodiscard]] const char* what() const noexcept override { return text_; }

 private:
  char text_[240] = {};
};

[[noreturn, gnu::cold, gnu::noinline]] inline void fail(Place place, const char* reason) {
  throw Fault(place, reason);
}

// For a value outside [low, high]. `what` is the noun: "index", "selector K of MUX".
[[noreturn, gnu::cold, gnu::noinline]] inline void fail_range(Place place, const char* what, std::int64_t value,
                                                              std::int64_t low, std::int64_t high) {
  char reason[120];
  std::snprintf(reason, sizeof reason, "%s %lld is outside of %lld..%lld", what, static_cast<long long>(value),
                static_cast<long long>(low), static_cast<long long>(high));
  throw Fault(place, reason);
}

// Returns a VAR_IN_OUT of a function block, for its methods; faults if it is null: not given.
template <class T>
[[nodiscard]] T& given(Place place, T* in_out) {
  if (in_out == nullptr) [[unlikely]] {
    fail(place, "a VAR_IN_OUT is used that no call gave, or whose variable is gone,");
  }
  return *in_out;
}

}  // namespace indurop::iec
