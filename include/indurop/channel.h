// SPDX-License-Identifier: Apache-2.0
// Shared variables by name, for programs without a generated header (Figure 8):
//   channel::Handle handle;
//   read(handle, "joint[1].y", sizeof(y), &y);

#pragma once

#include <indurop/detail/mark.h>
#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>

namespace channel {

// A connection to one node's variables, with a cache of the names already resolved. Belongs to one thread at a time.
class Handle {
 public:
  Handle() noexcept;
  Handle(Handle&&) noexcept;
  Handle& operator=(Handle&&) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle();

  struct Impl;
  [[nodiscard]] Impl& impl();

 private:
  std::unique_ptr<Impl> impl_;
};

// Connects to the node `node`; "" = INDUROP_NODE, else "local". Optional: the first read or write connects, and both
// reconnect automatically when the node has been replaced. Not real-time safe. Returns 0 or a negative indurop::Errc:
// NotFound (no such node), PermissionDenied, VersionMismatch, Corrupt.
int connect(Handle& handle, const char* node = "");

// Copies one consistent value of the variable or part called `name` ("tick", "joint[1].y", "knu::Robot::joints").
// `size` must be the part's size. Leading namespaces may be left out where that is unique.
// Returns the number of bytes, or a negative indurop::Errc after one message per name saying what to do:
// NotFound (no node, no such variable), OutOfRange (index), InvalidArgument (not a name), TypeMismatch (other size),
// Timeout. Variables that the node has now and did not have before, or with another type, are found. Real-time safe
// from the second access by the same name on, as long as the node is not replaced and the variable keeps its type.
std::ptrdiff_t read(Handle& handle, std::string_view name, std::size_t size, void* to);
// Replaces the part in one commit. Errors as for read(), and Busy (another writer was stopped while writing),
// PermissionDenied (this user may only read).
std::ptrdiff_t write(Handle& handle, std::string_view name, std::size_t size, const void* from);

namespace detail {
// The basic type that the part must have for a T; Any: only the size is checked.
enum class Basic : std::uint32_t { Any, Bool, Signed, Unsigned, Real };
template <class T>
constexpr Basic basic() noexcept {
  if constexpr (std::is_same_v<T, bool>) {
    return Basic::Bool;
  } else if constexpr (std::is_floating_point_v<T>) {
    return Basic::Real;
  } else if constexpr (std::is_same_v<T, char> || !std::is_integral_v<T>) {
    return Basic::Any;
  } else {
    return std::is_signed_v<T> ? Basic::Signed : Basic::Unsigned;
  }
}
std::ptrdiff_t access(Handle& handle, std::string_view name, std::size_t size, void* value, Basic basic, bool is_write);
}  // namespace detail

// read<double>(handle, "joint[1].y"): the same with the type checked too.
template <class T>
indurop::Result<T> read(Handle& handle, std::string_view name) {
  static_assert(std::is_trivially_copyable_v<T>, "shared values are plain bytes");
  T value{};
  const std::ptrdiff_t done = detail::access(handle, name, sizeof(T), &value, detail::basic<T>(), false);
  if (done < 0) {
    return indurop::Error{static_cast<indurop::Errc>(-done), 0, "read a shared variable by name"};
  }
  return value;
}

template <class T>
indurop::Status write(Handle& handle, std::string_view name, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>, "shared values are plain bytes");
  T copy = value;
  const std::ptrdiff_t done = detail::access(handle, name, sizeof(T), &copy, detail::basic<T>(), true);
  if (done < 0) {
    return indurop::Error{static_cast<indurop::Errc>(-done), 0, "write a shared variable by name"};
  }
  return {};
}

}  // namespace channel
