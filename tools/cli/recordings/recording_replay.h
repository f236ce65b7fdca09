// SPDX-License-Identifier: Apache-2.0
// Replays the runs of a recording with indurop-node, and makes a picture of the differences.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct ReplayWish {
  std::filesystem::path file;
  std::filesystem::path config;  // empty: the configuration in the recording
  std::string node;
  std::string board;              // board to replay, if the recording has several
  std::vector<std::string> with;  // module files that replace those of the configuration
  std::filesystem::path output;   // output of the replayed modules; empty: not kept
  std::string svg;                // empty: no picture
  bool comes_back = false;        // return afterwards; else this program becomes the node, if nothing is to be done
                                  // after it
};

// Returns the exit code.
int replay_recording(Context& context, const ReplayWish& wish);

}  // namespace indurop::tools
