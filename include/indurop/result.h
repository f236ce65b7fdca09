// SPDX-License-Identifier: Apache-2.0
// Errors as values: the return type of a call that can fail for external reasons. The error needs no heap and is
// copyable.

#pragma once

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace indurop {

// Kinds of failure, append-only: numbers appear in logs and JSON.
enum class Errc : int {
  Ok = 0,
  InvalidArgument = 1,   // the caller's value is outside the documented range
  NotFound = 2,          // no such name, file, node or module
  AlreadyExists = 3,     // name in use
  PermissionDenied = 4,  // the operating system refused
  Overflow = 5,          // a result does not fit its type
  Timeout = 6,           // not done within the stated time
  Busy = 7,              // held by another user
  Corrupt = 8,           // checksum, magic or structure wrong
  VersionMismatch = 9,   // ABI or layout differs
  TypeMismatch = 10,     // variable or function has another type
  NoSpace = 11,          // memory or disk full
  Dead = 12,             // the process that should answer is gone
  System = 13,           // another errno, see sys_errno
  OutOfRange = 14,       // index or value beyond its declared bounds
  Unsupported = 15,      // not available on this machine
  Failed = 16,           // the code that was called threw an exception
};

// "no space left", for messages.
[[gnu::visibility("default")]] const char* to_string(Errc code) noexcept;

struct Error {
  Errc code = Errc::Ok;
  int sys_errno = 0;       // 0 if no system call was involved
  const char* where = "";  // static text: the operation that failed
};

// Either a value or an error: an Error, which costs nothing to pass, or another error type where people need more
// detail (core/base/problem.h). value() requires ok(), error() requires not ok(); asking for the other one is a bug of
// the caller and aborts.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  static_assert(!std::is_same_v<T, E>);
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(E error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)
  [[nodiscard]] bool ok() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }
  [[nodiscard]] T& value() & { return checked<0>(state_); }
  [[nodiscard]] const T& value() const& { return checked<0>(state_); }
  [[nodiscard]] T&& value() && { return std::move(checked<0>(state_)); }
  T* operator->() { return &checked<0>(state_); }
  const T* operator->() const { return &checked<0>(state_); }
  T& operator*() { return checked<0>(state_); }
  const T& operator*() const { return checked<0>(state_); }
  [[nodiscard]] const E& error() const& { return checked<1>(state_); }
  [[nodiscard]] E&& error() && { return std::move(checked<1>(state_)); }

 private:
  template <std::size_t Index, class State>
  static auto& checked(State& state) {
    auto* wanted = std::get_if<Index>(&state);
    if (wanted == nullptr) {
      std::abort();
    }
    return *wanted;
  }

  std::variant<T, E> state_;
};

// A result without a value, with an error that is more than an Error (else: Status).
template <class E>
class [[nodiscard]] Result<void, E> {
 public:
  Result() = default;
  Result(E error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)
  [[nodiscard]] bool ok() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }
  [[nodiscard]] const E& error() const& { return checked(error_); }
  [[nodiscard]] E&& error() && { return std::move(checked(error_)); }

 private:
  template <class Held>
  static auto& checked(Held& error) {
    if (!error.has_value()) {
      std::abort();
    }
    return *error;
  }

  std::optional<E> error_;
};

// Result without a value; copyable and without heap like Error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(error) {}  // NOLINT(google-explicit-constructor)
  [[nodiscard]] bool ok() const noexcept { return error_.code == Errc::Ok; }
  explicit operator bool() const noexcept { return ok(); }
  [[nodiscard]] const Error& error() const noexcept { return error_; }

 private:
  Error error_;
};

}  // namespace indurop
