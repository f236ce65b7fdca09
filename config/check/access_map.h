// SPDX-License-Identifier: Apache-2.0
// Who reads and writes what: the access records of the module files plus <access> of the configuration.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "config/check/check_parts.h"

namespace indurop::config {

struct VariableAccess {
  const schema::Variable* variable = nullptr;  // in CheckResult::schema
  std::vector<std::size_t> readers;            // modules in execution order
  std::vector<std::size_t> writers;
};

struct AccessMap {
  std::map<std::string, VariableAccess> variables;  // those somebody reads or writes
  std::vector<std::size_t> unknown_readers;         // modules that read by names known only at run time
  std::vector<std::size_t> unknown_writers;
};

// Reports names in <access> and <failsafe> that do not exist, and modules whose accesses cannot be known.
AccessMap make_access_map(CheckContext& context);

// Periodic modules by execution order, then sporadic, then non-real ones: indices into Config::modules.
std::vector<std::size_t> execution_order(const CheckResult& result);

}  // namespace indurop::config
