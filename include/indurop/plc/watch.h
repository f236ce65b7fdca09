// SPDX-License-Identifier: Apache-2.0
// What a PLC program built with --watch tells `indurop plc watch` at the end of a scan: the values of its variables,
// one behind the other without gaps. Real-time safe.

#pragma once

#include <indurop/plc/types.h>
#include <indurop/var.h>

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
    indurop::detail::copy_to_shared(to_, from, size);
    to_ += size;
  }
  std::uint8_t* to_;
};

// Writes the shared variable `Tag`, bytes, in its place in shared memory: a program has thousands of them, which are
// not put together elsewhere first. `show` puts all but the mark.
template <class Tag, class Show>
void tell(std::uint64_t mark, Show show) noexcept {
  static_assert(Tag::kKind == abi::Kind::Ring);
  indurop::detail::record_access<Tag, indurop::detail::kWrite>();
  abi::RingHeader* ring = indurop::detail::ring_of<Tag>();
  if (void* to = indurop_begin_write(ring, 0, Tag::kSize)) [[likely]] {
    Watch out(static_cast<std::uint8_t*>(to));
    out.put(mark);
    show(out);
    indurop_commit_write(ring);
  }
}

// The power at some points of a drawn body, one by one: what was written in bytes is not read at once as a whole.
template <class... Power>
[[gnu::always_inline]] inline void put_flow(bool* to, Power... power) noexcept {
  ((*to++ = power), ...);
}

}  // namespace indurop::iec
