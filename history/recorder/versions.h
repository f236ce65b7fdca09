// SPDX-License-Identifier: Apache-2.0
// The versions of modules' code in a recording: metadata records "indurop.version", each of which says which file a
// module's runs are of, from one run on.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "history/recording/mcap_reader.h"

namespace indurop::recorder {

inline constexpr const char* kVersionMetadata = "indurop.version";

struct RecordedVersion {
  std::string module;
  std::uint32_t number = 0;      // each load of a file has its own; a version that runs again keeps its number
  std::uint64_t first_run = 0;   // number of the first run in the recording that is one of it
  std::uint64_t first_tick = 0;  // tick of that run
  bool exchanged = true;         // it came by an exchange; else the node started with it
  std::string digest;            // SHA-256 of its file; empty: not known
  std::string file;              // path with which it was loaded; empty: not known
};

recording::TextMap to_text_map(const RecordedVersion& version);

// Returns the versions that a node's part of a recording names, by module and first run. `prefix`: of its topics. A
// version that follows itself, as in parts that were joined, is there once. Damaged records are ignored; older
// recordings have none.
std::vector<RecordedVersion> versions_in(const recording::McapReader& reader, const std::string& prefix);

}  // namespace indurop::recorder
