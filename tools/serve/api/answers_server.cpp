// SPDX-License-Identifier: Apache-2.0
// Answers about the server itself.
#include "core/rt/clock.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/users/user_book.h"

namespace indurop::serve::answers {

Reply description(Api& /*api*/, const Call& /*call*/) {
  Reply reply;
  reply.body = api_description();
  return reply;
}

Reply server_status(Api& api, const Call& call) {
  const ServerFacts& facts = api.facts();
  const std::int64_t now = rt::now_ns();
  base::Json body = base::Json::object();
  body["program"] = "indurop-serve";
  body["version"] = facts.version;
  body["api"] = kApiVersion;
  body["write"] = api.gate().settings().write;
  const Client& asker = call.request->client;
  body["may_write"] = api.gate().may(asker, Role::Operate);
  body["who"] = call.who;
  body["role"] = word_of(asker.role);
  body["users"] = api.users().used();
  body["web"] = facts.web;
  body["plant"] = facts.plant;
  body["plc"] = facts.plc;
  body["started_wall_ns"] = facts.started_wall_ns;
  body["uptime_ns"] = now - facts.started_ns;
  body["max_clients"] = facts.most_clients;
  body["max_rate_hz"] = kMostRateHz;
  base::Json clients = base::Json::array();
  for (const ClientFigures& client : facts.clients()) {
    base::Json one = base::Json::object();
    one["id"] = client.id;
    one["address"] = client.address;
    one["since_ns"] = now - client.since_ns;
    one["streams"] = client.streams;
    one["sent"] = client.sent;
    one["dropped"] = client.dropped;
    one["sent_bytes"] = client.sent_bytes;
    clients.push_back(std::move(one));
  }
  body["clients"] = std::move(clients);
  return json_reply(body);
}

Reply audit(Api& api, const Call& call) {
  constexpr std::uint64_t kUsual = 100;
  constexpr std::uint64_t kMaxEntries = 1000;
  const auto count = query_number(call, "count", kUsual, 1, kMaxEntries);
  if (!count) {
    return refusal(status::kBadRequest, "count is a number of 1 to 1000");
  }
  base::Json list = base::Json::array();
  for (const AuditEntry& entry : read_audit(api.audit().file(), *count)) {
    list.push_back(json_of(entry));
  }
  base::Json body = base::Json::object();
  body["audit"] = std::move(list);
  return json_reply(body);
}

}  // namespace indurop::serve::answers
