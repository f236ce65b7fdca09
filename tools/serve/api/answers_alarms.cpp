// SPDX-License-Identifier: Apache-2.0
// Answers about alarms: their status, their history, and what operators do about them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

constexpr std::uint64_t kMostEvents = 10'000;

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
    return std::string("for_ns is a whole number of nanoseconds from 1 to 9223372036854775807");
  }
  return order;
}

bool is_line(const std::string& name) {
  return !name.empty() && name.find_first_of("\r\n") == std::string::npos;
}

// Adds the board's name to the fields, or returns why there are none.
Reply reply_of(const Board& board, const Board::Done& done) {
  if (!done) {
    return refusal(done.error().code, done.error().reasons.front());
  }
  base::Json body = about(board);
  body.update(*done);
  return json_reply(body);
}

Reply carry_out(Api& api, const Call& call, alarms::AlarmEvent what, const char* word) {
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
  if (!std::all_of(order->names.begin(), order->names.end(), is_line)) {
    return write.failed(status::kWrongValue, "names of alarms are one line each");
  }
  const auto done = (*found)->carry_out(*order, write);
  if (!done) {
    return write.failed(done.error());
  }
  base::Json body = about(**found);
  body.update(*done);
  return write.done(body);
}

}  // namespace

Reply alarms(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  return reply_of(**found, (*found)->alarm_status(query_value(*call.request, "all").value_or("") == "true"));
}

Reply alarm_history(Api& /*api*/, const Call& call) {
  constexpr std::uint64_t kUsual = 200;
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto count = query_number(call, "count", kUsual, 1, kMostEvents);
  if (!count) {
    return refusal(status::kBadRequest, fmt::format("count is a number from 1 to {}", kMostEvents));
  }
  return reply_of(**found, (*found)->alarm_history(*count));
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

}  // namespace indurop::serve::answers
