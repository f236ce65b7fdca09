// SPDX-License-Identifier: Apache-2.0
// The functions of the chapter's namespace irp: printing from real-time code, the life cycle of a periodic or sporadic
// process (Figure 8), a module's properties, and queries about its schedule.

#pragma once

#include <indurop/detail/mark.h>
#include <indurop/detail/print_argument.h>
#include <indurop/var.h>

#include <chrono>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace irp {

namespace detail {

template <class... Value>
int print(const char* format, const Value&... values) noexcept {
  const indurop::detail::PrintArgument arguments[] = {indurop::detail::print_argument(values)..., {}};
  return indurop_print(format, arguments, sizeof...(Value));
}

// Each returns false, and leaves `value` unchanged, if the module has no such property or (after one message) if its
// text is not a value of the type.
bool property_signed(const char* name, std::int64_t min, std::int64_t max, std::int64_t& value);
bool property_unsigned(const char* name, std::uint64_t max, std::uint64_t& value);
bool property_real(const char* name, double& value);
bool property_bool(const char* name, bool& value);
// Returns null if the module has no such property. The text is valid until the node's run ends.
const char* property_text(const char* name);

}  // namespace detail

// Prints like the C function. In a module of a node it writes to a ring in shared memory that the node empties: no
// lock, no allocation, no system call, any thread. Outside a node it writes to stdout. Shared variables can be passed
// directly: irp::printf("%u %s\n", tick, station.name). The format's conversions are those of C (not %n); the type
// comes from the argument itself, so `%d` also prints a double or a 64-bit number, and a missing argument shows as its
// conversion. A message is cut at 487 bytes and then ends with "[cut]". Returns the length printed; -1 if the ring was
// full: the message is dropped and counted. Real-time safe in a node.
template <class... Argument>
int printf(const char* format, const Argument&... arguments) noexcept {
  return detail::print(format, indurop::detail::value_of(arguments)...);
}

// Enrols this process as a module of its node: the one named by INDUROP_NODE (which the node sets for its modules),
// else "local". Takes the module's priority, core and locked memory as far as the system permits, and binds the shared
// variables. Call it once, early in main(); releases begin with the first waitPeriod(). Not real-time safe.
// Returns 0, else a negative indurop::Errc after a message on stderr saying what to do:
//   NotFound      no such node runs, or it has no such module; waitPeriod() goes on trying
//   TypeMismatch  a variable this program uses has another layout in the node; waitPeriod() exits with code 8
//   VersionMismatch  the node is of another version; exits with code 8
//   Busy          another living process is enrolled for this module; waitPeriod() exits with code 1
//   PermissionDenied, Corrupt, InvalidArgument, System: the same
int initPeriodExe();  // NOLINT(readability-identifier-naming): the chapter's name (Figure 8)

// Ends the current run and sleeps until the node releases the next one. Returns true to run now, false if the node asks
// this process to end; if it then waits again all the same (`while (1)`), this function ends it by exit(). A process
// outlives its node: it keeps waiting and enrols again with the next node of that name. Real-time safe except for the
// sleep; one thread only.
bool waitPeriod();  // NOLINT(readability-identifier-naming): likewise

// Binds this process's shared variables to `node` now; "" = INDUROP_NODE, else "local". Done automatically when the
// program is loaded, if the node is already running or INDUROP_NODE names it, and by initPeriodExe(). A program that
// does neither calls this function, and again after a new deployment. No other thread may use shared variables
// meanwhile. Also starts serving the functions this program implements. Not real-time safe. Returns 0 or a negative
// indurop::Errc: NotFound, PermissionDenied, VersionMismatch, TypeMismatch (some variables were not bound; a message on
// stderr names them).
int attach(const char* node = "");

// Returns the value of <property><value name="...">: of the calling module, or `fallback` if there is none or it does
// not fit the type (then one message is printed). Integers may be written 0x..., bool as true/false/1/0/on/off/yes/no.
// Not real-time safe: read properties in start().
template <class T>
requires std::is_arithmetic_v<T> T property(const char* name, T fallback) {
  if constexpr (std::same_as<T, bool>) {
    detail::property_bool(name, fallback);
  } else if constexpr (std::floating_point<T>) {
    auto value = static_cast<double>(fallback);
    fallback = detail::property_real(name, value) ? static_cast<T>(value) : fallback;
  } else if constexpr (std::signed_integral<T>) {
    auto value = static_cast<std::int64_t>(fallback);  // NOLINT(bugprone-signed-char-misuse): a number
    detail::property_signed(name, std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), value);
    fallback = static_cast<T>(value);
  } else {
    std::uint64_t value = fallback;
    detail::property_unsigned(name, std::numeric_limits<T>::max(), value);
    fallback = static_cast<T>(value);
  }
  return fallback;
}
template <class T = std::string>
requires(!std::is_arithmetic_v<T> && std::constructible_from<T, const char*>) T
    property(const char* name, const char* fallback) {
  const char* text = detail::property_text(name);
  return T(text != nullptr ? text : fallback);
}
template <class T>
requires(!std::is_arithmetic_v<T> && std::constructible_from<T, const char*>) T
    property(const char* name, const T& fallback) {
  const char* text = detail::property_text(name);
  return text != nullptr ? T(text) : fallback;
}

// Nominal period of the calling module; 0 if it is not periodic or runs outside a node. Real-time safe.
std::chrono::nanoseconds period() noexcept;
// Number of the basic period that released the current run, from 0; and the point on the time grid it belongs to, in ns
// of CLOCK_MONOTONIC: the same for all modules released together, however late each one actually started. Outside a run
// (start(), threads of a module's own, non-real-time modules), those of the present period. Real-time safe.
std::uint64_t tick() noexcept;
std::int64_t release_ns() noexcept;
// Moves all later ticks of the node by this time, so that the schedule follows a clock of devices (EtherCAT): at most
// by a hundredth of the basic period with each call, or nothing if the caller is no thread module of a node. All
// modules of the node move along, statistics count from the moved ticks, and the node leaves the grid that boards of a
// plant share. One module of a node may do so. Real-time safe.
void shift_ticks(std::chrono::nanoseconds by) noexcept;
// What `indurop status` shows of devices with a clock of their own: how long after the frames of a tick they have their
// pulse, as they say themselves, and how long after them it shall be. Does nothing if the caller is no thread module of
// a node. Real-time safe.
void report_pulse(std::chrono::nanoseconds after, std::chrono::nanoseconds wanted) noexcept;
// The current time of the node in ns: CLOCK_MONOTONIC; in a simulation its virtual time. Real-time safe.
std::int64_t now_ns() noexcept;

// Records a value that a run gets from elsewhere than shared variables, calls and now_ns(), for example from a thread
// of its module: returns it, and in a replay the value that the run got when it was recorded, so that it does the same
// again. Works in and outside a node. Real-time safe. Counts as an answer to a call: a run has up to 1024 of them
// (docs/recording.md).
std::int64_t learned(std::int64_t what) noexcept;

// Returns true once the node asks this module to end: for the loops of non-real-time modules,
// `while (!irp::stop_requested()) { ... }`. Outside a node always false. Cheap, but not real-time safe.
bool stop_requested() noexcept;

}  // namespace irp

namespace indurop {
using irp::attach;
using irp::property;
}  // namespace indurop
