// SPDX-License-Identifier: Apache-2.0
// Answers about alarms: how they stand, what happened, and what people do about them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "serve/api/answers.h"
#include "serve/api/write.h"
#include "serve/boards/board.h"
#include "tools/alarms/alarm_list.h"
#include "tools/alarms/alarm_orders.h"

namespace indurop::serve::answers {
namespace {

constexpr std::uint64_t kMostEvents = 10'000;

std::vector<tools::DeclaredAlarm> declared_of(const Board& board) {
  return board.store() != nullptr ? tools::declared_alarms(*board.store()) : std::vector<tools::DeclaredAlarm>();
}

// What a body asks for, or what is wrong with it.
Result<tools::AlarmOrder, std::string> read_order(const Call& call, tools::AlarmEvent what) {
  const auto json = base::Json::parse(call.request->body);
  if (!json || !json->is_object()) {
    return std::string("the body is no JSON object");
  }
  tools::AlarmOrder order;
  order.what = what;
  order.who = call.who;
  order.from = call.request->from;
  base::read(*json, "alarms", order.names);
  base::read(*json, "all", order.all);
  base::read(*json, "reason", order.reason);
  base::read(*json, "for_ns", order.for_ns);
  if (order.names.empty() != order.all) {
    return std::string("name the alarms: alarms, or all");
  }
  if (what == tools::AlarmEvent::Shelved && order.for_ns <= 0) {
    return std::string("for_ns is a number of nanoseconds greater than 0");
  }
  return order;
}

Reply carry_out(Api& api, const Call& call, tools::AlarmEvent what, const char* word) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto order = read_order(call, what);
  if (!order) {
    return refusal(status::kBadRequest, order.error());
  }
  Write write(api, call, word);
  write.about(order->all ? "all alarms" : fmt::format("{}", fmt::join(order->names, " ")), order->reason);
  if (auto refused = write.begin()) {
    return *refused;
  }
  tools::AlarmJournal journal((*found)->name());
  const auto done = tools::carry_out(journal, declared_of(**found), *order);
  if (!done) {
    return write.failed(done.error().failed ? status::kFailed : status::kWrongValue, done.error().texts);
  }
  base::Json body = about(**found);
  body["alarms"] = *done;
  return write.done(body);
}

}  // namespace

Reply alarms(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  tools::AlarmJournal journal((*found)->name());
  journal.refresh();
  const auto declared = declared_of(**found);
  base::Json list = base::Json::array();
  for (const auto& one :
       tools::list_alarms(declared, journal.book(), query_value(*call.request, "all").value_or("") == "true")) {
    list.push_back(tools::json_of(one));
  }
  base::Json body = about(**found);
  body["watched"] = journal.watched();
  body["declared"] = declared.size();
  body["counts"] = tools::json_of(journal.book().counts());
  body["alarms"] = std::move(list);
  return json_reply(body);
}

Reply alarm_history(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  constexpr std::uint64_t kUsual = 200;
  const auto count = query_number(call, "count", kUsual, 1, kMostEvents);
  if (!count) {
    return refusal(status::kBadRequest, fmt::format("count is a number from 1 to {}", kMostEvents));
  }
  base::Json list = base::Json::array();
  for (const tools::AlarmEntry& one : tools::AlarmJournal((*found)->name()).history(*count)) {
    list.push_back(tools::json_of(one));
  }
  base::Json body = about(**found);
  body["events"] = std::move(list);
  return json_reply(body);
}

Reply acknowledge_alarms(Api& api, const Call& call) {
  return carry_out(api, call, tools::AlarmEvent::Acknowledged, "acknowledge");
}

Reply shelve_alarms(Api& api, const Call& call) {
  return carry_out(api, call, tools::AlarmEvent::Shelved, "shelve");
}

Reply unshelve_alarms(Api& api, const Call& call) {
  return carry_out(api, call, tools::AlarmEvent::Unshelved, "unshelve");
}

}  // namespace indurop::serve::answers
