// SPDX-License-Identifier: Apache-2.0
// A .plclib file: the sources of a library of PLC programs with its name and version.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/dialect.h"
#include "core/base/problem.h"

namespace indurop::plc {

struct LibrarySource {
  std::string name;  // "motor.st"
  std::string text;
};

struct LibraryFile {
  std::string name;
  std::string version;  // "1.2.0"
  Dialect dialect = Dialect::Iec;
  std::vector<LibrarySource> sources;
};

[[nodiscard]] std::string to_text(const LibraryFile& library);
// Errors: no such file, or a damaged one.
[[nodiscard]] Result<LibraryFile, base::Problem> read_library(std::string_view text);

// Returns true for "1", "1.2", "1.2.0".
[[nodiscard]] bool is_version(std::string_view text) noexcept;
// Returns whether `version` satisfies the request for `wanted`: the same first number, and not older. Requires two
// valid versions.
[[nodiscard]] bool does_for(std::string_view version, std::string_view wanted);

// "motors.plclib@1.2": the file and the requested version, "" if none is given.
struct LibraryChoice {
  std::string file;
  std::string version;
};
[[nodiscard]] LibraryChoice library_choice(const std::string& text);

}  // namespace indurop::plc
