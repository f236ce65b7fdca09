// SPDX-License-Identifier: Apache-2.0
// The answer with a scope's capture: it is sent after the trigger, or after a while without one.
#include <string>
#include <utility>

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/scope/save.h"
#include "tools/client/scope/scope.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

constexpr std::int64_t kPauseNs = 10'000'000;
constexpr std::uint64_t kMostRows = 20'000;
constexpr std::uint64_t kUsualPatienceMs = 2000;
constexpr std::uint64_t kMostPatienceMs = 10'000;
constexpr std::int64_t kMsNs = 1'000'000;
constexpr std::int64_t kLongestRestNs = 60'000'000'000;  // maximum time after the trigger

struct Wanted {
  tools::ScopeOrder order;
  std::int64_t patience_ns = 0;
};

Result<Wanted, Reply> wanted_of(const Call& call) {
  Wanted wanted;
  for (const auto& [name, value] : call.request->query) {
    if (name == "channel") {
      wanted.order.channels.push_back(value);
    }
  }
  wanted.order.trigger = query_value(*call.request, "trigger").value_or("");
  const auto pre = query_number(call, "pre", wanted.order.pre, 0, kMostRows);
  const auto post = query_number(call, "post", wanted.order.post, 0, kMostRows);
  const auto after = query_number(call, "after_tick", UINT64_MAX, 0, UINT64_MAX);
  const auto patience = query_number(call, "timeout_ms", kUsualPatienceMs, 1, kMostPatienceMs);
  if (!pre || !post || *pre + *post >= kMostRows) {
    return refusal(status::kBadRequest, "pre and post are numbers of ticks, together less than 20000");
  }
  if (!after || !patience) {
    return refusal(status::kBadRequest, "after_tick is the number of a tick, timeout_ms is 1 to 10000");
  }
  wanted.order.pre = *pre;
  wanted.order.post = *post;
  wanted.order.past = *after != UINT64_MAX;
  wanted.order.after_tick = wanted.order.past ? *after : 0;
  wanted.patience_ns = static_cast<std::int64_t>(*patience) * kMsNs;
  return wanted;
}

Reply refused(const tools::Failure& failure) {
  switch (failure.code) {
    case kUnreachable:
      return refusal(status::kConflict, failure.text);
    case kUsage:
      return refusal(status::kBadRequest, failure.text);
    default:
      return refusal(status::kWrongValue, failure.text);
  }
}

}  // namespace

Reply scope(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto wanted = wanted_of(call);
  if (!wanted) {
    return wanted.error();
  }
  auto opened = tools::Scope::open((*found)->name(), wanted->order);
  if (!opened) {
    return refused(opened.error());
  }
  base::Json body = about(**found);
  const std::int64_t begin = rt::now_ns();
  for (;;) {
    if (const auto capture = opened->poll()) {
      body["capture"] = tools::json_of(*capture);
      return json_reply(body);
    }
    const std::int64_t patience = opened->fired() ? kLongestRestNs : wanted->patience_ns;
    if (rt::now_ns() - begin >= patience || opened->over() || tools::interrupted()) {
      break;
    }
    tools::wait_until(rt::now_ns() + kPauseNs);
  }
  body["capture"] = nullptr;
  body["ticks"] = opened->ticks();
  return json_reply(body);
}

}  // namespace indurop::serve::answers
