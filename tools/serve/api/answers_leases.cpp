// SPDX-License-Identifier: Apache-2.0
// Answers about forces that end with their client.
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve::answers {
namespace {

Reply about_lease(Api& api, const Call& call,
                  bool (LeaseDesk::*what)(const std::string&, const std::string&, const std::string&)) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& name = call.part.find("lease")->second;
  if (!(api.leases().*what)((*found)->name(), name, call.who)) {
    return refusal(status::kNotFound,
                   "there is no such lease of yours any more: it was not renewed in time, or another user has "
                   "released what it held");
  }
  base::Json body = about(**found);
  body["lease"] = name;
  body["lease_ns"] = LeaseDesk::kLeaseNs;
  return json_reply(body);
}

}  // namespace

Reply renew_lease(Api& api, const Call& call) {
  return about_lease(api, call, &LeaseDesk::renew);
}

Reply end_lease(Api& api, const Call& call) {
  return about_lease(api, call, &LeaseDesk::end);
}

}  // namespace indurop::serve::answers
