// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/trust_lists.h"

#include <fmt/format.h>

#include "core/base/text.h"
#include "deploy/agent/board_audit.h"

namespace indurop::deploy {

using base::Problem;

Result<std::string, Problem> take_trust_list(const std::string& board, const DeployKeys& keys, const std::string& plant,
                                             const std::string& from, const std::string& document) {
  const OwnKeys own = keys.own(plant);
  if (own.folder.empty()) {
    return Problem{own.problem.empty() ? "this board has no keys" : own.problem};
  }
  const keys::ReceivedTrust trust = keys.trust(own.plant);
  if (trust.current().document == document) {
    return std::string();
  }
  const auto serial = trust.judge(document);
  if (!serial) {
    return serial.error();
  }
  const auto taken = trust.take(document);
  const std::string unlogged = log_trust(board, own.plant, from, *serial, taken ? "done" : taken.error().text);
  if (!taken) {
    return taken.error();
  }
  return fmt::format("list {} of the keys of plant {} is valid now{}", *serial, own.plant,
                     unlogged.empty() ? "" : "; it cannot be logged in " + unlogged);
}

std::string trust_id(const DeployKeys& keys, const std::string& plant) {
  const std::uint64_t serial = keys.trust(plant).current().serial;
  return serial == 0 ? std::string() : fmt::format("{}", serial);
}

std::string trust_list_after(const DeployKeys& keys, const std::string& plant, const std::string& id) {
  keys::BoardTrust trust = keys.trust(plant).current();
  return trust.serial > base::whole_number(id).value_or(0) ? std::move(trust.document) : std::string();
}

}  // namespace indurop::deploy
