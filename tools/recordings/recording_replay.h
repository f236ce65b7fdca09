// SPDX-License-Identifier: Apache-2.0
// A recording's runs once more by indurop-node, and a picture of what differs.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command/verb.h"

namespace indurop::tools {

struct ReplayWish {
  std::filesystem::path file;
  std::filesystem::path config;  // empty: that of the recording
  std::string node;
  std::string board;              // of a recording of several
  std::vector<std::string> with;  // module files that take the place of those of the configuration
  std::filesystem::path output;   // what the modules leave now; empty: not kept
  std::string svg;                // empty: no picture
  bool comes_back = false;        // else this program becomes the node, where nothing is to be done behind it
};

// Returns the exit code.
int replay_recording(Context& context, const ReplayWish& wish);

}  // namespace indurop::tools
