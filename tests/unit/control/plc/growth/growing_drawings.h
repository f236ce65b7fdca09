// SPDX-License-Identifier: Apache-2.0
// Drawn programs with n of something, as PLCopen XML.

#pragma once

#include <cstddef>
#include <string>

namespace indurop::plc::testing {

[[nodiscard]] std::string rungs(std::size_t n);
[[nodiscard]] std::string contacts_in_series(std::size_t n);
[[nodiscard]] std::string contacts_in_parallel(std::size_t n);
// Each pair of contacts leads to both of the next pair: 2^n ways.
[[nodiscard]] std::string contacts_crosswise(std::size_t n);
[[nodiscard]] std::string blocks_in_series(std::size_t n);
// Both inputs of each from the one before: 2^n as an expression.
[[nodiscard]] std::string blocks_doubled(std::size_t n);
// Each of n operands goes into two blocks, which are n columns apart.
[[nodiscard]] std::string blocks_far_apart(std::size_t n);
// n contacts in series, and n rungs.
[[nodiscard]] std::string rungs_wide(std::size_t n);
[[nodiscard]] std::string networks(std::size_t n);
[[nodiscard]] std::string connectors(std::size_t n);

}  // namespace indurop::plc::testing
