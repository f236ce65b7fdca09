// SPDX-License-Identifier: Apache-2.0
// A file of lines that several processes append to. When it has grown too large it is renamed to FILE.1, which replaces
// the earlier FILE.1.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/replace_file.h"

namespace indurop::base {

struct LineJournal {
  std::filesystem::path file;
  std::uintmax_t max_bytes = 0;  // above this size it is renamed
  mode_t mode = 0;               // of a new file, minus the umask
  Durable durable = Durable::No;
};

// Appends `line`, which contains no line break, as a whole; creates the folder. After a part of a line, which a loss of
// power may leave, it begins a new one. Returns why that failed, else an empty string.
std::string append_line(const LineJournal& journal, std::string line);
// Calls `use` for each line, oldest first, including those of FILE.1; for none if there is no such file.
void each_line(const std::filesystem::path& file, const std::function<void(std::string_view)>& use);

}  // namespace indurop::base
