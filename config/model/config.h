// SPDX-License-Identifier: Apache-2.0
// module.xml as data (chapter, Figures 1 and 9), every value with the place it was written at.

#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/duration.h"
#include "scheduler/core_order.h"
#include "scheduler/module_kind.h"

namespace indurop::config {

using base::Nanos;

struct Property {
  std::string name;
  std::string value;
  base::SourcePlace place{};  // of its <value>
};

// How a process module comes back after it died. max restarts within window, then escalation.
struct Restart {
  base::Nanos delay{std::chrono::milliseconds(100)};
  std::uint32_t max = 3;
  base::Nanos window{std::chrono::seconds(60)};
  enum class Escalate { StopModule, StopNode } escalate = Escalate::StopModule;
};

// A value written to a variable when the module faults: <failsafe variable="PLC_ROBOT::O0">0</failsafe>.
struct FailSafe {
  std::string variable;
  std::string value;
  base::SourcePlace place;
};

// Where the values of a module were written, for diagnostics; line 0: not given.
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
};

struct Module {
  std::string name;            // <name>, else the file name without directory and extension; unique
  std::filesystem::path file;  // absolute, relative ones taken from the XML file's directory
  std::string file_as_written;
  scheduler::ModuleType type = scheduler::ModuleType::Thread;
  scheduler::Operation operation = scheduler::Operation::Periodic;
  base::Nanos period{};  // non-real thread: 0 runs it once
  base::Nanos offset{};
  base::Nanos deadline{};  // 0: none given (sporadic: required; periodic: the period)
  base::Nanos wcet{};      // longest execution, not counting what preempts it; 0: not known
  base::Nanos budget{};    // 0: default (10 periods, at least 5 ms); kNoBudget: off
  int priority = 0;
  int core = -1;            // -1: the node's
  std::string standby;      // of a plant: board that runs it too and takes over; empty: none
  bool is_standby = false;  // this is that second one
  scheduler::OverrunPolicy overrun = scheduler::OverrunPolicy::Skip;
  bool after_base = false;  // sporadic: <position>after-base</position>
  int signal = 0;           // legacy process: POSIX signal number each release, 0: none
  std::vector<std::string> arguments;
  std::vector<std::string> after;  // modules whose runs of a basic period this one's comes after, on whatever core
  std::vector<std::string> reads;  // <access> by name (channel): variables read / written
  std::vector<std::string> writes;
  Restart restart;
  std::vector<FailSafe> failsafe;
  std::vector<Property> properties;
  base::SourcePlace place;  // of <module>
  ModulePlaces places;
};
inline constexpr base::Nanos kNoBudget{-1};

struct SpinSetting {
  enum class Mode { Auto, Off, Fixed } mode = Mode::Auto;
  base::Nanos fixed{};
};

// <cores>: modules without a <core> are spread over several.
struct CoresSetting {
  int most = 0;                 // so many; 0: all this process may use
  bool split_sharing = false;   // also modules that share data, which then wait for one another
  std::filesystem::path times;  // report with execution times of modules without <wcet>; empty: none
  base::SourcePlace place;
};
inline constexpr int kMostSpreadCores = 64;

// What <variable> says about one variable beyond its .glb declaration.
struct VariableRule {
  // What tools of others may do with it: read its topic, also write it, or not even see it.
  enum class External { Read, Write, Off };
  std::string name;          // full name
  std::string owner;         // of a plant: board whose value counts; empty: inferred from the access map
  base::Nanos every{};       // sent at most this often; 0: with every change
  bool best_effort = false;  // a lost value is not repeated, the next one comes soon
  External external = External::Read;
  base::SourcePlace place;
  base::SourcePlace owner_place;
};

// Libraries of indurop_add_glb(... TYPES), absolute; the other two are parallel.
struct TypeFiles {
  std::vector<std::filesystem::path> types;
  std::vector<std::string> types_as_written;
  std::vector<base::SourcePlace> type_places;
};

// What <root> of a module.xml says about tools of others; the manifest of a plant says it for all boards.
struct ExternalPlane : TypeFiles {
  std::optional<int> domain;   // DDS domain of typed topics; empty: none
  bool ros2 = false;           // topics have the names and types of ROS 2
  std::string interface_name;  // network interface; empty: the only one
  std::vector<VariableRule> variables;
};

struct Config {
  std::filesystem::path file;
  std::vector<Module> modules;                // in file order
  std::optional<base::Nanos> minimum_period;  // <minimum_period>; default kDefaultMinimumPeriod
  std::optional<SpinSetting> spin;
  int core = -1;  // -1: the last one this process may use
  std::optional<CoresSetting> cores;
  scheduler::CoreOrder order = scheduler::CoreOrder::Data;  // <order>
  base::SourcePlace core_place;
  base::SourcePlace spin_place;
  ExternalPlane external;  // of a module.xml
};
inline constexpr base::Nanos kDefaultMinimumPeriod{std::chrono::microseconds(50)};

}  // namespace indurop::config
