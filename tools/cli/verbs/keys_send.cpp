// SPDX-License-Identifier: Apache-2.0
// indurop keys send: tells the boards of a plant which of its keys are valid.
#include <fmt/format.h>

#include "deploy/link/link_keys.h"
#include "tools/cli/plant/send_list.h"
#include "tools/cli/verbs/keys_request.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

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
    settings.keys = keys.folder();
    if (const auto used = deploy::use_keys(settings); !used) {
      context.out.error(used.error().text);
      return kFailed;
    }
  }
  auto commander = BoardCommander::make(context.out, settings.keys);
  if (!commander) {
    return report(context.out, commander.error());
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
  const int code = send_list(
      context, *link, settings.self, *commander, roster, keys.plant(), true,
      {deploy::Action::SetTrust, *list, "knows now which keys are valid", "knew already which keys are valid"});
  context.out.note(
      "commands and deployments are judged by this list from now on. A node checks its neighbours when it connects: "
      "restart the nodes (indurop restart @BOARD) to disconnect a board or viewer that was revoked");
  return code;
}

}  // namespace indurop::tools
