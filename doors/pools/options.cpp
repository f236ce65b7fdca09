// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/options.h"

#include "core/base/duration.h"
#include "deploy/link/link_keys.h"
#include "network/dds/network_options.h"
#include "store/vars/shm_file.h"

namespace indurop::pool_door {

SentPool read_sent_pool(const std::string& text, std::string& problem) {
  SentPool sent;
  sent.name = text.substr(0, text.find('@'));
  problem.clear();
  if (sent.name.size() < text.size()) {
    const base::DurationText every = base::read_duration(text.substr(sent.name.size() + 1), false);
    sent.every_ns = every.value.value_or(base::Nanos::zero()).count();
    problem = every.problem;
  }
  return sent;
}

void declare_options(base::Options& app, DoorOptions& options) {
  constexpr double kLeastHz = 0.001;
  constexpr double kMostHz = 1000;
  app.add("--node", "NAME", options.node, "Node to use (default: $INDUROP_NODE, \"local\", or the only one there is)")
      .completes(base::Completion::Node);
  app.add("--send", "POOL[@TIME]", options.send,
          "Publish this pool of the node while other boards or tools read it, at most one chunk each TIME (or at a "
          "rate: camera@10Hz)")
      .one_at_a_time()
      .check([](const std::string& text) {
        std::string problem;
        (void)read_sent_pool(text, problem);
        return problem;
      });
  app.add("--receive", "POOL", options.receive, "Fill this pool of the node with the chunks that other boards publish")
      .one_at_a_time();
  app.add("--hz", "RATE", options.hz,
          "Send at most this many chunks per second of each pool without a TIME (default: all)")
      .range(kLeastHz, kMostHz);
  app.add("--plant", "NAME", options.plant,
          "Receive from programs with the same --plant only (plants with keys receive from boards with their keys "
          "only)")
      .check([](const std::string& text) {
        return vars::valid_node_name(text) ? "" : "'" + text + "' is not a name of a plant: 1 to 40 of A-Z a-z 0-9 _ -";
      });
  dds::add_network_options(app, options.network, "the pools");
  app.add("--peer", "ADDRESS", options.network.peers, "Address of another board, for networks without multicast")
      .one_at_a_time();
  app.add("--address", "ADDRESS", options.network.address, "Own address: selects the network interface that has it");
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
