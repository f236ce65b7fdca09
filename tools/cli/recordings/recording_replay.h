// SPDX-License-Identifier: Apache-2.0
// Replays the runs of a recording with indurop-node, and makes a picture of the differences.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/run_options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct ReplayOptions {
  std::filesystem::path file;
  std::filesystem::path config;  // empty: the configuration in the recording
  std::string node;
  std::string board;              // board to replay, if the recording has several
  std::vector<std::string> with;  // module files that replace those of the configuration
  std::filesystem::path output;   // output of the replayed modules; empty: not kept
  std::string svg;                // empty: no picture
  std::uint64_t from = 0;         // ticks to compare
  std::uint64_t to = config::Replay::kLastTick;
  std::uint64_t at = config::Replay::kLastTick;       // this one only, if it is another value
  std::uint64_t stop_at = config::Replay::kLastTick;  // stop before the runs of this tick
  bool comes_back = false;  // return afterwards; else this program becomes the node, if nothing is to be done
                            // after it
};

// Returns the exit code.
int replay_recording(Context& context, const ReplayOptions& options);

}  // namespace indurop::tools
