// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/check_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tools/cli/plant/chains.h"
#include "tools/client/node/mirror_view.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

using base::Nanos;

std::optional<Nanos> measured_network(std::span<const config::BoardView> boards) {
  std::optional<Nanos> most;
  for (const config::BoardView& board : boards) {
    const auto mirror = board.name.empty() ? std::nullopt : view_mirror(board.name);
    for (const PeerView& peer : mirror ? mirror->peers : std::vector<PeerView>()) {
      if (peer.clock_known && peer.state == "alive") {
        const Nanos one(std::max<std::int64_t>(peer.delay_ns - peer.clock_offset_ns, 0) + peer.clock_bound_ns);
        most = std::max(most.value_or(Nanos{}), one);
      }
    }
  }
  return most;
}

std::string microseconds(Nanos time) {
  return fmt::format("{:.6g} us", static_cast<double>(time.count()) / 1e3);
}

std::string network_words(const NetworkTime& network) {
  return fmt::format("{} for each way through the network, {}", microseconds(network.most),
                     network.given      ? "as --network says"
                     : network.measured ? "as measured by the boards of this host"
                                        : "assumed, because no board of this host has measured it; see --network");
}

NetworkTime network_time(std::span<const config::BoardView> boards, const std::optional<Nanos>& given) {
  if (given) {
    return {*given, true, false};
  }
  const auto measured = measured_network(boards);
  return {measured.value_or(config::kNetworkHop), false, measured.has_value()};
}

std::optional<std::vector<Chain>> find_chains(Context& context, const ChainPlant& plant, const std::string& from,
                                              const std::string& to) {
  const auto begin = plant.variable(from);
  const auto end = plant.variable(to);
  for (const auto* const one : {&begin, &end}) {
    if (!one->ok()) {
      context.out.error(one->error().text);
      return std::nullopt;
    }
  }
  std::vector<Chain> found = plant.chains().find(*begin, *end);
  if (found.empty()) {
    context.out.error(fmt::format("nothing leads from {} to {} through periodic modules", from, to));
    return std::nullopt;
  }
  return found;
}

int check_chain(Context& context, const std::string& file, const config::CheckOptions& options,
                const ChainQuestion& question) {
  const ChainPlant plant(file, options);
  if (!plant.ok()) {
    print_diagnostics(context, plant.diagnostics(), false);
    return kCheckFailed;
  }
  const auto found = find_chains(context, plant, question.from, question.to);
  if (!found) {
    return kFailed;
  }
  const Chains chains = plant.chains();
  const NetworkTime network = network_time(plant.boards(), question.network);
  Table table({{"WAY", "way"},
               {"BEST", "best_ns", Align::Right},
               {"WORST", "worst_ns", Align::Right},
               {"CYCLES", "cycles", Align::Right},
               {"NETWORK", "crossings", Align::Right},
               {"", "exact"}});
  bool crosses = false;
  for (const Chain& chain : *found) {
    const config::ChainAge age = chains.age(chain, network.most);
    const double cycles =
        static_cast<double>(age.most.count()) / static_cast<double>(chains.period(chain.modules.back()).count());
    table.add({Cell(chains.name(chain)),
               {microseconds(age.least), age.least.count()},
               {microseconds(age.most), age.most.count()},
               {fmt::format("{:.3g}", cycles), JsonValue(cycles)},
               {std::to_string(age.crossings), age.crossings},
               {"", age.exact}});
    crosses = crosses || age.crossings > 0;
  }
  print_table(context, table,
              {{"from", question.from},
               {"to", question.to},
               {"network_ns", network.most.count()},
               {"measured", network.measured}},
              "chains");
  if (crosses && context.format == Format::Table) {
    context.out.note(network_words(network));
  }
  return kOk;
}

}  // namespace indurop::tools
