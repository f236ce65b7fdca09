// SPDX-License-Identifier: Apache-2.0
// Tells whether a path leads to the same file, with the same content, as before. Not real-time safe.

#pragma once

#include <cstdint>
#include <filesystem>

namespace indurop::node {

struct FileMark {
  std::uint64_t device = 0;
  std::uint64_t number = 0;
  std::int64_t size = 0;
  std::int64_t changed_ns = 0;
  friend bool operator==(const FileMark&, const FileMark&) = default;
};

// All 0: there is no such file.
FileMark mark_of(const std::filesystem::path& file);

// Returns whether a process executes this file. True for scripts, which others execute, and while it is not known.
bool executes(int pid, const std::filesystem::path& file, const FileMark& mark);

}  // namespace indurop::node
