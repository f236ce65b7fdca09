// SPDX-License-Identifier: Apache-2.0
// The freshness of a variable's value that another board owns.

#pragma once

#include <indurop/detail/abi.h>

#include <chrono>
#include <cstdint>
#include <limits>

namespace irp {
std::int64_t now_ns() noexcept;  // <indurop/irp.h>
}

// Returns the value of abi::confirmed_of() that the run is to see: the given one, which is recorded on its track, or
// the recorded one if the run is repeated. Real-time safe.
extern "C" std::int64_t indurop_see_confirmed(std::int64_t confirmed) noexcept;

namespace indurop::detail {

template <class Tag>
constexpr std::int64_t max_age_ns() noexcept {
  if constexpr (requires { Tag::kMaxAgeNs; }) {
    return Tag::kMaxAgeNs;
  } else {
    return 0;
  }
}

// Decodes the value of abi::confirmed_of() into an age. `now_ns` returns the time; it is called only where it matters.
template <class Now>
std::chrono::nanoseconds age_of(std::int64_t confirmed, Now now_ns) noexcept {
  if (confirmed == 0) {
    return std::chrono::nanoseconds::zero();
  }
  if (confirmed == abi::kNeverConfirmed) {
    return std::chrono::nanoseconds::max();
  }
  return std::chrono::nanoseconds(now_ns() - (confirmed > 0 ? confirmed : -confirmed));
}

template <class Now>
bool is_valid(std::int64_t confirmed, std::int64_t max_age, Now now_ns) noexcept {
  if (confirmed <= 0) {
    return confirmed == 0;
  }
  return max_age == 0 || now_ns() - confirmed <= max_age;
}

template <class Tag>
std::int64_t confirmed() noexcept {
  return indurop_see_confirmed(abi::confirmed_of(Tag::ref().entry, Tag::kKind).load(std::memory_order_acquire));
}

template <class Tag>
std::chrono::nanoseconds age() noexcept {
  return age_of(confirmed<Tag>(), irp::now_ns);
}

template <class Tag>
bool valid() noexcept {
  return is_valid(confirmed<Tag>(), max_age_ns<Tag>(), irp::now_ns);
}

}  // namespace indurop::detail
