// SPDX-License-Identifier: Apache-2.0
// What a PLC program keeps between its scans, as the module declares it (<indurop/state.h>).

#pragma once

#include <indurop/state.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace indurop::iec {

// A size of 0 says that the variable cannot be copied as bytes.
template <class T>
constexpr StateItem kept(std::string_view name, std::string_view type, T& variable) noexcept {
  return {name.data(), static_cast<std::uint32_t>(name.size()), static_cast<std::uint32_t>(type.size()),
          type.data(), static_cast<void*>(&variable),           std::is_trivially_copyable_v<T> ? sizeof(T) : 0};
}

// `missing`: what else it keeps; null: nothing.
template <std::size_t N>
void declare_kept(const std::array<StateItem, N>& items, const char* missing, StateDescriptor* to) noexcept {
  StateDescriptor all;
  all.items = items.data();
  all.item_count = static_cast<std::uint32_t>(N);
  all.missing = missing;
  indurop::detail::hand_over(all, to);
}

}  // namespace indurop::iec
