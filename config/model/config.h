// SPDX-License-Identifier: Apache-2.0
// module.xml as data (chapter, Figures 1 and 9); every value has its place in the file.

#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/base/duration.h"
#include "scheduler/core_order.h"
#include "scheduler/module_kind.h"

namespace indurop::config {

using base::Nanos;

struct Property {
  std::string name;
  std::string value;
  base::SourcePlace place{};  // of the <value>
  bool operator==(const Property&) const = default;
};

// The restart rule of a process module that died: at most `max` restarts within `window`, then escalation.
struct Restart {
  base::Nanos delay{std::chrono::milliseconds(100)};
  std::uint32_t max = 3;
  base::Nanos window{std::chrono::seconds(60)};
  enum class Escalate { StopModule, StopNode } escalate = Escalate::StopModule;
  bool operator==(const Restart&) const = default;
};

// A value written to a variable when the module faults: <failsafe variable="PLC_ROBOT::O0">0</failsafe>.
struct FailSafe {
  std::string variable;
  std::string value;
  base::SourcePlace place;
  bool operator==(const FailSafe&) const = default;
};

// Places of the values of a module in the XML file, for diagnostics; line 0: not given.
struct ModulePlaces {
  base::SourcePlace name;
  base::SourcePlace file;
  base::SourcePlace period;
  base::SourcePlace offset;
  base::SourcePlace deadline;
  base::SourcePlace wcet;
  base::SourcePlace priority;
  base::SourcePlace core;
  base::SourcePlace standby;
  base::SourcePlace signal;
  std::vector<base::SourcePlace> after;   // parallel to Module::after
  std::vector<base::SourcePlace> reads;   // parallel to Module::reads
  std::vector<base::SourcePlace> writes;  // parallel to Module::writes
  bool operator==(const ModulePlaces&) const = default;
};

struct Module {
  std::string name;            // <name>, else the file name without directory and extension; unique
  std::filesystem::path file;  // absolute; relative names start at the XML file's folder
  std::string file_as_written;
  scheduler::ModuleType type = scheduler::ModuleType::Thread;
  scheduler::Operation operation = scheduler::Operation::Periodic;
  base::Nanos period{};  // non-real-time thread: 0 runs it once
  base::Nanos offset{};
  base::Nanos deadline{};  // 0: none given (sporadic: required; periodic: the period)
  base::Nanos wcet{};      // longest execution without preemption; 0: not known
  base::Nanos budget{};    // 0: default (10 periods, at least 5 ms); kNoBudget: no budget
  int priority = 0;
  int core = -1;            // -1: the core of the node
  std::string standby;      // of a plant: board that also runs it and takes over; empty: none
  bool is_standby = false;  // this is the module on the standby board
  scheduler::OverrunPolicy overrun = scheduler::OverrunPolicy::Skip;
  bool after_base = false;  // sporadic: <position>after-base</position>
  int signal = 0;           // legacy process: POSIX signal sent at each release, 0: none
  std::vector<std::string> arguments;
  std::vector<std::string> after;  // modules that run before this one in a basic period, on any core
  std::vector<std::string> reads;  // <access> by name (channel): variables read / written
  std::vector<std::string> writes;
  Restart restart;
  std::vector<FailSafe> failsafe;
  std::vector<Property> properties;
  base::SourcePlace place;  // of the <module>
  ModulePlaces places;
  bool operator==(const Module&) const = default;
};
inline constexpr base::Nanos kNoBudget{-1};

struct SpinSetting {
  enum class Mode { Auto, Off, Fixed } mode = Mode::Auto;
  base::Nanos fixed{};
  bool operator==(const SpinSetting&) const = default;
};

// <cores>: modules without a <core> are distributed over several cores.
struct CoresSetting {
  int most = 0;                 // number of cores; 0: all that this process may use
  bool split_sharing = false;   // also distribute modules that share data; they then wait for each other
  std::filesystem::path times;  // report with execution times of modules without <wcet>; empty: none
  base::SourcePlace place;
  bool operator==(const CoresSetting&) const = default;
};
inline constexpr int kMaxSpreadCores = 64;

// The settings of <variable> for one variable in addition to its .glb declaration.
struct VariableRule {
  // The rights of third-party tools to the variable: read its topic, also write it, or not see it.
  enum class External { Read, Write, Off };
  std::string name;          // full name
  std::string owner;         // of a plant: board that owns the variable; empty: inferred from the access map
  base::Nanos every{};       // minimum time between two transmissions; 0: sent with every change
  bool best_effort = false;  // a lost value is not sent again, because the next one comes soon
  External external = External::Read;
  base::SourcePlace place;
  base::SourcePlace owner_place;
  bool operator==(const VariableRule&) const = default;
};

// Libraries of indurop_add_glb(... TYPES), absolute paths; the other two vectors are parallel.
struct TypeFiles {
  std::vector<std::filesystem::path> types;
  std::vector<std::string> types_as_written;
  std::vector<base::SourcePlace> type_places;
  bool operator==(const TypeFiles&) const = default;
};

// The settings of <root> of a module.xml for third-party tools; in a plant the manifest has them for all boards.
struct ExternalPlane : TypeFiles {
  std::optional<int> domain;   // DDS domain of typed topics; empty: none
  bool ros2 = false;           // topics have the names and types of ROS 2
  std::string interface_name;  // network interface; empty: the only one
  std::vector<VariableRule> variables;
  bool operator==(const ExternalPlane&) const = default;
};

struct Config {
  std::filesystem::path file;
  std::vector<Module> modules;                // in file order
  std::optional<base::Nanos> minimum_period;  // <minimum_period>; default kDefaultMinimumPeriod
  std::optional<SpinSetting> spin;
  int core = -1;  // -1: the last core this process may use
  std::optional<CoresSetting> cores;
  scheduler::CoreOrder order = scheduler::CoreOrder::Data;  // <order>
  base::SourcePlace core_place;
  base::SourcePlace spin_place;
  ExternalPlane external;  // of a module.xml
  bool operator==(const Config&) const = default;
};
inline constexpr base::Nanos kDefaultMinimumPeriod{std::chrono::microseconds(50)};

}  // namespace indurop::config
