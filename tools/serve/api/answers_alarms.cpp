// SPDX-License-Identifier: Apache-2.0
// Answers about alarms: their status, their history, and what operators do about them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "history/alarms/alarm_list.h"
#include "history/alarms/alarm_orders.h"
#include "tools/cli/plant/plant_watch.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

constexpr std::uint64_t kMostEvents = 10'000;

std::vector<alarms::DeclaredAlarm> declared_of(const Board& board) {
  return board.store() != nullptr ? alarms::declared_alarms(*board.store()) : std::vector<alarms::DeclaredAlarm>();
}

// Parses a body, or returns what is wrong with it.
Result<alarms::AlarmOrder, std::string> read_order(const Call& call, alarms::AlarmEvent what) {
  const auto json = base::Json::parse(call.request->body);
  if (!json || !json->is_object()) {
    return std::string("the body is no JSON object");
  }
  alarms::AlarmOrder order;
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
  if (what == alarms::AlarmEvent::Shelved && order.for_ns <= 0) {
    return std::string("for_ns is a number of nanoseconds greater than 0");
  }
  return order;
}

using RemoteOrder = tools::PlantWatch::RemoteOrder;

RemoteOrder::What remote_word_of(alarms::AlarmEvent what) {
  return what == alarms::AlarmEvent::Acknowledged ? RemoteOrder::What::AckAlarms
         : what == alarms::AlarmEvent::Shelved    ? RemoteOrder::What::ShelveAlarms
                                                  : RemoteOrder::What::UnshelveAlarms;
}

// Returns the alarms that were changed, or the reply that says why none was.
Result<base::Json, Reply> done_remotely(Write& write, const Call& call, const Board& board,
                                        const alarms::AlarmOrder& order) {
  const auto done = call.plant->order(board.name(), {remote_word_of(order.what), order.names, order.for_ns,
                                                     order.who + " at " + order.from, order.reason});
  if (!done) {
    return write.failed(done.error().code == kUnreachable ? status::kNoAnswer : status::kWrongValue, done.error().text);
  }
  return base::Json::parse(*done).value_or(base::Json::array());
}

Result<base::Json, Reply> done_here(Write& write, const Board& board, const alarms::AlarmOrder& order) {
  alarms::AlarmJournal journal(board.name());
  const auto done = alarms::carry_out(journal, declared_of(board), order);
  if (!done) {
    return write.failed(done.error().failed ? status::kFailed : status::kWrongValue, done.error().texts);
  }
  return base::Json(*done);
}

bool is_line(const std::string& name) {
  return !name.empty() && name.find_first_of("\r\n") == std::string::npos;
}

Reply carry_out(Api& api, const Call& call, alarms::AlarmEvent what, const char* word) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& board = **found;
  const auto order = read_order(call, what);
  if (!order) {
    return refusal(status::kBadRequest, order.error());
  }
  Write write(api, call, word);
  write.about(order->all ? "all alarms" : fmt::format("{}", fmt::join(order->names, " ")), order->reason);
  if (!std::all_of(order->names.begin(), order->names.end(), is_line)) {
    return write.failed(status::kWrongValue, "names of alarms are one line each");
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  auto done = board.remote() != nullptr ? done_remotely(write, call, board, *order) : done_here(write, board, *order);
  if (!done) {
    return done.error();
  }
  base::Json body = about(board);
  body["alarms"] = std::move(*done);
  return write.done(body);
}

// Returns the report of the board's agent, or the reply that says why there is none.
Result<base::Json, Reply> told_by(const Call& call, const Board& board) {
  const auto texts = call.plant->texts("alarms", {board.name()});
  const auto text = texts.find(board.name());
  auto told = text != texts.end() ? base::Json::parse(text->second) : std::nullopt;
  if (!told || !told->is_object()) {
    return refusal(status::kNoAnswer, fmt::format("board {} does not say how its alarms stand ({}; agents of before "
                                                  "cannot)",
                                                  board.name(), board.state()));
  }
  return std::move(*told);
}

Result<std::uint64_t, Reply> wanted_events(const Call& call) {
  constexpr std::uint64_t kUsual = 200;
  const auto count = query_number(call, "count", kUsual, 1, kMostEvents);
  if (!count) {
    return refusal(status::kBadRequest, fmt::format("count is a number from 1 to {}", kMostEvents));
  }
  return *count;
}

bool wants_all(const Call& call) {
  return query_value(*call.request, "all").value_or("") == "true";
}

}  // namespace

Reply alarms(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  alarms::AlarmJournal journal((*found)->name());
  journal.refresh();
  const auto declared = declared_of(**found);
  base::Json list = base::Json::array();
  for (const auto& one : alarms::list_alarms(declared, journal.book(), wants_all(call))) {
    list.push_back(json_of(one));
  }
  base::Json body = about(**found);
  body["watched"] = journal.watched();
  body["declared"] = declared.size();
  body["counts"] = json_of(journal.book().counts());
  body["alarms"] = std::move(list);
  return json_reply(body);
}

Reply alarm_history(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto count = wanted_events(call);
  if (!count) {
    return count.error();
  }
  base::Json list = base::Json::array();
  for (const alarms::AlarmEntry& one : alarms::AlarmJournal((*found)->name()).history(*count)) {
    list.push_back(json_of(one));
  }
  base::Json body = about(**found);
  body["events"] = std::move(list);
  return json_reply(body);
}

Reply acknowledge_alarms(Api& api, const Call& call) {
  return carry_out(api, call, alarms::AlarmEvent::Acknowledged, "acknowledge");
}

Reply shelve_alarms(Api& api, const Call& call) {
  return carry_out(api, call, alarms::AlarmEvent::Shelved, "shelve");
}

Reply unshelve_alarms(Api& api, const Call& call) {
  return carry_out(api, call, alarms::AlarmEvent::Unshelved, "unshelve");
}

Reply remote_alarms(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto told = told_by(call, **found);
  if (!told) {
    return told.error();
  }
  base::Json list = base::Json::array();
  for (const base::Json& one : (*told)["alarms"].values()) {
    if (wants_all(call) || one["state"].text() != "normal") {
      list.push_back(one);
    }
  }
  base::Json body = about(**found);
  body["watched"] = (*told)["watched"].boolean().value_or(false);
  body["declared"] = (*told)["declared"].natural().value_or(0);
  body["counts"] = json_of(alarms::counts_in((*told)["counts"]));
  body["alarms"] = std::move(list);
  return json_reply(body);
}

Reply remote_alarm_history(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto count = wanted_events(call);
  if (!count) {
    return count.error();
  }
  const auto told = told_by(call, **found);
  if (!told) {
    return told.error();
  }
  const auto all = (*told)["events"].values();
  base::Json list = base::Json::array();
  for (std::size_t i = all.size() - std::min<std::size_t>(all.size(), *count); i < all.size(); ++i) {
    list.push_back(all[i]);
  }
  base::Json body = about(**found);
  body["events"] = std::move(list);
  return json_reply(body);
}

}  // namespace indurop::serve::answers
