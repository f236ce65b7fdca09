// SPDX-License-Identifier: Apache-2.0
// ARRAY[*]: an array of the caller, whose bounds are known during the call only. Real-time safe, except for the faults.

#pragma once

#include <indurop/plc/fault.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::iec {

template <class T, std::size_t N>
class Slice {
 public:
  struct Bounds {
    std::int32_t low;
    std::int32_t high;
  };

  Slice() = default;
  // Refers to all elements of `whole`, which may be an array of arrays: they are contiguous.
  template <class Array>
  Slice(Array& whole, std::array<Bounds, N> bounds) noexcept : first_(reinterpret_cast<T*>(&whole)), bounds_(bounds) {}

  template <class... Index>
  [[nodiscard]] T& at(Place place, Index... indices) const {
    static_assert(sizeof...(Index) == N);
    std::int64_t offset = 0;
    std::size_t dimension = 0;
    for (const std::int64_t index : {indices...}) {
      const Bounds& bounds = bounds_[dimension++];
      if (index < bounds.low || index > bounds.high) [[unlikely]] {
        fail_range(place, "index", index, bounds.low, bounds.high);
      }
      offset = offset * (std::int64_t{bounds.high} - bounds.low + 1) + (index - bounds.low);
    }
    return first_[offset];
  }
  [[nodiscard]] std::int32_t low(Place place, std::int32_t dimension) const { return bounds(place, dimension).low; }
  [[nodiscard]] std::int32_t high(Place place, std::int32_t dimension) const { return bounds(place, dimension).high; }

 private:
  [[nodiscard]] const Bounds& bounds(Place place, std::int32_t dimension) const {
    if (dimension < 1 || dimension > static_cast<std::int32_t>(N)) [[unlikely]] {
      fail_range(place, "the dimension", dimension, 1, static_cast<std::int64_t>(N));
    }
    return bounds_[static_cast<std::size_t>(dimension - 1)];
  }

  T* first_ = nullptr;
  std::array<Bounds, N> bounds_{};
};

}  // namespace indurop::iec
