// SPDX-License-Identifier: Apache-2.0
// What a thread module keeps from one run to the next: INDUROP_STATE(counter, filter). The node copies it between two
// runs into keyframes, from which a replay begins in the middle of a recording.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/detail/hand_over.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace indurop {

// One variable that keeps its value between runs. The texts are not terminated.
struct StateItem {
  const char* name = nullptr;
  std::uint32_t name_length = 0;
  std::uint32_t type_length = 0;
  const char* type = nullptr;
  void* address = nullptr;
  std::uint64_t size = 0;  // 0: it cannot be copied as bytes
};

// An item whose type begins with kStateAddress leads to another item. It begins with a StateAddress, or with its first
// member only, and is put back so that it leads to the same item of the other process.
inline constexpr std::string_view kStateAddress = "address: ";
struct StateAddress {
  const void* to = nullptr;  // the item, or a place inside of it
  std::uint32_t size = 0;    // of the item; 0: not known
  std::uint32_t ended = 0;   // not 0: what it led to has ended, and it is not used any more
};
// An item whose type begins with kStatePlace has no bytes of its own in a keyframe: addresses may lead to it. Its type
// says all that decides about what lies where inside of it.
inline constexpr std::string_view kStatePlace = "place: ";
// An item whose type begins with kStateShown is written by the runs and read by none, for tools that show it: another
// version of the module does not need it.
inline constexpr std::string_view kStateShown = "shown: ";

// Filled in by the module for the node. New fields go at the end only: `size` states how much of it the module knew.
struct StateDescriptor {
  std::uint32_t size = sizeof(StateDescriptor);
  std::uint32_t abi = abi::kVersion;
  const StateItem* items = nullptr;
  std::uint32_t item_count = 0;
  std::uint32_t item_size = sizeof(StateItem);
  // Instead of items: `save` writes at most `most` bytes and returns how many it wrote; 0: it cannot now. It is called
  // on a normal thread between two runs; one may begin meanwhile, and what was written is discarded then. So `save`
  // copies members of fixed places: it takes no lock, follows no pointer that a run changes, and writes nothing else.
  // `restore` is called after start() and before the first run; false: these bytes do not fit.
  std::size_t most = 0;
  std::size_t (*save)(void* to, std::size_t most) = nullptr;
  bool (*restore)(const void* from, std::size_t bytes) = nullptr;
  // What the module keeps and this description cannot contain, as text for people; null: nothing.
  const char* missing = nullptr;
};
static_assert(offsetof(StateDescriptor, abi) == 4, "size and ABI stay where they are for all versions");

}  // namespace indurop

extern "C" {
// Every thread module that declares its state defines this function. The caller sets `size`; no more than that is
// written, and `size` and `abi` then state what the module was built with. Does not call into the module.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the macro's cannot clash with names of a module
[[gnu::visibility("default")]] void indurop_module_state(indurop::StateDescriptor* descriptor);
}

namespace indurop::detail {

// The name of a type as the compiler writes it: "[T = int [4]]" or "[with T = int [4]; ...]" ends this function's own.
template <class T>
constexpr std::string_view type_name() noexcept {
  constexpr std::string_view kText = __PRETTY_FUNCTION__;
  constexpr std::size_t kBegin = kText.find("T = ") + 4;
  constexpr std::size_t kSemicolon = kText.find(';', kBegin);
  constexpr std::size_t kEnd = kSemicolon != std::string_view::npos ? kSemicolon : kText.rfind(']');
  return kText.substr(kBegin, kEnd - kBegin);
}

// Takes the first name off a list that the preprocessor wrote: "counter, filters[0]".
constexpr std::string_view next_name(std::string_view& names) noexcept {
  while (!names.empty() && names.front() == ' ') {
    names.remove_prefix(1);
  }
  std::size_t end = 0;
  for (int depth = 0; end < names.size() && (depth > 0 || names[end] != ','); ++end) {
    depth += names[end] == '<' || names[end] == '(' || names[end] == '[' ? 1 : 0;
    depth -= names[end] == '>' || names[end] == ')' || names[end] == ']' ? 1 : 0;
  }
  const std::string_view name = names.substr(0, end);
  names.remove_prefix(end < names.size() ? end + 1 : end);
  return name;
}

template <class T>
constexpr StateItem state_item(std::string_view& names, T& variable) noexcept {
  static_assert(
      std::is_trivially_copyable_v<T>,
      "INDUROP_STATE: this type cannot be copied as bytes (it has a copy constructor, a destructor or virtual "
      "functions). List its members that can, or use INDUROP_STATE_BY(most = ..., save = ..., restore = ...)");
  static_assert(!std::is_pointer_v<std::remove_all_extents_t<T>>,
                "INDUROP_STATE: an address means nothing in another process. Keep an index instead, or use "
                "INDUROP_STATE_BY(most = ..., save = ..., restore = ...)");
  static_assert(!std::is_const_v<T>, "INDUROP_STATE: a constant is no state; leave it out");
  const std::string_view name = next_name(names);
  constexpr std::string_view kType = type_name<T>();
  return {
      name.data(),
      static_cast<std::uint32_t>(name.size()),
      static_cast<std::uint32_t>(kType.size()),
      kType.data(),
      const_cast<void*>(static_cast<const volatile void*>(&variable)),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
      sizeof(T)};
}

template <class... T>
constexpr std::array<StateItem, sizeof...(T)> state_items(std::string_view names, T&... variables) noexcept {
  return {state_item(names, variables)...};
}

}  // namespace indurop::detail

// INDUROP_STATE(counter, filter) goes on one line of one source file of a thread module, after the variables: those of
// namespace scope, static members and static variables that keep a value between runs. Their types can be copied as
// bytes. With nothing in it, the module says that it keeps nothing. A thread_local variable does not compile here ("not
// a constant expression"): it has no fixed place.
#define INDUROP_STATE(...)                                                                                          \
  extern "C" void indurop_module_state(::indurop::StateDescriptor* indurop_to_) {                                   \
    static constexpr auto indurop_items_ = ::indurop::detail::state_items(#__VA_ARGS__ __VA_OPT__(, ) __VA_ARGS__); \
    ::indurop::StateDescriptor indurop_d_;                                                                          \
    indurop_d_.items = indurop_items_.data();                                                                       \
    indurop_d_.item_count = static_cast<::std::uint32_t>(indurop_items_.size());                                    \
    ::indurop::detail::hand_over(indurop_d_, indurop_to_);                                                          \
  }

// INDUROP_STATE_BY(most = 4096, save = &::saveState, restore = &::restoreState) stands in its place where variables
// cannot be copied as bytes; see StateDescriptor for what the functions may do.
#define INDUROP_STATE_BY(...)                                                                                         \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wshadow\"") extern "C" void indurop_module_state( \
      ::indurop::StateDescriptor* indurop_to_) {                                                                      \
    ::indurop::StateDescriptor indurop_d_;                                                                            \
    [[maybe_unused]] auto& most = indurop_d_.most;                                                                    \
    [[maybe_unused]] auto& save = indurop_d_.save;                                                                    \
    [[maybe_unused]] auto& restore = indurop_d_.restore;                                                              \
    (__VA_ARGS__);                                                                                                    \
    ::indurop::detail::hand_over(indurop_d_, indurop_to_);                                                            \
  }                                                                                                                   \
  _Pragma("GCC diagnostic pop")
