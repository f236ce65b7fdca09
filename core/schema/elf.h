// SPDX-License-Identifier: Apache-2.0
// Reads a module file without loading it: its shared variables, which of them its code reads and writes (access map),
// ABI, machine, needed and defined symbols. 64-bit little-endian ELF, read with pread.

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
  std::string schema_json;                 // contents of .indurop.schema, one text per line, empty if none
  std::map<std::uint64_t, Access> access;  // by fnv1a64 of the variable's full name
  std::uint32_t abi = 0;                   // ABI of its headers; kMixedAbi: several; 0: no InduRoP headers
  std::uint16_t machine = 0;               // e_machine (EM_X86_64 = 62, EM_AARCH64 = 183)
  bool shared_object = false;              // dlopen can load it: dynamic, no interpreter, no static PIE
  std::vector<std::string> exports;        // functions it defines for other files, sorted
  std::vector<std::string> imports;        // symbols other files must define, without weak ones, sorted
  std::vector<std::string> needed;         // libraries it requires (DT_NEEDED), in its order
  // Variables that its own code may change, sorted, as far as it has symbols of them; see own_variable().
  std::vector<std::string> variables;
};
inline constexpr std::uint32_t kMixedAbi = 0xFFFFFFFF;

// The ABI version comes from section .indurop.abi (u32 each), else from the schema text. Memory use is proportional to
// the sections read, whatever sizes the file claims; the limit is 256 MiB for one section and 64 MiB for all InduRoP
// sections together. Errors: NotFound, PermissionDenied, Corrupt (not a regular file, not ELF, truncated, sections out
// of bounds), Unsupported (32-bit, big-endian, compressed InduRoP sections), System.
Result<ModuleFile> read_module_file(const std::filesystem::path& file);

}  // namespace indurop::schema
