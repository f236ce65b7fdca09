// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/command_exchange.h"

namespace indurop::tools {

void CommandExchange::sent(std::int64_t now_ns) noexcept {
  constexpr std::int64_t kRepeatNs = 200'000'000;
  due_ns_ = now_ns + kRepeatNs;
}

bool CommandExchange::take(const deploy::CommandReply& reply) {
  using deploy::Outcome;
  if (reply.commander != command_.commander || reply.board != command_.board || reply.agent != command_.agent) {
    return false;
  }
  if (reply.outcome == Outcome::Nonce) {
    if (!under_way_) {
      command_.nonce = reply.nonce;
      command_.signature = command_signature(key_, deploy::command_text(command_));
      due_ns_ = 0;
    }
    return false;
  }
  if (reply.nonce != command_.nonce) {
    return false;
  }
  under_way_ = under_way_ || reply.outcome == Outcome::UnderWay;
  return reply.outcome != Outcome::UnderWay;
}

}  // namespace indurop::tools
