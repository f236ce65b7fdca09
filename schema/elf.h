// SPDX-License-Identifier: Apache-2.0
// What a module file says about itself without being loaded: its shared variables, which of them its code reads
// and writes (access map), ABI, machine, needed and defined symbols. 64-bit little-endian ELF, read with pread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace indurop::schema {

struct Access {
  bool reads = false;
  bool writes = false;
};

struct ModuleFile {
  std::string schema_json;                  // concatenated contents of .indurop.schema, empty if none
  std::map<std::uint64_t, Access> access;   // by fnv1a64 of the variable's full name
  std::uint32_t abi = 0;                    // 0: includes none of our headers
  std::uint16_t machine = 0;                // e_machine (EM_X86_64 = 62, EM_AARCH64 = 183)
  bool shared_object = false;               // has dynamic section and no interpreter
  std::vector<std::string> exports;         // defined dynamic symbols (functions)
};

// Errors: NotFound, PermissionDenied, Corrupt (not ELF, truncated, sections out of bounds), Unsupported (32-bit...).
Result<ModuleFile> read_module_file(const std::filesystem::path& file);

}  // namespace indurop::schema
