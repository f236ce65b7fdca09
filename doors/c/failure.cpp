// SPDX-License-Identifier: Apache-2.0
#include "doors/c/failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace indurop::c {
namespace {

constexpr std::size_t kMaxText = 1024;
thread_local std::array<char, kMaxText> last_error{};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void keep(std::string_view text) noexcept {
  const std::size_t length = std::min(text.size(), kMaxText - 1);
  text.copy(last_error.data(), length);
  last_error[length] = '\0';
}

irp_code code_of(Errc code) noexcept {
  switch (code) {
    case Errc::InvalidArgument:
      return IRP_INVALID;
    case Errc::NotFound:
      return IRP_NOT_FOUND;
    case Errc::PermissionDenied:
      return IRP_DENIED;
    case Errc::Busy:
    case Errc::Timeout:
      return IRP_BUSY;
    case Errc::VersionMismatch:
      return IRP_VERSION;
    case Errc::Corrupt:
    case Errc::Dead:
      return IRP_CORRUPT;
    case Errc::OutOfRange:
      return IRP_SIZE;
    case Errc::TypeMismatch:
      return IRP_CHANGED;
    default:
      return IRP_SYSTEM;
  }
}

irp_code code_of(operate::Why why) noexcept {
  switch (why) {
    case operate::Why::Wrong:
      return IRP_RANGE;
    case operate::Why::Forced:
      return IRP_FORCED;
    case operate::Why::Locked:
      return IRP_LOCKED;
    case operate::Why::Busy:
      return IRP_BUSY;
    case operate::Why::Absent:
      return IRP_NOT_FOUND;
  }
  return IRP_SYSTEM;
}

}  // namespace

Failure failure_of(const Error& error, const std::string& about) {
  return {code_of(error.code), fmt::format("{}: {} ({})", about, error.where, to_string(error.code))};
}

Failure failure_of(const operate::Refusal& refusal) {
  return {code_of(refusal.why), refusal.text()};
}

irp_code fail(const Failure& failure) noexcept {
  keep(failure.text);
  return failure.code;
}

irp_code fail_in_system(const char* text) noexcept {
  keep(text);
  return IRP_SYSTEM;
}

}  // namespace indurop::c

const char* irp_error(void) {
  return indurop::c::last_error.data();
}
