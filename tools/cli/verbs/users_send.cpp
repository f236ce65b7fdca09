// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/verbs/users_send.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/users_reader.h"
#include "core/rt/clock.h"
#include "deploy/transaction/user_list.h"
#include "tools/cli/plant/send_list.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

// Returns a list with these users that is newer than those of the boards.
deploy::UserList next_list(const std::string& plant, std::vector<config::PlantUser> users, deploy::DeployLink& link,
                           std::uint64_t self, const BoardRoster& roster) {
  deploy::UserList list{plant, 0, {}, {}};
  std::uint64_t highest = 0;
  for (const auto& [agent, text] : fetch_texts(link, self, std::string(deploy::kUsersBlob), roster.agents())) {
    if (const auto known = deploy::read_user_list(text); known && known->plant == plant) {
      highest = std::max(highest, known->serial);
    }
  }
  list.serial = deploy::next_serial(highest, rt::wall_ns());
  for (config::PlantUser& user : users) {  // who signs in is decided by indurop serve
    user.password.clear();
    user.token.clear();
  }
  list.users = config::users_text(users);
  return list;
}

}  // namespace

int send_users(Context& context, const std::vector<config::PlantUser>& users, SendRequest request) {
  auto commander = BoardCommander::make(context.out, request.link.keys);
  if (!commander) {
    return report(context.out, commander.error());
  }
  auto link = open_link(context.out, request.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, kSendNs, [&] { return roster.complete(); });
  const auto plant = choose_plant(roster, request.plant);
  if (!plant) {
    return report(context.out, with_keys_hint(plant.error(), request.link));
  }
  deploy::UserList list = next_list(*plant, users, *link, request.link.self, roster);
  list.signature = commander->signature_of(deploy::signed_text(list));
  return send_list(context, *link, request.link.self, *commander, roster, {*plant, false, {}},
                   {deploy::Action::SetUsers, deploy::text_of(list),
                    fmt::format("has {} now", counted(users.size(), "user")), "has this list already"});
}

}  // namespace indurop::tools
