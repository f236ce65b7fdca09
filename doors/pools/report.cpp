// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/report.h"

#include <fmt/format.h>

namespace indurop::pool_door {

std::string line_of(const std::string& pool, const SendCounts& counts) {
  return fmt::format(
      "{}: sent {} (now to {} reader{}); not sent: {} by --hz, {} superseded before the network was ready, {} "
      "abandoned "
      "halfway",
      pool, counts.sent.load(), counts.readers.load(), counts.readers.load() == 1 ? "" : "s", counts.by_rate.load(),
      counts.superseded.load(), counts.abandoned.load());
}

std::string line_of(const std::string& pool, const ReceiveCounts& counts) {
  return fmt::format(
      "{}: received {} (now from {} sender{}); lost: {} incomplete, {} without a free chunk; {} parts of another type "
      "or "
      "without a pool",
      pool, counts.received.load(), counts.senders.load(), counts.senders.load() == 1 ? "" : "s",
      counts.incomplete.load(), counts.no_chunk.load(), counts.refused.load());
}

tools::JsonValue json_of(const std::string& pool, const SendCounts& counts) {
  return {{"pool", pool},
          {"direction", "send"},
          {"readers", counts.readers.load()},
          {"sent", counts.sent.load()},
          {"bytes", counts.bytes.load()},
          {"by_rate", counts.by_rate.load()},
          {"superseded", counts.superseded.load()},
          {"abandoned", counts.abandoned.load()}};
}

tools::JsonValue json_of(const std::string& pool, const ReceiveCounts& counts) {
  return {{"pool", pool},
          {"direction", "receive"},
          {"senders", counts.senders.load()},
          {"received", counts.received.load()},
          {"bytes", counts.bytes.load()},
          {"incomplete", counts.incomplete.load()},
          {"no_chunk", counts.no_chunk.load()},
          {"refused", counts.refused.load()}};
}

}  // namespace indurop::pool_door
