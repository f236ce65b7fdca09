// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/write.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "tools/serve/boards/local_board.h"

namespace indurop::serve {

Write::Write(Api& api, const Call& call, std::string action) : api_(&api) {
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

std::optional<Refused> Write::begin() {
  entry_.outcome = "begun";
  const std::string problem = api_->audit().note(entry_);
  if (problem.empty()) {
    return std::nullopt;
  }
  return Refused{status::kFailed,
                 {fmt::format("nothing was written, because it cannot be noted down in {}: {}",
                              api_->audit().file().string(), problem)}};
}

Reply Write::done(const base::Json& body) {
  entry_.outcome = "done";
  static_cast<void>(api_->audit().note(entry_));  // its begin is logged already
  return json_reply(body);
}

}  // namespace indurop::serve
