// SPDX-License-Identifier: Apache-2.0
// Reads and checks the files of a PLC program.

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/check/program.h"
#include "control/plc/front/compiler.h"
#include "control/plc/model/diagnostics.h"

namespace indurop::plc {

[[nodiscard]] bool is_module_name(std::string_view name) noexcept;
// Returns the given name, else that of the first file; characters that C++ does not allow in a name become '_'.
[[nodiscard]] std::string module_name(const CompileOptions& options);

// Returns the name of the module that runs a task of a program.
[[nodiscard]] std::string module_of(const Program& program, const TaskPlan& task, const std::string& name);

// Returns null after errors, or a program that must not be used. `of_glb`: receives the errors of .glb files.
[[nodiscard]] std::unique_ptr<Program> check_files(const CompileOptions& options, const std::string& name,
                                                   const glb2idl::FileReader& read, Diagnostics& diagnostics,
                                                   std::vector<base::Diagnostic>& of_glb);

}  // namespace indurop::plc
