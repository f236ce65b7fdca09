// SPDX-License-Identifier: Apache-2.0
// The command line of a node: one table of options for indurop-node and indurop run.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/model/config.h"
#include "core/base/options.h"

namespace indurop::config {

// Options of a run in virtual time.
struct Simulation {
  bool on = false;
  bool step = false;             // pauses after each tick until standard input continues it
  double speed = 0;              // times real time; 0: as fast as the machine allows
  std::string times;             // report of a run with execution times of modules; empty: only <wcet> is used
  CheckOptions::Times measured;  // the times in that report
  std::string network;           // of a plant: overrides the manifest's network, as read_network() accepts it
  std::filesystem::path script;  // of a plant: script of events on its boards; empty: none
  std::optional<int> conductor;  // of a board: the open socket to the process that simulates the plant
};

inline constexpr std::uint64_t kTapeMegabytes = 20;

// Options of a replay: the node repeats the runs of a recording instead of running on its own.
struct Replay {
  std::filesystem::path file;     // empty: none
  std::string board;              // board to replay, if the file joins several recordings; else empty
  std::vector<std::string> with;  // module files that replace those of the configuration; "MODULE=FILE" or FILE
  std::filesystem::path report;   // only the module of `with` is repeated, with its own values, and this is written
  std::filesystem::path output;   // recording of the values that modules write in the replay; empty: none
  std::filesystem::path kept;     // what modules keep after the last tick is written to this file; empty: none
  std::uint64_t from_tick = 0;    // the runs of these ticks are compared
  std::uint64_t to_tick = kLastTick;
  std::uint64_t stop_tick = kLastTick;  // the process stops before the runs of this tick, for a debugger
  static constexpr std::uint64_t kLastTick = UINT64_MAX;
};

struct RunOptions {
  std::filesystem::path config;
  std::string node;                     // empty: the name of the board, else "local"
  std::string board;                    // board of the plant in `config`; empty: `config` is a module.xml
  std::string deployment;               // id of the deployment that the agent runs; empty: started by hand
  bool one_host = false;                // all boards of the plant run on this host
  std::optional<base::Nanos> duration;  // empty: until stopped
  std::filesystem::path report;         // empty: none
  bool require_rt = false;
  bool adjust = false;
  bool quiet = false;    // no summary; of the node's messages only warnings and errors
  bool journal = false;  // messages go to systemd's journal
  std::optional<int> core;
  std::optional<SpinSetting> spin;
  std::uint64_t tape_megabytes = kTapeMegabytes;
  std::filesystem::path record;  // empty: no recording
  Simulation simulation;
  Replay replay;
};

// Declares all options except --quiet, which verbs have anyway; `options` must outlive the parsing.
void declare_run_options(base::Options& line, RunOptions& options);

// Returns the command line arguments that express `options`.
std::vector<std::string> words_of(const RunOptions& options);

}  // namespace indurop::config
