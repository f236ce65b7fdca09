// SPDX-License-Identifier: Apache-2.0
// The values that a PLC program built with --watch reports to `indurop plc watch` at the end of a scan: its variables,
// one after the other without gaps. Real-time safe.

#pragma once

#include <indurop/plc/types.h>
#include <indurop/var.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace indurop::iec {

class Watch {
 public:
  // `to` must have space for everything that is written.
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
  // Writes contiguous members of `all`, from `first` on.
  template <class All, class First>
  void put_row(const All& all, const First& first, std::size_t size) noexcept {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&all);
    bytes(begin + (reinterpret_cast<const std::uint8_t*>(&first) - begin), size);
  }

  // What another version of the program wrote there must not stay.
  void clear_to(const std::uint8_t* end) noexcept {
    static constexpr std::array<std::uint8_t, 64> kZeros{};
    while (to_ < end) {
      bytes(kZeros.data(), std::min<std::size_t>(kZeros.size(), static_cast<std::size_t>(end - to_)));
    }
  }

 private:
  void bytes(const void* from, std::size_t size) noexcept {
    indurop::detail::copy_to_shared(to_, from, size);
    to_ += size;
  }
  std::uint8_t* to_;
};

// Writes the shared variable `Tag`, bytes, directly in shared memory: a program has thousands of values, which are not
// collected elsewhere first. `show` writes everything but the mark and the zeros behind it.
template <class Tag, class Show>
void tell(std::uint64_t mark, Show show) noexcept {
  static_assert(Tag::kKind == abi::Kind::Ring);
  indurop::detail::record_access<Tag, indurop::detail::kWrite>();
  abi::RingHeader* ring = indurop::detail::ring_of<Tag>();
  if (void* to = indurop_begin_write(ring, 0, Tag::kSize)) [[likely]] {
    Watch out(static_cast<std::uint8_t*>(to));
    out.put(mark);
    show(out);
    out.clear_to(static_cast<std::uint8_t*>(to) + Tag::kSize);
    indurop_commit_write(ring);
  }
}

// Writes the power flow at some points of a drawn body, one by one: bytes written singly are not read back at once as a
// whole.
template <class... Power>
[[gnu::always_inline]] inline void put_flow(bool* to, Power... power) noexcept {
  ((*to++ = power), ...);
}

}  // namespace indurop::iec
