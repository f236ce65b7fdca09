// SPDX-License-Identifier: Apache-2.0
// indurop keys send: tells the boards of a plant which of its keys are valid.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/keys/participant_keys.h"
#include "deploy/link/link_keys.h"
#include "tools/cli/plant/send_list.h"
#include "tools/cli/verbs/keys_request.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

namespace {

// With the keys of any participant: the list is signed, not the command.
Result<void, base::Problem> choose_keys(deploy::LinkSettings& settings, const std::filesystem::path& folder) {
  auto keys = keys::resolve_keys(folder, keys::Role::Deployer);
  if (!keys) {
    keys = keys::resolve_keys(folder, keys::Role::Viewer);
  }
  if (!keys) {
    return keys.error();
  }
  settings.keys = keys->folder;
  settings.network.security = deploy::security_of(*keys);
  return {};
}

std::vector<std::string> revoked_boards(const keys::PlantKeys& keys) {
  std::vector<std::string> names;
  for (const keys::KeyListing& each : keys.list(keys::instant_now())) {
    if (each.role == keys::Role::Board && each.revoked) {
      names.push_back(each.name);
    }
  }
  return names;
}

}  // namespace

int send_keys(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  const auto list = keys.trust_list();
  if (!list) {
    context.out.error(list.error().text);
    return kFailed;
  }
  deploy::LinkSettings settings = request.link;
  if (settings.keys.empty()) {
    if (const auto chosen = choose_keys(settings, keys.folder()); !chosen) {
      context.out.error(chosen.error().text);
      return kFailed;
    }
  }
  const auto link = open_link(context.out, settings);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, kSendNs, [&] { return roster.complete(); });
  if (roster.all().empty()) {
    context.out.error(
        fmt::format("no board of plant {} was heard; its agents have to run and to have keys of this "
                    "authority",
                    keys.plant()));
    return kUnreachable;
  }
  BoardCommander commander = BoardCommander::unsigned_commands();
  const int code = send_list(
      context, *link, settings.self, commander, roster, {keys.plant(), true, revoked_boards(keys)},
      {deploy::Action::SetTrust, *list, "knows now which keys are valid", "knew already which keys are valid"});
  context.out.note(
      "a board that has the list rejects what others sign at once. A node checks its neighbours when it connects: "
      "restart "
      "the nodes (indurop restart @BOARD) to disconnect a board or viewer that was revoked, and to let in new keys of "
      "a "
      "board");
  return code;
}

}  // namespace indurop::tools
