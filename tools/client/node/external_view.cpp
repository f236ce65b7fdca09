// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/external_view.h"

#include <fmt/format.h>

#include "core/rt/relaxed.h"
#include "network/mirror/external/external_block.h"
#include "store/vars/shm_file.h"
#include "tools/client/node/run_view.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

std::optional<ExternalView> view_external(const std::string& node) {
  using rt::kRelaxed;
  const auto file = vars::ShmCopy::of(vars::external_file(node));
  if (!file || file.value().size() < sizeof(mirror::ExternalBlock)) {
    return std::nullopt;
  }
  const auto& block = *reinterpret_cast<const mirror::ExternalBlock*>(file.value().data());
  if (block.magic.load(std::memory_order_acquire) != mirror::kExternalMagic || block.abi != mirror::kExternalAbi) {
    return std::nullopt;
  }
  return ExternalView{.domain = block.domain,
                      .up = block.network.load(kRelaxed) == mirror::Network::Up,
                      .problem = block.problem.get(),
                      .topics = block.topics,
                      .writable = block.writable,
                      .read = block.read.load(kRelaxed),
                      .samples = block.samples.load(kRelaxed),
                      .unsendable = block.refused_by_dds.load(kRelaxed),
                      .received = block.received.load(kRelaxed),
                      .refused = block.refused.load(kRelaxed),
                      .mismatched = block.mismatched.load(kRelaxed),
                      .cycle_max_ns = block.cycle_max_ns.load(kRelaxed)};
}

JsonValue json_of(const ExternalView& view) {
  return {{"domain", view.domain},   {"in_network", view.up},         {"problem", view.problem},
          {"topics", view.topics},   {"with_readers", view.read},     {"settable", view.writable},
          {"samples", view.samples}, {"unsendable", view.unsendable}, {"received", view.received},
          {"refused", view.refused}, {"mismatched", view.mismatched}, {"cycle_max_ns", view.cycle_max_ns}};
}

}  // namespace indurop::tools
