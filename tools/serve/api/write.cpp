// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/write.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

#include "core/base/name_patterns.h"
#include "tools/serve/boards/local_board.h"

namespace indurop::serve {
namespace {

// Returns why the client may not change this; nothing if it may.
std::optional<std::string> beyond_rights(const Client& client, const Affected& affected) {
  if (client.variables.empty()) {
    return std::nullopt;
  }
  const std::string most = fmt::format("{} may change {} only", client.name, fmt::join(client.variables, ", "));
  if (affected.board) {
    return most;
  }
  for (const std::string& name : affected.variables) {
    if (!base::matches_any_variable(client.variables, name)) {
      return fmt::format("{}, not {}", most, name);
    }
  }
  return std::nullopt;
}

// Returns why the request is refused by the rights of now; nothing if it is not. Sets its client.
std::optional<Refused> refused_now(const Api& api, Request& request) {
  request.background = true;  // its arrival was the use of the session
  const auto reply = api.facts().refuse(request);
  if (!reply) {
    return std::nullopt;
  }
  std::string why;
  if (const auto body = base::Json::parse(reply->body)) {
    base::read(*body, "message", why);
  }
  return Refused{reply->status, {std::move(why)}};
}

}  // namespace

Write::Write(Api& api, const Call& call, std::string action) : api_(&api), request_(*call.request) {
  request_.body.clear();
  entry_.who = call.who;
  entry_.from = call.request->from;
  const auto board = call.part.find("board");
  entry_.board = board != call.part.end() ? board->second : "";
  entry_.action = std::move(action);
}

void Write::about(std::string what, std::string reason) {
  entry_.what = std::move(what);
  entry_.reason = std::move(reason);
}

Reply Write::failed(int code, std::string why) {
  return failed(Refused{code, {std::move(why)}});
}

Reply Write::failed(const Refused& refused) {
  note_failure(refused.reasons.front());
  return refusal(refused.code, refused.reasons.front(),
                 refused.reasons.size() > 1 ? refused.reasons : std::vector<std::string>());
}

Reply Write::failed(const operate::Refusal& refusal) {
  return failed(refused_by(entry_.board, refusal));
}

void Write::note_failure(const std::string& why) {
  entry_.outcome = why;
  static_cast<void>(api_->audit().note(entry_));  // nothing was written, so a missing log entry hides nothing
}

std::optional<Refused> Write::begin(const Affected& affected) {
  if (auto refused = refused_now(*api_, request_)) {
    return refused;
  }
  if (auto beyond = beyond_rights(request_.client, affected)) {
    return Refused{status::kForbidden, {std::move(*beyond)}};
  }
  entry_.outcome = "begun";
  const std::string problem = api_->audit().note(entry_);
  if (problem.empty()) {
    return std::nullopt;
  }
  unlogged_ = fmt::format("cannot be logged in {}: {}", api_->audit().file().string(), problem);
  if (affected.stop) {
    return std::nullopt;
  }
  return Refused{status::kFailed, {fmt::format("nothing was written, because it {}", unlogged_)}};
}

Reply Write::done(base::Json body) {
  if (!unlogged_.empty()) {
    body["not_logged"] = unlogged_;
  }
  entry_.outcome = "done";
  static_cast<void>(api_->audit().note(entry_));  // its begin is logged already
  return json_reply(body);
}

}  // namespace indurop::serve
