// SPDX-License-Identifier: Apache-2.0
// A thread module's .so in this process: loads it and finds its functions, either from INDUROP_MODULE or as plain
// functions start, run, stop, condition with C or C++ linkage (chapter, Figures 7 and 13). Not real-time safe.

#pragma once

#include <indurop/module.h>
#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "node/modules/file_mark.h"
#include "node/modules/module_memory.h"

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

  // Returns whether the file was replaced or removed since it was loaded: the older version is still running.
  [[nodiscard]] bool is_outdated() const;

  // Its number on the tape (store/tape/versions.h); 0: it has none.
  void set_number(std::uint32_t number) noexcept { number_ = number; }
  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }

  // Returns the bytes of the file that was loaded, also if the file was replaced or removed since. Errors: it was
  // overwritten, or was not kept open, because the process has many files open.
  [[nodiscard]] Result<std::string, base::Problem> content() const;

  // SHA-256 of the file that was loaded.
  [[nodiscard]] const std::string& digest() const noexcept { return digest_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  // An address inside the loaded file.
  [[nodiscard]] const void* inside() const noexcept;
  // Makes its pages present now, those that it may write as copies of its own.
  void prefault() const;
  // Unloads it. Returns false if the dynamic linker keeps it in memory (unique symbols, thread_local objects).
  bool unload();
  // Leaves it loaded for as long as the process lives: a run of it ended in the middle.
  void abandon() noexcept;

  // The shared variables that its code reads or writes, by the hash of their name.
  struct Use {
    std::uint64_t type = 0;  // hash
    bool reads = false;
    bool writes = false;
  };
  using Uses = std::map<std::uint64_t, Use>;
  void set_uses(Uses uses) { uses_ = std::move(uses); }
  [[nodiscard]] const Uses& uses() const noexcept { return uses_; }

  [[nodiscard]] const ModuleDescriptor& functions() const noexcept { return functions_; }
  [[nodiscard]] const ModuleMemory& memory() const noexcept { return memory_; }

 private:
  void find_functions();
  std::filesystem::path file_;
  std::string digest_;
  FileMark mark_;  // of the file that was loaded
  void* handle_ = nullptr;
  // Stays open, for content(). For the copy, the dynamic linker would mistake a second file with its inode number for
  // it.
  int opened_ = -1;
  std::uint32_t number_ = 0;
  ModuleDescriptor functions_;
  ModuleMemory memory_;
  Uses uses_;
};

}  // namespace indurop::node
