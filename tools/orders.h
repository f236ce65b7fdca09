// SPDX-License-Identifier: Apache-2.0
// What stop, start and restart have in common: modules of a node of this machine, and modules and nodes of boards
// anywhere in the network.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mirror/deploy_link.h"
#include "scheduler/module_order.h"
#include "tools/verb.h"

namespace indurop::tools {

struct OrderOptions {
  std::vector<std::string> targets;  // MODULE, MODULE@BOARD, @BOARD
  std::int64_t timeout_ns = 10'000'000'000;
  mirror::LinkSettings link;
  std::filesystem::path keys;
};

struct OrderTarget {
  std::string module;  // empty: the node
  std::string board;   // empty: on this machine
};

void add_order_options(CLI::App& app, Context& context, OrderOptions& options);

// In the order given; the first that fails ends it. Returns the exit code.
int carry_out(Context& context, scheduler::ModuleOrder order, OrderOptions& options);

// The two ways (orders_here.cpp, orders_afar.cpp).
int order_here(Context& context, scheduler::ModuleOrder order, const std::string& module, std::int64_t timeout_ns);
int order_afar(Context& context, scheduler::ModuleOrder order, const std::vector<OrderTarget>& targets,
               OrderOptions& options);

const char* past_of(scheduler::ModuleOrder order);  // "stopped"

}  // namespace indurop::tools
