// SPDX-License-Identifier: Apache-2.0
// What a PLC program keeps between its scans, as the module declares it (<indurop/state.h>).

#pragma once

#include <indurop/plc/lifetime.h>
#include <indurop/plc/object.h>
#include <indurop/plc/pointer.h>
#include <indurop/state.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace indurop::iec {

// A size of 0 says that the variable cannot be copied as bytes.
template <class T>
constexpr StateItem kept(std::string_view name, std::string_view type, T& variable) noexcept {
  return {name.data(), static_cast<std::uint32_t>(name.size()), static_cast<std::uint32_t>(type.size()),
          type.data(), static_cast<void*>(&variable),           std::is_trivially_copyable_v<T> ? sizeof(T) : 0};
}

// A pointer begins as an address of a kept variable does. One to a variable of a call has ended between two scans.
static_assert(offsetof(Pointer<int>, base) == offsetof(StateAddress, to));
static_assert(offsetof(Pointer<int>, size) == offsetof(StateAddress, size));
static_assert(offsetof(Pointer<int>, call) == offsetof(StateAddress, ended));

// A variable that pointers may lead to, and that is not kept itself or in several parts.
template <class T>
constexpr StateItem kept_place(std::string_view name, std::string_view type, T& variable) noexcept {
  StateItem item = kept(name, type, variable);
  item.size = sizeof(T);
  return item;
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
