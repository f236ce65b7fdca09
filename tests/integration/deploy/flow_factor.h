// SPDX-License-Identifier: Apache-2.0
// Values that no accident makes: a value is one of source if it is a small multiple of an odd number, modulo 2^64.

#pragma once

#include <cstdint>

namespace xt_flow {

inline constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15ULL;
inline constexpr std::uint64_t kInverse = 0xF1DE83E19937733DULL;
static_assert(kFactor * kInverse == 1);

}  // namespace xt_flow
