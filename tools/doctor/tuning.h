// SPDX-License-Identifier: Apache-2.0
// What a host of real-time programs sets in its kernel: while it runs, and on its command line. Says what is different
// here, sets it, and puts back what was there before.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"

namespace indurop::tools {

struct Setting {
  std::string file;    // "/proc/sys/vm/stat_interval"
  std::string now;     // as the kernel says it
  std::string wanted;  // what to write into it
  std::string why;
};

struct Tuning {
  std::vector<Setting> settings;   // that differ from what is wanted
  std::vector<std::string> boot;   // words that are missing on the kernel's command line
  std::vector<std::string> hints;  // what is left to the user
};

// For a node on `core`. `root` is put before all files (tests use a copy).
Tuning examine_tuning(int core, const std::filesystem::path& root = "/");

// Sets everything, after it wrote into `record` what was there; what an earlier call wrote there is kept. Returns what
// the kernel refused, a line each. Errors: the record cannot be written.
Result<std::vector<std::string>, base::Problem> apply_tuning(const Tuning& tuning, const std::filesystem::path& record,
                                                             const std::filesystem::path& root = "/");

// Puts back what `record` says and removes it. Returns how many settings, and what the kernel refused. Errors: there is
// no record, or the machine was started since: then nothing is left of what was set.
struct Undone {
  std::size_t settings = 0;
  std::vector<std::string> refused;
};
Result<Undone, base::Problem> undo_tuning(const std::filesystem::path& record, const std::filesystem::path& root = "/");

}  // namespace indurop::tools
