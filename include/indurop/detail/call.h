// SPDX-License-Identifier: Apache-2.0
// The structures that the templates of <indurop/function.h> pass to libindurop.

#pragma once

#include <cstdint>
#include <type_traits>

namespace indurop::detail {

struct CallRequest {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  const void* args;
  void* result;
  std::uint32_t args_size;
  std::uint32_t result_size;
  std::int64_t deadline_ns;  // from now
};

struct FunctionOffer {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  const char* name;
  void (*invoke)(const void* arguments, void* result);
  std::uint32_t args_size;
  std::uint32_t result_size;
};

// Number of argument bytes to transfer: none for an empty struct, whose sizeof is 1.
template <class Args>
constexpr std::uint32_t packed_size() noexcept {
  static_assert(std::is_trivially_copyable_v<Args>);
  return std::is_empty_v<Args> ? 0 : sizeof(Args);
}

}  // namespace indurop::detail

extern "C" {
// Returns an indurop::Errc, Ok = 0. No allocation.
int indurop_call(const indurop::detail::CallRequest* request) noexcept;
[[noreturn]] void indurop_call_fault(const char* function, int code);
void indurop_offer_function(indurop::detail::FunctionOffer* offer) noexcept;
void indurop_withdraw_function(indurop::detail::FunctionOffer* offer) noexcept;
}
