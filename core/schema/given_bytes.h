// SPDX-License-Identifier: Apache-2.0
// Which parts of a value a text gives: `{x: 1}` gives x alone.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace indurop::schema {

// Returns 1 for each byte of a value that `read(bytes)` writes, which parses a text over the bytes it gets, and 0 for
// all others; only 1 if it returns false.
template <class Read>
std::vector<std::uint8_t> given_bytes(std::size_t size, Read read) {
  // Bytes that are equal after parsing the text over zeros and over ones were given in the text.
  std::vector<std::uint8_t> zeros(size, 0x00);
  std::vector<std::uint8_t> ones(size, 0xFF);
  if (!read(std::span(zeros)) || !read(std::span(ones))) {
    std::fill(ones.begin(), ones.end(), std::uint8_t{1});
    return ones;
  }
  std::transform(zeros.begin(), zeros.end(), ones.begin(), ones.begin(),
                 [](std::uint8_t over_zeros, std::uint8_t over_ones) { return over_zeros == over_ones ? 1 : 0; });
  return ones;
}

}  // namespace indurop::schema
