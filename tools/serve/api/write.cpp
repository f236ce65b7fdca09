// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/write.h"

#include <fmt/format.h>

#include <memory>

#include "tools/cli/values/here_source.h"
#include "tools/cli/values/node_choice.h"

namespace indurop::serve {

Write::Write(Api& api, const Call& call, std::string action) : api_(&api) {
  entry_.who = call.who;
  entry_.from = call.request->from;
  const auto board = call.part.find("board");
  entry_.board = board != call.part.end() ? board->second : "";
  entry_.action = std::move(action);
  context_.who = entry_.who;
  context_.from = entry_.from;
  context_.out.divert(&messages_);
}

Result<vars::Store, Reply> Write::open(bool running) {
  context_.node = entry_.board;
  auto source = std::make_shared<tools::HereSource>(entry_.board, vars::Mode::ReadWrite);
  auto store = source->attach();
  if (!store.ok()) {
    const bool denied = store.error().code == Errc::PermissionDenied;
    return failed(denied ? status::kForbidden : status::kConflict,
                  tools::explain_open_error(store.error(), entry_.board, true));
  }
  if (const std::string absence = source->absence(&store.value()); running && !absence.empty()) {
    return failed(status::kConflict, source->gone(absence) + ": forces are for a node that runs");
  }
  context_.values = std::move(source);
  return std::move(store).value();
}

void Write::about(std::string what, std::string reason) {
  entry_.what = std::move(what);
  entry_.reason = std::move(reason);
  context_.reason = entry_.reason;
}

Reply Write::failed(int code, std::string why) {
  note_failure(why);
  return refusal(code, std::move(why), messages_.size() > 1 ? messages_ : std::vector<std::string>());
}

Reply Write::failed(int code, const std::vector<std::string>& all) {
  note_failure(all.front());
  return refusal(code, all.front(), all);
}

Reply Write::failed(const operate::Refusal& refusal) {
  using operate::Why;
  std::vector<std::string> reasons = refusal.reasons;
  if (refusal.why == Why::Locked) {
    reasons.front() = fmt::format("node '{}': {}", entry_.board, reasons.front());
  }
  const int code = refusal.why == Why::Locked   ? status::kLocked
                   : refusal.why == Why::Busy   ? status::kNoAnswer
                   : refusal.why == Why::Absent ? status::kConflict
                                                : status::kWrongValue;
  note_failure(reasons.front());
  return serve::refusal(code, reasons.front(), reasons.size() > 1 ? reasons : std::vector<std::string>());
}

void Write::note_failure(const std::string& why) {
  entry_.outcome = why;
  static_cast<void>(api_->audit().note(entry_));  // nothing was written, so a missing log entry hides nothing
}

Reply Write::failed_with(int exit_code) {
  std::string why = messages_.empty() ? "it failed" : messages_.front();
  return failed(exit_code == kUnreachable ? status::kNoAnswer : status::kWrongValue, std::move(why));
}

std::optional<Reply> Write::begin() {
  entry_.outcome = "begun";
  const std::string problem = api_->audit().note(entry_);
  if (problem.empty()) {
    return std::nullopt;
  }
  return refusal(status::kFailed, fmt::format("nothing was written, because it cannot be noted down in {}: {}",
                                              api_->audit().file().string(), problem));
}

Reply Write::done(const base::Json& body) {
  entry_.outcome = "done";
  static_cast<void>(api_->audit().note(entry_));  // its begin is logged already
  return json_reply(body);
}

}  // namespace indurop::serve
