// SPDX-License-Identifier: Apache-2.0
// An FMU as a file: a ZIP archive from anybody. Its description is read without unpacking it.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "control/io/fmu/description.h"

namespace indurop::io::fmu {

struct FmuFile {
  Description description;
  std::vector<std::string> platforms;  // folders in binaries/
  bool has_sources = false;
  std::vector<base::Diagnostic> diagnostics;
  [[nodiscard]] bool ok() const noexcept { return !base::has_error(diagnostics); }
};
// Reports all errors of the description at once. Not real-time safe.
FmuFile read_fmu(const std::filesystem::path& file);

// Where the library for this processor is in the archive: "binaries/linux64/press.so".
std::string library_member(const Description& description);
// Returns why the FMU cannot run on this machine; empty: it can.
std::string missing_library(const FmuFile& file);

// Unpacks an FMU to an empty folder. Nothing is written outside of it: members with other names are errors, links and
// devices, too. Not real-time safe. Errors: what is wrong.
Result<void, std::string> unpack_fmu(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace indurop::io::fmu
