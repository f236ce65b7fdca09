// SPDX-License-Identifier: Apache-2.0
// indurop-agent: makes a host a board of a plant.

#include "deploy/agent/agent.h"
#include "deploy/agent/options.h"

int main(int argc, char** argv) {
  const auto options = indurop::deploy::parse_options(argc, argv);
  return options ? indurop::deploy::run_agent(*options, argv) : options.error();
}
