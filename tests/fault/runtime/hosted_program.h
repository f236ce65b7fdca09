// SPDX-License-Identifier: Apache-2.0
// A process module as its node would start it.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.h"

namespace indurop::testing {

// With the name of its node and its module's index; no index: started by hand.
inline test::Program hosted_program(const std::string& program, const std::string& node, const std::string& module,
                                    std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), program);
  test::Environment environment;
  environment.variables.push_back("INDUROP_NODE=" + node);
  if (!module.empty()) {
    environment.variables.push_back("INDUROP_MODULE=" + module);
  }
  environment.one_output = true;
  return test::Program(arguments, environment);
}

}  // namespace indurop::testing
