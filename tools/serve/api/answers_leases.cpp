// SPDX-License-Identifier: Apache-2.0
// Answers about forces that end with their client.
#include "tools/serve/api/answers.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve::answers {
namespace {

template <class What>
Reply about_lease(const Call& call, What what) {
  const std::string& board = call.part.find("board")->second;
  const std::string& name = call.part.find("lease")->second;
  if (!what(board, name)) {
    return refusal(status::kNotFound,
                   "there is no such lease of yours any more: it was not renewed in time, another user has released "
                   "what it held, you may no longer change it, or its board does not answer");
  }
  return json_reply({{"board", board}, {"lease", name}, {"lease_ns", LeaseDesk::kLeaseNs}});
}

}  // namespace

Reply renew_lease(Api& api, const Call& call) {
  return about_lease(call, [&](const std::string& board, const std::string& name) {
    return api.leases().renew(board, name, call.request->client);
  });
}

Reply end_lease(Api& api, const Call& call) {
  return about_lease(
      call, [&](const std::string& board, const std::string& name) { return api.leases().end(board, name, call.who); });
}

}  // namespace indurop::serve::answers
