// SPDX-License-Identifier: Apache-2.0
// What a PLC program built with --watch tells `indurop plc watch` at the end of a scan: the values of its variables,
// one behind the other without gaps. Real-time safe.

#pragma once

#include <indurop/plc/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace indurop::iec {

class Watch {
 public:
  // `to` has room for everything that is put.
  explicit Watch(std::uint8_t* to) noexcept : to_(to) {}

  template <class T>
  void put(const T& value) noexcept {
    if constexpr (Timelike<T>) {
      bytes(&value.ns, sizeof value.ns);
    } else {
      static_assert(std::is_scalar_v<T> || Text<T>);
      bytes(&value, sizeof value);
    }
  }
  template <class T, std::size_t N>
  void put(const std::array<T, N>& values) noexcept {
    if constexpr (std::is_scalar_v<T>) {
      bytes(values.data(), sizeof values);
    } else {
      for (const T& one : values) {
        put(one);
      }
    }
  }
  // Members of `all` that lie behind each other, from `first` on.
  template <class All, class First>
  void put_row(const All& all, const First& first, std::size_t size) noexcept {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&all);
    bytes(begin + (reinterpret_cast<const std::uint8_t*>(&first) - begin), size);
  }

 private:
  void bytes(const void* from, std::size_t size) noexcept {
    std::memcpy(to_, from, size);
    to_ += size;
  }
  std::uint8_t* to_;
};

// The power at some points of a drawn body, one by one: what was written in bytes is not read at once as a whole.
template <class... Power>
[[gnu::always_inline]] inline void put_flow(bool* to, Power... power) noexcept {
  ((*to++ = power), ...);
}

}  // namespace indurop::iec
