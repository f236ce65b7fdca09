// SPDX-License-Identifier: Apache-2.0
// Units in terms of the SI, so that tools can convert them and refuse connections between different quantities.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace indurop::fmi {

// value in SI base units = factor * value + offset
struct UnitInSi {
  std::array<std::int8_t, 8> exponents{};  // of kg, m, s, A, K, mol, cd, rad
  double factor = 1;
  double offset = 0;
};
inline constexpr std::array<const char*, 8> kSiNames{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};

// Returns nothing for a unit that is not known.
std::optional<UnitInSi> unit_in_si(std::string_view unit);

}  // namespace indurop::fmi
