// SPDX-License-Identifier: Apache-2.0
// The black boxes of this host's nodes: recordings that a node kept when a failure occurred. Not real-time safe.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace indurop::recorder {

struct Box {
  std::filesystem::path file;
  std::string node;
  std::string reason;  // why it was kept, or what is wrong with the file; empty: a user requested it
  std::uint64_t bytes = 0;
  std::int64_t end_ns = 0;  // CLOCK_REALTIME of its last data
};

// The folder in which a node keeps them. Their names sort by time.
std::filesystem::path box_folder(const std::string& node);
// Reads the description in a recording of that node.
Box read_box(const std::filesystem::path& file, const std::string& node);
// The boxes of one node, and of all local nodes; the newest first.
std::vector<Box> boxes_of(const std::string& node);
std::vector<Box> boxes_here();

// Sorts files whose names are times, before `next` is added: the oldest first. Files with a later time than `next` were
// written while the clock was ahead, or it is behind now: they are the oldest.
void sort_oldest_first(std::vector<std::filesystem::path>& files, const std::filesystem::path& next);

}  // namespace indurop::recorder
