// SPDX-License-Identifier: Apache-2.0
// The recordings that a history may be read from: what each is about, remembered until the file changes. For one thread
// at a time.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/client/history/history_types.h"

namespace indurop::tools {

// The part of a recording that is about one node.
struct RecordedNode {
  std::filesystem::path file;
  std::string node;
  std::string prefix;                    // topic prefix; empty: the file is of one node
  TimeSpan span;                         // of its messages, as they are dated in the file
  std::int64_t real_minus_node_ns = 0;   // CLOCK_REALTIME minus the node's time, as it was when the recording began
  std::int64_t begun_wall_ns = 0;        // the same in all parts of a recording that was split
  std::int64_t part = 0;                 // number of the file among these parts; 0: it was not split
  std::vector<std::uint64_t> variables;  // digests of names and types, sorted

  // Returns true if it has the variable: its full name, and its type as OMG IDL.
  [[nodiscard]] bool has(std::string_view variable, std::string_view idl) const;
};

class RecordingCatalog {
 public:
  // Returns the recordings of a node: its black boxes, and those in `folder` (may be empty); those that begin first
  // come first. Files that are no recordings of a real node, of any release, are left out, and so are simulations.
  std::vector<RecordedNode> of(const std::string& node, const std::filesystem::path& folder);

 private:
  struct Remembered {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    bool listed = false;  // it is still there
    std::vector<RecordedNode> nodes;
  };
  void look_into(const std::filesystem::path& folder);

  std::map<std::filesystem::path, Remembered> files_;
};

}  // namespace indurop::tools
