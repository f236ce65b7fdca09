// SPDX-License-Identifier: Apache-2.0
// Tests of modules, PLC programs and whole configurations in virtual time. Link indurop::testing
// (find_package(InduRoP COMPONENTS testing)) and use any test framework:
//
//   TEST(Cell, StopsWhenTheDoorOpens) {
//     irp::testing::Plant p("module.xml");
//     p.set("PLC_ROBOT::I0", true);
//     p.run(200ms);
//     EXPECT_TRUE(p.get<bool>("PLC_ROBOT::O3"));
//   }
//
// The modules run in a process of their own, `indurop-node --sim`: the same way on every run, and a crash of a module
// is a fault to test for, not the end of the test. Not real-time safe, one thread at a time. On failure throws
// std::runtime_error, whose text states what failed and what to do, with the last output of the node.

#pragma once

#include <chrono>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace irp::testing {

struct Settings {
  std::string board{};                   // board to run if the file is a plant; empty: all boards
  std::filesystem::path times{};         // report of an earlier run with execution times; empty: <wcet>, or no time
  std::vector<std::string> arguments{};  // additional arguments for indurop-node
  std::chrono::seconds patience{30};     // real time limit of one call
};

// The counters of one module since the start.
struct ModuleCount {
  std::uint64_t runs = 0;  // for a process without the last run, which is counted at its next release
  std::uint64_t skipped = 0;
  std::uint64_t overruns = 0;
  std::uint64_t deadline_misses = 0;
  std::uint64_t faults = 0;
  std::uint64_t restarts = 0;
  bool faulted = false;      // it is no longer executed
  std::string last_fault{};  // "exception: no sensor"
};

class Plant {
 public:
  // Starts the configuration; it is halted before its first tick, with initial values. From now on the variables of the
  // generated header in this program are those of this plant: `EXPECT_EQ(tick, 5)` works as in a module, unless it has
  // several boards. For a plant's manifest all boards run, with a simulated network; a name that several boards have is
  // qualified with the board: "torque@control", "table@sensor".
  explicit Plant(const std::filesystem::path& configuration, const Settings& settings = {});
  ~Plant();
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  // Advances virtual time, in whole basic periods (rounded up). Afterwards it is halted again after a tick: everything
  // that belongs to that tick is done.
  void run(std::chrono::nanoseconds time);
  void step(std::uint64_t ticks = 1);
  // Runs tick by tick until the condition holds; returns false if it does not hold within this time.
  bool run_until(const std::function<bool()>& condition, std::chrono::nanoseconds at_most);

  [[nodiscard]] std::uint64_t tick() const;  // ticks run so far
  [[nodiscard]] std::chrono::nanoseconds time() const;
  [[nodiscard]] std::chrono::nanoseconds basic_period() const;

  // Returns the value of a variable or a part of it by name, "joints[1].y"; leading namespaces may be left out if that
  // is unique. Numbers are converted if T can hold the value; std::string is the text of a variable, else its value as
  // `indurop get` prints it; any other T must have the part's size.
  template <class T>
  [[nodiscard]] T get(std::string_view name) const;
  // Writes the value once; a declared @range is not checked. Text is parsed as by `indurop set`: "{x: 1, y: 2}",
  // "Running".
  template <class T>
  void set(std::string_view name, const T& value);
  // Holds the variable at the value against all writers. Numbers only.
  template <class T>
  void force(std::string_view name, const T& value);
  void unforce(std::string_view name);

  [[nodiscard]] ModuleCount module(std::string_view name) const;
  // Kills the process of a process module at once, as a crash would.
  void kill(std::string_view module);

  // Records the values of these variables at the end of each tick, from now on.
  void trace(std::vector<std::string> names);
  // Compares the trace with a CSV file: one line for each tick in which something changed. Returns a description of the
  // first difference, empty if there is none. With INDUROP_UPDATE_GOLDEN=1 in the environment it writes the file.
  [[nodiscard]] std::string differs_from_golden(const std::filesystem::path& file) const;

  // Returns everything that the node and its modules printed.
  [[nodiscard]] std::string printed() const;

 private:
  [[nodiscard]] long double number(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name) const;
  void bytes(std::string_view name, std::span<std::uint8_t> to) const;
  void set_text(std::string_view name, const std::string& text, bool hold);
  void set_bytes(std::string_view name, std::span<const std::uint8_t> from);
  [[noreturn]] static void cannot_hold(std::string_view name, long double value);
  static std::string words(long double value);

  template <class T>
  static std::string text_of(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      return value ? "true" : "false";
    } else if constexpr (std::integral<T>) {
      return std::to_string(value);
    } else if constexpr (std::floating_point<T>) {
      return words(static_cast<long double>(value));
    } else {
      return std::string(value);
    }
  }

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

template <class T>
T Plant::get(std::string_view name) const {
  if constexpr (std::is_same_v<T, std::string>) {
    return text(name);
  } else if constexpr (std::is_same_v<T, bool>) {
    return number(name) != 0;
  } else if constexpr (std::is_arithmetic_v<T>) {
    const long double value = number(name);
    if constexpr (std::integral<T>) {
      if (value < static_cast<long double>(std::numeric_limits<T>::min()) ||
          value > static_cast<long double>(std::numeric_limits<T>::max()) ||
          static_cast<long double>(static_cast<T>(value)) != value) {
        cannot_hold(name, value);
      }
    }
    return static_cast<T>(value);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(get<std::underlying_type_t<T>>(name));
  } else {
    static_assert(std::is_trivially_copyable_v<T>, "shared values are plain bytes");
    T value{};
    bytes(name, {reinterpret_cast<std::uint8_t*>(&value), sizeof value});
    return value;
  }
}

template <class T>
void Plant::set(std::string_view name, const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::constructible_from<std::string, const T&>) {
    set_text(name, text_of(value), false);
  } else if constexpr (std::is_enum_v<T>) {
    set_text(name, std::to_string(static_cast<std::underlying_type_t<T>>(value)), false);
  } else {
    static_assert(std::is_trivially_copyable_v<T>, "shared values are plain bytes");
    set_bytes(name, {reinterpret_cast<const std::uint8_t*>(&value), sizeof value});
  }
}

template <class T>
void Plant::force(std::string_view name, const T& value) {
  set_text(name, text_of(value), true);
}

}  // namespace irp::testing
