// SPDX-License-Identifier: Apache-2.0
// A version of a module that may replace the running one: checked against the configuration and the store, and loaded.
// Not real-time safe.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/model/config.h"
#include "core/schema/elf.h"
#include "node/exchange/carry.h"
#include "node/exchange/variable_change.h"
#include "node/modules/module_library.h"
#include "store/vars/store.h"

namespace indurop::node {

// Which of the shared variables that the node started with a module may read and write: those that it used then, since
// order, tape and messages between boards were made for them. Those that appeared since may be used by all.
using AllowedAccess = std::map<std::uint64_t, schema::Access>;

struct CandidateTask {
  const config::Config& config;
  std::uint32_t module = 0;
  std::filesystem::path file;
  vars::Store& store;
  const AllowedAccess& allowed;
  const ModuleLibrary& running;  // empty: there is none, it is a module that is added
  std::uint32_t index = module;  // in the run block
  bool may_grow = false;         // it may bring variables that the store does not have
  // Of all modules, if it may also change types of variables that no other one uses; empty: it may not.
  std::span<const ModuleLibrary> others = {};
  std::span<const ConfiguredUses> configured = {};  // of the same
  std::string keep_for = {};  // node in whose state the files of both versions are kept; empty: they are not
  bool try_first = false;     // see try_module()
  pid_t process = -1;         // that runs now, of a process module
  bool ends_first = false;    // the one that runs ends before it starts
};

struct Candidate {
  FileMark mark;          // of the file, before it was read
  std::string digest;     // of it
  ModuleLibrary library;  // empty: it is a process
  Carry carry;
  AllowedAccess access;             // what it reads and writes
  VariableChange variables;         // that it brings; the store has places for them
  std::vector<std::string> errors;  // all that are found; empty: it may run
  bool needs_restart = false;       // a node that is started with it has none of them
  std::vector<std::string> notes;   // why files of versions are not kept
};

ModuleLibrary::Uses uses_of(const config::ModuleFacts& facts);

// Checks and loads it, next to the running version. Static constructors of the file run. A process is only checked.
Candidate make_candidate(const CandidateTask& task);

}  // namespace indurop::node
