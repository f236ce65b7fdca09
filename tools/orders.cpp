// SPDX-License-Identifier: Apache-2.0
#include "tools/orders.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/board_roster.h"

namespace indurop::tools {

using scheduler::ModuleOrder;

const char* past_of(ModuleOrder order) {
  return order == ModuleOrder::Stop ? "stopped" : order == ModuleOrder::Start ? "started" : "restarted";
}

void add_order_options(CLI::App& app, Context& context, OrderOptions& options) {
  app.add_option("targets", options.targets, "MODULE of the node here; MODULE@BOARD or @BOARD of a plant, anywhere")
      ->type_name("TARGET");
  add_node_option(app, context);
  add_time_option(app, "--timeout", options.timeout_ns, "How long to wait (default 10 s)");
  add_link_options(app, options.link);
  app.add_option("--keys", options.keys, "Folder of the plant's keys, if its boards have some")->type_name("DIR");
}

int carry_out(Context& context, ModuleOrder order, OrderOptions& options) {
  std::vector<OrderTarget> afar;
  std::vector<std::string> here;
  for (const std::string& text : options.targets) {
    const auto at = text.find('@');
    if (at == std::string::npos) {
      here.push_back(text);
    } else if (at + 1 < text.size()) {
      afar.push_back({text.substr(0, at), text.substr(at + 1)});
    } else {
      context.out.error(fmt::format("'{}' names no board; write MODULE@BOARD or @BOARD", text));
      return kUsage;
    }
  }
  for (const std::string& module : here) {
    if (const int code = order_here(context, order, module, options.timeout_ns); code != kOk) {
      return code;
    }
  }
  return afar.empty() ? kOk : order_afar(context, order, afar, options);
}

}  // namespace indurop::tools
