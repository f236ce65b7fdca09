// SPDX-License-Identifier: Apache-2.0
// A thread module's .so in this process: loads it and finds its functions, given by INDUROP_MODULE or as plain
// functions start, run, stop, condition with C or C++ linkage (chapter, Figures 7 and 13). Not real-time safe.

#pragma once

#include <indurop/module.h>
#include <indurop/result.h>

#include <filesystem>

#include "base/problem.h"

namespace indurop::node {

class ModuleLibrary {
 public:
  ModuleLibrary() = default;
  // `own_copy`: loads a private copy, for a second module from the same file. Runs the module's static constructors.
  Result<void, base::Problem> load(const std::filesystem::path& file, bool own_copy);
  ModuleLibrary(ModuleLibrary&& other) noexcept;
  ModuleLibrary& operator=(ModuleLibrary&& other) noexcept;
  ModuleLibrary(const ModuleLibrary&) = delete;
  ModuleLibrary& operator=(const ModuleLibrary&) = delete;
  ~ModuleLibrary();

  [[nodiscard]] const ModuleDescriptor& functions() const noexcept { return functions_; }

 private:
  void find_functions();
  void* handle_ = nullptr;
  int copy_ = -1;  // stays open: the dynamic linker would take a second file of the same number for this one
  ModuleDescriptor functions_;
};

}  // namespace indurop::node
