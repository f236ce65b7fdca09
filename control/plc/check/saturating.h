// SPDX-License-Identifier: Apache-2.0
// Sums and products of sizes that a program declares: results beyond 64 bits become the largest number.

#pragma once

#include <cstdint>
#include <limits>

namespace indurop::plc {

[[nodiscard]] inline std::uint64_t sum_of(std::uint64_t a, std::uint64_t b) noexcept {
  std::uint64_t out = 0;
  return __builtin_add_overflow(a, b, &out) ? std::numeric_limits<std::uint64_t>::max() : out;
}

[[nodiscard]] inline std::uint64_t product_of(std::uint64_t a, std::uint64_t b) noexcept {
  std::uint64_t out = 0;
  return __builtin_mul_overflow(a, b, &out) ? std::numeric_limits<std::uint64_t>::max() : out;
}

}  // namespace indurop::plc
