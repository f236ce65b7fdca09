// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/options.h"

#include "core/base/duration.h"
#include "deploy/link/link_keys.h"
#include "network/dds/network_options.h"

namespace indurop::pool_door {

void declare_options(base::Options& app, DoorOptions& options) {
  constexpr double kLeastHz = 0.001;
  constexpr double kMostHz = 1000;
  app.add("--node", "NAME", options.node, "Node to use (default: $INDUROP_NODE, \"local\", or the only one there is)")
      .completes(base::Completion::Node);
  app.add("--send", "POOL", options.send, "Publish this pool of the node while other boards or tools read it")
      .one_at_a_time();
  app.add("--receive", "POOL", options.receive, "Fill this pool of the node with the chunks that other boards publish")
      .one_at_a_time();
  app.add("--hz", "RATE", options.hz, "Send at most this many chunks of each pool per second (default: all)")
      .range(kLeastHz, kMostHz);
  dds::add_network_options(app, options.network, "the pools");
  app.add("--peer", "ADDRESS", options.network.peers, "Address of another board, for networks without multicast")
      .one_at_a_time();
  deploy::add_keys_option(app, options.network.security, keys::Role::Viewer,
                          "Keys of a tool or board (default: those of the node's board, if its plant has keys)",
                          &options.keys);
  const auto take = [&options](const std::string& text) {
    const base::DurationText read = base::read_duration(text, true, base::PlainNumber::Seconds);
    options.report_ns = read.value ? read.value->count() : options.report_ns;
    return read.problem;
  };
  app.add("--report", "TIME", base::Take(take),
          "Print what was sent, received and dropped this often (default: at the end)");
  const auto form = [&options](const std::string& text) {
    options.json = text == "json";
    return std::string();
  };
  app.add("-o,--output", "FORM", base::Take(form), "Form of these reports: table|json").choices({"table", "json"});
  app.flag("-q,--quiet", options.quiet, "Print warnings, errors and reports only");
}

}  // namespace indurop::pool_door
