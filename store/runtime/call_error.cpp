// SPDX-License-Identifier: Apache-2.0
// Text of the reason why a call of a shared function failed.

#include <indurop/function.h>

#include <cstdio>

namespace indurop {

namespace {

const char* reason(Errc code) noexcept {
  switch (code) {
    case Errc::NotFound:
      return "no module implements it (absent)";
    case Errc::Busy:
      return "all its call slots are in use (busy)";
    case Errc::Dead:
      return "the process that implements it has died (dead)";
    case Errc::Timeout:
      return "no result within the deadline (timeout)";
    case Errc::Failed:
      return "its implementation threw or crashed (failed)";
    case Errc::TypeMismatch:
      return "caller and node were built from different .glb files: rebuild both";
    default:
      return to_string(code);
  }
}

}  // namespace

call_error::call_error(const char* function, Errc code) noexcept : code_(code) {
  std::snprintf(text_, sizeof text_, "%s: %s", function, reason(code));
}

call_error::~call_error() = default;

const char* call_error::what() const noexcept {
  return text_;
}

}  // namespace indurop

extern "C" void indurop_call_fault(const char* function, int code) {
  throw indurop::call_error(function, static_cast<indurop::Errc>(code));
}
