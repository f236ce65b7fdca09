// SPDX-License-Identifier: Apache-2.0
// A file of lines that several processes append to. When it has grown too large it is put aside as FILE.1, in place of
// the one that was put aside before.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/replace_file.h"

namespace indurop::base {

struct LineJournal {
  std::filesystem::path file;
  std::uintmax_t most_bytes = 0;  // beyond that it is put aside
  mode_t mode = 0;                // of a new file, less the umask
  Durable durable = Durable::No;
};

// Appends `line`, which ends without '\n', whole; makes the folder. Returns why that failed, else nothing.
std::string append_line(const LineJournal& journal, std::string line);
// Calls `use` for each line, oldest first, those of FILE.1 too. For none if there is no such file.
void each_line(const std::filesystem::path& file, const std::function<void(std::string_view)>& use);

}  // namespace indurop::base
