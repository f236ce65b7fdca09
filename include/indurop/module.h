// SPDX-License-Identifier: Apache-2.0
// The description that a thread module gives of itself: INDUROP_MODULE(run = &::onRun) as in Figures 4 and 5 of the
// chapter.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/detail/hand_over.h>
#include <indurop/detail/mark.h>

#include <cstddef>
#include <cstdint>

namespace indurop {

// The condition() of a sporadic module: `int condition()` as in Figure 7, or `bool condition()`.
struct Condition {
  int (*as_int)() = nullptr;
  bool (*as_bool)() = nullptr;

  Condition& operator=(int (*function)()) noexcept {
    as_int = function;
    as_bool = nullptr;
    return *this;
  }
  Condition& operator=(bool (*function)()) noexcept {
    as_bool = function;
    as_int = nullptr;
    return *this;
  }
  explicit operator bool() const noexcept { return as_int != nullptr || as_bool != nullptr; }
  // Requires that one of the two functions is set.
  [[nodiscard]] bool operator()() const { return as_int != nullptr ? as_int() != 0 : as_bool(); }
};

// Filled in by the module for the node. New fields go at the end only: `size` states how much of it the module knew.
struct ModuleDescriptor {
  std::uint32_t size = sizeof(ModuleDescriptor);
  std::uint32_t abi = abi::kVersion;
  void (*run)() = nullptr;    // every period, or when condition() is true. Real-time
  void (*start)() = nullptr;  // once before the first run(). Not real-time: allocate, open, read properties here
  void (*stop)() = nullptr;   // once after the last run(). Not real-time
  Condition condition;        // sporadic modules: has the event occurred? Real-time
  const char* name = nullptr;
  const char* description = nullptr;
  const char* author = nullptr;
  const char* license = nullptr;
};
static_assert(offsetof(ModuleDescriptor, abi) == 4, "size and ABI stay where they are for all versions");

}  // namespace indurop

extern "C" {
// Every thread module that uses INDUROP_MODULE defines this function. The caller sets `size`; no more than that is
// written, and `size` and `abi` then state what the module was built with. Does not call into the module.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the macro's cannot clash with names of a module
[[gnu::visibility("default")]] void indurop_module_describe(indurop::ModuleDescriptor* descriptor);
}

// INDUROP_MODULE(run = &::onRun, start = &::onStart, name = "gripper") goes on one line of one source file of a thread
// module, with or without a semicolon. In any order and all optional: run, start, stop, condition (functions;
// captureless lambdas work too), name, description, author, license (text). Functions are named with :: as in the
// chapter, because inside the parentheses run, start, stop and the others are the fields.
#define INDUROP_MODULE(...)                                                                     \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wshadow\"") extern "C" void \
  indurop_module_describe(::indurop::ModuleDescriptor* indurop_to_) {                           \
    ::indurop::ModuleDescriptor indurop_d_;                                                     \
    [[maybe_unused]] auto& run = indurop_d_.run;                                                \
    [[maybe_unused]] auto& start = indurop_d_.start;                                            \
    [[maybe_unused]] auto& stop = indurop_d_.stop;                                              \
    [[maybe_unused]] auto& condition = indurop_d_.condition;                                    \
    [[maybe_unused]] auto& name = indurop_d_.name;                                              \
    [[maybe_unused]] auto& description = indurop_d_.description;                                \
    [[maybe_unused]] auto& author = indurop_d_.author;                                          \
    [[maybe_unused]] auto& license = indurop_d_.license;                                        \
    (__VA_ARGS__);                                                                              \
    ::indurop::detail::hand_over(indurop_d_, indurop_to_);                                      \
  }                                                                                             \
  _Pragma("GCC diagnostic pop")
