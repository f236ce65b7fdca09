// SPDX-License-Identifier: Apache-2.0
// Text of the error codes.

#include <indurop/result.h>

namespace indurop {

const char* to_string(Errc code) noexcept {
  switch (code) {
    case Errc::Ok:
      return "ok";
    case Errc::InvalidArgument:
      return "invalid argument";
    case Errc::NotFound:
      return "not found";
    case Errc::AlreadyExists:
      return "already exists";
    case Errc::PermissionDenied:
      return "permission denied";
    case Errc::Overflow:
      return "overflow";
    case Errc::Timeout:
      return "time-out";
    case Errc::Busy:
      return "busy";
    case Errc::Corrupt:
      return "corrupt";
    case Errc::VersionMismatch:
      return "version mismatch";
    case Errc::TypeMismatch:
      return "type mismatch";
    case Errc::NoSpace:
      return "no space left";
    case Errc::Dead:
      return "the other process is gone";
    case Errc::System:
      return "system error";
    case Errc::OutOfRange:
      return "out of range";
    case Errc::Unsupported:
      return "not supported here";
    case Errc::Failed:
      return "the called code failed";
  }
  return "unknown error";
}

}  // namespace indurop
