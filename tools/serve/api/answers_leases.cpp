// SPDX-License-Identifier: Apache-2.0
// Answers about forces that end with their client.
#include "tools/serve/api/answers.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve::answers {
namespace {

Reply about_lease(Api& api, const Call& call,
                  bool (LeaseDesk::*what)(const std::string&, const std::string&, const std::string&)) {
  const std::string& board = call.part.find("board")->second;
  const std::string& name = call.part.find("lease")->second;
  if (!(api.leases().*what)(board, name, call.who)) {
    return refusal(status::kNotFound,
                   "there is no such lease of yours any more: it was not renewed in time, another user has released "
                   "what it held, or its board does not answer");
  }
  return json_reply({{"board", board}, {"lease", name}, {"lease_ns", LeaseDesk::kLeaseNs}});
}

}  // namespace

Reply renew_lease(Api& api, const Call& call) {
  return about_lease(api, call, &LeaseDesk::renew);
}

Reply end_lease(Api& api, const Call& call) {
  return about_lease(api, call, &LeaseDesk::end);
}

}  // namespace indurop::serve::answers
