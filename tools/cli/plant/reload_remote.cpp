// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/reload_remote.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/user_name.h"
#include "core/keys/digest.h"
#include "core/rt/clock.h"
#include "deploy/link/blob_server.h"
#include "deploy/transaction/write_words.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using deploy::Outcome;

constexpr std::int64_t kHeardNs = 5'000'000'000;

Result<operate::RemoteReload, Failure> words_of(const RemoteReloadOrder& order) {
  operate::RemoteReload words;
  words.request = order.request;
  words.back = order.file.empty();
  if (!words.back) {
    const auto digest = keys::digest_of_file(order.file);
    if (!digest) {
      return Failure{kFailed, fmt::format("{} cannot be read", order.file.string())};
    }
    words.digest = digest->digest;
    words.size = digest->size;
  }
  return words;
}

Result<operate::RemoteReloadReply, Failure> reply_of(const RemoteReloadOrder& order,
                                                     const deploy::CommandReply& answer) {
  const auto reply = answer.outcome == Outcome::Done ? operate::parse_remote_reload_reply(answer.text) : std::nullopt;
  if (!reply) {
    return Failure{kFailed,
                   fmt::format("{}@{} was not exchanged: {}", order.module, order.board, printable(answer.text))};
  }
  return *reply;
}

}  // namespace

Result<operate::RemoteReloadReply, Failure> reload_on_board(Context& context, RemoteReloadOrder& order) {
  const auto words = words_of(order);
  if (!words) {
    return words.error();
  }
  auto commander = BoardCommander::make(context.out, order.link.keys);
  if (!commander) {
    return commander.error();
  }
  const auto link = open_link(context.out, order.link);
  if (link == nullptr) {
    return Failure{kUnreachable, {}};
  }
  BoardRoster roster;
  roster.gather(*link, std::min(order.timeout_ns, kHeardNs), [&] { return roster.find(order.board) != nullptr; });
  const BoardRoster::Entry* const board = roster.find(order.board);
  if (board == nullptr) {
    return with_keys_hint({kUnreachable, fmt::format("board {} was not heard within {}", order.board,
                                                     human_age(std::min(order.timeout_ns, kHeardNs)))},
                          order.link);
  }
  deploy::BlobServer server(order.link.self, [&](const std::string& name) {
    return name == words->digest ? std::optional(deploy::BlobServer::Blob{order.file, {}}) : std::nullopt;
  });
  deploy::WriteOrder target;
  target.who = base::user_name();
  target.reason = context.reason;
  target.lines = {order.module, operate::text_of(*words)};
  const auto answered = commander->send(*link, order.link.self, board->report, deploy::Action::ReloadModule,
                                        deploy::text_of(target), order.timeout_ns + order.request.health_ns,
                                        [&] { return server.serve(*link, rt::MonoClock::now()); });
  if (!answered) {
    return Failure{answered.error().code,
                   fmt::format("{}@{} was not exchanged: {}", order.module, order.board, answered.error().text)};
  }
  return reply_of(order, answered->reply);
}

}  // namespace indurop::tools
