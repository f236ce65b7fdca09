// SPDX-License-Identifier: Apache-2.0
// Answers for clients that step through a recording: one tick of it, and what modules kept after a tick.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tools/client/board/reported_board.h"
#include "tools/client/recordings/recorded_tick.h"
#include "tools/client/recordings/replayed_tick.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/recording_choice.h"
#include "tools/serve/api/write.h"

namespace indurop::serve::answers {
namespace {

constexpr std::size_t kMostNumbers = 64;

base::Json or_null(std::optional<std::uint64_t> number) {
  return number ? base::Json(*number) : base::Json();
}

base::Json run_json(const tools::TickRun& run) {
  base::Json values = base::Json::array();
  for (const tools::TickValue& value : run.values) {
    values.push_back({{"name", value.name}, {"written", value.written}, {"text", value.text}});
  }
  return {{"module", run.module},     {"number", run.number}, {"release_ns", run.release_ns},
          {"start_ns", run.start_ns}, {"end_ns", run.end_ns}, {"faulted", run.faulted},
          {"values", values}};
}

}  // namespace

Reply recorded_tick(Api& api, const Call& call) {
  const auto file = recording_of(api, call);
  if (!file) {
    return file.error();
  }
  tools::TickRequest request;
  request.board = query_value(*call.request, "board").value_or("");
  for (const auto& [name, value] : call.request->query) {
    if (name == "number") {
      request.names.push_back(value);
    }
  }
  const bool by_tick = query_value(*call.request, "tick").has_value();
  const auto tick = query_number(call, "tick", 0, 0, INT64_MAX);
  const auto at = query_number(call, "at_ns", 0, 0, INT64_MAX);
  if (!tick || !at || request.names.size() > kMostNumbers) {
    return refusal(status::kBadRequest, "tick is a number, or at_ns a time; number says which (at most 64 times)");
  }
  request.tick = by_tick ? tick : std::nullopt;
  request.at_ns = static_cast<std::int64_t>(*at);
  const auto found = tools::read_tick_of(file->path, request);
  if (!found) {
    return refusal(status::kWrongValue, found.error().text);
  }
  base::Json runs = base::Json::array();
  for (const tools::TickRun& run : found->runs) {
    runs.push_back(run_json(run));
  }
  base::Json numbers = base::Json::array();
  for (std::size_t i = 0; i < request.names.size(); ++i) {
    const double value = found->numbers[i];
    base::Json number = base::Json::object();
    number["name"] = request.names[i];
    number["value"] = std::isfinite(value) ? base::Json(value) : base::Json();
    numbers.push_back(std::move(number));
  }
  base::Json body = base::Json::object();
  body["name"] = file->name;
  body["tick"] = found->tick;
  body["previous"] = or_null(found->previous);
  body["next"] = or_null(found->next);
  body["begin_ns"] = found->begin_ns;
  body["end_ns"] = found->end_ns;
  body["runs"] = std::move(runs);
  body["numbers"] = std::move(numbers);
  return json_reply(body);
}

Reply replay_recording(Api& api, const Call& call) {
  Write write(api, call, "replay");
  const auto file = recording_of(api, call);
  if (!file) {
    return file.error();
  }
  const auto json = base::Json::parse(call.request->body);
  std::uint64_t tick = 0;
  std::string board;
  if (!json || !base::read(*json, "tick", tick)) {
    return write.failed(status::kBadRequest, "tick is a number");
  }
  base::read(*json, "board", board);
  write.about(fmt::format("{} to tick {}", file->name, tick), "");
  if (const auto unlogged = write.begin({{}, true})) {
    return write.failed(*unlogged);
  }
  const std::string node = tools::remote_store_prefix() + "replay";  // it is no board
  auto replayed = tools::replay_tick(file->path, board, {}, tick, node);
  if (!replayed) {
    return write.failed(status::kConflict, replayed.error().text);
  }
  base::Json body = base::Json::object();
  body["name"] = file->name;
  body["tick"] = tick;
  body["differing"] = replayed->differing;
  body["modules"] = std::move(replayed->modules);
  body["messages"] = base::Json(replayed->messages);
  return write.done(body);
}

}  // namespace indurop::serve::answers
