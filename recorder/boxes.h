// SPDX-License-Identifier: Apache-2.0
// The black boxes of nodes of this host: recordings that a node kept when something went wrong. Not real-time safe.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace indurop::recorder {

struct Box {
  std::filesystem::path file;
  std::string node;
  std::string reason;  // why it was kept, or what is wrong with the file; empty: it was wanted
  std::uint64_t bytes = 0;
  std::int64_t end_ns = 0;  // CLOCK_REALTIME of what it tells last
};

// Where a node keeps them. Their names rise with time.
std::filesystem::path box_folder(const std::string& node);
// What a recording of that node says of itself.
Box read_box(const std::filesystem::path& file, const std::string& node);
// Of a node, and of all; the newest first.
std::vector<Box> boxes_of(const std::string& node);
std::vector<Box> boxes_here();

}  // namespace indurop::recorder
