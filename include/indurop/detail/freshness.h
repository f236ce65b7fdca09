// SPDX-License-Identifier: Apache-2.0
// How fresh the value of a variable is that another board owns.

#pragma once

#include <indurop/detail/abi.h>

#include <chrono>
#include <cstdint>
#include <limits>

namespace indurop::detail {

template <class Tag>
constexpr std::int64_t max_age_ns() noexcept {
  if constexpr (requires { Tag::kMaxAgeNs; }) {
    return Tag::kMaxAgeNs;
  } else {
    return 0;
  }
}

inline std::int64_t steady_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

template <class Tag>
std::chrono::nanoseconds age() noexcept {
  const std::int64_t confirmed = abi::confirmed_of(Tag::ref().entry, Tag::kKind).load(std::memory_order_acquire);
  if (confirmed == 0) {
    return std::chrono::nanoseconds::zero();
  }
  if (confirmed == abi::kNeverConfirmed) {
    return std::chrono::nanoseconds::max();
  }
  return std::chrono::nanoseconds(steady_ns() - (confirmed > 0 ? confirmed : -confirmed));
}

template <class Tag>
bool valid() noexcept {
  const std::int64_t confirmed = abi::confirmed_of(Tag::ref().entry, Tag::kKind).load(std::memory_order_acquire);
  if (confirmed <= 0) {
    return confirmed == 0;
  }
  return max_age_ns<Tag>() == 0 || steady_ns() - confirmed <= max_age_ns<Tag>();
}

}  // namespace indurop::detail
