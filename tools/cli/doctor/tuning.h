// SPDX-License-Identifier: Apache-2.0
// Kernel settings for a host of real-time programs, at run time and on the kernel command line. Finds settings that
// differ, applies them, and restores the previous ones.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace indurop::tools {

struct Setting {
  std::string file;    // "/proc/sys/vm/stat_interval"
  std::string now;     // in the kernel's own format
  std::string wanted;  // value to write into the file
  std::string why;
};

struct Tuning {
  std::vector<Setting> settings;   // those that differ from the required value
  std::vector<std::string> boot;   // arguments missing on the kernel's command line
  std::vector<std::string> hints;  // measures left to the user
};

// Examines the settings for a node on `core`. `root` is put before all files (tests use a copy).
Tuning examine_tuning(int core, const std::filesystem::path& root = "/");

// Applies all settings, after writing the previous values to `record`; what an earlier call wrote there is kept.
// Returns the settings that the kernel refused, one line each. Errors: the record cannot be written.
Result<std::vector<std::string>, base::Problem> apply_tuning(const Tuning& tuning, const std::filesystem::path& record,
                                                             const std::filesystem::path& root = "/");

// Restores the values in `record` and removes it. Returns the number of restored settings and those that the kernel
// refused. Errors: there is no record, or the machine was restarted since, so the settings are gone already.
struct Undone {
  std::size_t settings = 0;
  std::vector<std::string> refused;
};
Result<Undone, base::Problem> undo_tuning(const std::filesystem::path& record, const std::filesystem::path& root = "/");

}  // namespace indurop::tools
