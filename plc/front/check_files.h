// SPDX-License-Identifier: Apache-2.0
// From the files of a PLC program to its checked meaning.

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plc/check/program.h"
#include "plc/front/compiler.h"
#include "plc/model/diagnostics.h"

namespace indurop::plc {

[[nodiscard]] bool is_module_name(std::string_view name) noexcept;
// The one given, else that of the first file; what C++ cannot have in a name is '_'.
[[nodiscard]] std::string module_name(const CompileOptions& options);

// After errors null, or a program that is of no use. `of_glb`: the errors of .glb files.
[[nodiscard]] std::unique_ptr<Program> check_files(const CompileOptions& options, const std::string& name,
                                                   const glb2idl::FileReader& read, Diagnostics& diagnostics,
                                                   std::vector<base::Diagnostic>& of_glb);

}  // namespace indurop::plc
