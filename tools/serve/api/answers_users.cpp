// SPDX-License-Identifier: Apache-2.0
// Answers about users: signing in and out, and what an administrator sees of them.
#include <fmt/format.h>

#include "core/rt/clock.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/users/user_book.h"

namespace indurop::serve::answers {
namespace {

base::Json about_client(const Client& client) {
  base::Json body = base::Json::object();
  body["user"] = client.name;
  body["role"] = word_of(client.role);
  body["boards"] = base::Json(client.boards);
  body["variables"] = base::Json(client.variables);
  return body;
}

// Returns why it could not be noted, else an empty text.
std::string note(Api& api, const Call& call, const std::string& who, const char* action, const std::string& what,
                 const std::string& outcome) {
  AuditEntry entry;
  entry.who = who;
  entry.from = call.request->from;
  entry.action = action;
  entry.what = what;
  entry.outcome = outcome;
  return api.audit().note(entry);
}

}  // namespace

std::optional<std::string> user_who_signs_in(const Request& request) {
  const auto json = base::Json::parse(request.body);
  std::string user;
  return json && base::read(*json, "user", user) ? std::optional(std::move(user)) : std::nullopt;
}

Reply sign_in(Api& api, const Call& call) {
  if (!api.users().used()) {
    return refusal(status::kNotFound, "this server has no users; start it with --users FILE");
  }
  const auto json = base::Json::parse(call.request->body);
  std::string user;
  std::string password;
  if (!json || !base::read(*json, "user", user) || !base::read(*json, "password", password)) {
    return refusal(status::kBadRequest, "user and password are wanted");
  }
  const auto token = api.users().sign_in(user, password, call.request->from);
  if (!token) {
    Reply reply = refusal(status::kUnauthorized, "the user or the password is wrong");
    reply.wrong_credentials = fmt::format("wrong user or password, as '{}'", user.substr(0, 40));
    return reply;
  }
  static_cast<void>(note(api, call, user, "sign in", "", "done"));  // it changes nothing
  const auto client = api.users().client_of_token(*token);
  base::Json body = about_client(client.value_or(Client{}));
  body["token"] = *token;
  body["idle_ns"] = UserBook::kIdleNs;
  body["longest_ns"] = UserBook::kLongestNs;
  return json_reply(body);
}

Reply session(Api& /*api*/, const Call& call) {
  return json_reply(about_client(call.request->client));
}

Reply sign_out(Api& api, const Call& call) {
  const bool ended = api.users().sign_out(sent_token(*call.request));
  return json_reply(base::Json{{"ended", ended}});
}

Reply users(Api& api, const Call& /*call*/) {
  const std::int64_t now = rt::now_ns();
  const std::vector<SessionFigures> sessions = api.users().sessions();
  base::Json list = base::Json::array();
  for (const config::PlantUser& user : api.users().users()) {
    base::Json open = base::Json::array();
    for (const SessionFigures& session : sessions) {
      if (session.user == user.name) {
        open.push_back(
            {{"from", session.from}, {"since_ns", now - session.since_ns}, {"idle_ns", now - session.used_ns}});
      }
    }
    list.push_back({{"user", user.name},
                    {"role", config::name_of(user.role)},
                    {"boards", base::Json(user.boards)},
                    {"variables", base::Json(user.variables)},
                    {"password", !user.password.empty()},
                    {"token", !user.token.empty()},
                    {"sessions", std::move(open)}});
  }
  return json_reply(base::Json{{"users", std::move(list)}});
}

Reply end_sessions(Api& api, const Call& call) {
  const std::string& user = call.part.find("user")->second;
  Request request = *call.request;  // its client may have lost the right while it waited
  if (auto refused = api.facts().refuse(request)) {
    return std::move(*refused);
  }
  if (!api.users().client_named(user)) {
    return refusal(status::kNotFound, fmt::format("there is no user '{}'", user));
  }
  if (const std::string problem = note(api, call, call.who, "end sessions", user, "begun"); !problem.empty()) {
    return refusal(status::kFailed, fmt::format("no session was ended, because it cannot be logged in {}: {}",
                                                api.audit().file().string(), problem));
  }
  const std::size_t ended = api.users().end_sessions(user);
  static_cast<void>(note(api, call, call.who, "end sessions", user, fmt::format("{} ended", ended)));
  return json_reply(base::Json{{"user", user}, {"ended", ended}});
}

}  // namespace indurop::serve::answers
