// SPDX-License-Identifier: Apache-2.0
// What a node is told on its command line: the one table of indurop-node and indurop run.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "config/check/check.h"
#include "config/model/config.h"

namespace indurop::config {

// A run in virtual time.
struct Simulation {
  bool on = false;
  bool step = false;             // stands after each tick until standard input says to go on
  double speed = 0;              // times real time; 0: as fast as the machine allows
  std::string times;             // report of a run that says how long modules take; empty: only what <wcet> says
  CheckOptions::Times measured;  // what it says
  std::string network;           // of a plant, other than its manifest says; as read_network() takes it
  std::filesystem::path script;  // of a plant, what befalls its boards; empty: nothing
  std::optional<int> conductor;  // of a board: the open socket to who simulates the plant
};

inline constexpr std::uint64_t kTapeMegabytes = 20;

// The runs of a recording once more, instead of a run of its own.
struct Replay {
  std::filesystem::path file;     // empty: none
  std::string board;              // whose runs, of a file that was joined; else empty
  std::vector<std::string> with;  // module files that take the place of those of the configuration
  std::filesystem::path output;   // what modules leave now, as a recording; empty: none
};

struct RunOptions {
  std::filesystem::path config;
  std::string node;                     // empty: that of the board, else "local"
  std::string board;                    // of the plant that `config` is; empty: a module.xml
  std::string deployment;               // id of what the agent runs; empty: started by hand
  bool one_host = false;                // all boards of the plant run on this host
  std::optional<base::Nanos> duration;  // empty: until stopped
  std::filesystem::path report;         // empty: none
  bool require_rt = false;
  bool adjust = false;
  bool quiet = false;  // no summary, no messages of the node but warnings and errors
  std::optional<int> core;
  std::optional<SpinSetting> spin;
  std::uint64_t tape_megabytes = kTapeMegabytes;
  std::filesystem::path record;  // empty: no recording
  Simulation simulation;
  Replay replay;
};

// Declares all but --quiet, which verbs have anyway; `options` must outlive the parsing.
void declare_run_options(base::Options& line, RunOptions& options);

// The words that say `options` on a command line.
std::vector<std::string> words_of(const RunOptions& options);

}  // namespace indurop::config
