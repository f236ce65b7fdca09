// SPDX-License-Identifier: Apache-2.0
// The access map: which modules read and write which variable, from the access records of the module files and from
// <access> of the configuration.

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
  std::map<std::string, VariableAccess> variables;  // only variables that a module reads or writes
  std::vector<std::size_t> unknown_readers;         // modules that read by names known only at run time
  std::vector<std::size_t> unknown_writers;
};

// Reports names in <access> and <failsafe> that do not exist, and modules whose accesses cannot be determined.
AccessMap make_access_map(CheckContext& context);

// Returns indices into Config::modules: periodic modules by execution order, then sporadic, then non-real-time ones.
std::vector<std::size_t> execution_order(const CheckResult& result);

}  // namespace indurop::config
