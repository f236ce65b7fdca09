// SPDX-License-Identifier: Apache-2.0
// A version of a module that may replace the running one: checked against the configuration and the store, and loaded.
// Not real-time safe.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "core/schema/elf.h"
#include "node/exchange/carry.h"
#include "node/modules/module_library.h"
#include "store/vars/store.h"

namespace indurop::node {

// Which shared variables a module may read and write: those that it used when the node started, since order, tape and
// messages between boards were made for them.
using AllowedAccess = std::map<std::uint64_t, schema::Access>;

struct CandidateTask {
  const config::Config& config;
  std::uint32_t module = 0;
  std::filesystem::path file;
  const vars::Store& store;
  const AllowedAccess& allowed;
  const ModuleLibrary& running;  // empty: there is none, it is a module that is added
  std::uint32_t index = module;  // in the run block
};

struct Candidate {
  ModuleLibrary library;
  Carry carry;
  std::vector<std::string> errors;  // all that are found; empty: it may run
  bool needs_restart = false;       // a node that is started with it has none of them
};

// Checks and loads it, next to the running version. Static constructors of the file run.
Candidate make_candidate(const CandidateTask& task);

}  // namespace indurop::node
