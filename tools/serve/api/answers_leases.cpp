// SPDX-License-Identifier: Apache-2.0
// Answers about forces that end with their client, and about a board's write lock.
#include "store/operate/set.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
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
    return refusal(
        status::kNotFound,
        "there is no such lease of yours any more: it was not renewed in time, or somebody else has let go of "
        "what it held");
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

Reply set_lock(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "lock");
  const auto json = base::Json::parse(call.request->body);
  std::string word;
  std::string reason;
  if (!json || !base::read(*json, "lock", word) || !vars::write_lock_of(word)) {
    return write.failed(status::kBadRequest, "lock is none, tune or all");
  }
  base::read(*json, "reason", reason);
  write.about(word, reason);
  if (auto refused = write.begin()) {
    return *refused;
  }
  if (const auto locked = operate::set_lock((*found)->name(), *vars::write_lock_of(word), write.who()); !locked) {
    return write.failed(locked.error());
  }
  base::Json body = about(**found);
  body["lock"] = word;
  return write.done(body);
}

}  // namespace indurop::serve::answers
