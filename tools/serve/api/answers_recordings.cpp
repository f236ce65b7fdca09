// SPDX-License-Identifier: Apache-2.0
// Answers about recordings: the list, the contents of one, and its numbers over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/client/recordings/recorded_file.h"
#include "tools/client/recordings/recorded_tick.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/recording_choice.h"

namespace indurop::serve {

Result<tools::RecordingFile, Reply> recording_of(const Api& api, const Call& call) {
  const std::string& name = call.part.find("name")->second;
  const auto all = tools::list_recordings(api.facts().recordings);
  const auto found =
      std::find_if(all.begin(), all.end(), [&name](const tools::RecordingFile& one) { return one.name == name; });
  return found != all.end() ? Result<tools::RecordingFile, Reply>(*found)
                            : refusal(status::kNotFound, fmt::format("there is no recording '{}'", name));
}

namespace answers {
namespace {

constexpr std::uint64_t kMostPoints = 20'000;
constexpr std::size_t kMostNames = 64;

base::Json json_of(const tools::RecordingFile& file) {
  base::Json out = base::Json::object();
  out["name"] = file.name;
  out["node"] = file.node;
  out["reason"] = file.reason;
  out["black_box"] = file.black_box;
  out["bytes"] = file.bytes;
  out["wall_ns"] = file.wall_ns;
  return out;
}

}  // namespace

Reply recordings(Api& api, const Call& /*call*/) {
  base::Json list = base::Json::array();
  for (const tools::RecordingFile& file : tools::list_recordings(api.facts().recordings)) {
    list.push_back(json_of(file));
  }
  base::Json body = base::Json::object();
  body["recordings"] = std::move(list);
  return json_reply(body);
}

Reply recording(Api& api, const Call& call) {
  const auto file = recording_of(api, call);
  if (!file) {
    return file.error();
  }
  const auto contents = tools::read_contents_of(file->path);
  if (!contents) {
    return refusal(status::kWrongValue, contents.error().text);
  }
  base::Json body = json_of(*file);
  body["begin_ns"] = contents->begin_ns;
  body["end_ns"] = contents->end_ns;
  body["complete"] = contents->complete;
  body["boards"] = base::Json(tools::boards_in(file->path));
  base::Json channels = base::Json::array();
  for (const tools::RecordedChannel& channel : contents->channels) {
    base::Json one = base::Json::object();
    one["name"] = channel.name;
    one["unit"] = channel.unit;
    one["numbers"] = base::Json(channel.numbers);
    channels.push_back(std::move(one));
  }
  body["channels"] = std::move(channels);
  return json_reply(body);
}

Reply recorded_values(Api& api, const Call& call) {
  const auto file = recording_of(api, call);
  if (!file) {
    return file.error();
  }
  tools::ValuesRequest request;
  for (const auto& [name, value] : call.request->query) {
    if (name == "number") {
      request.names.push_back(value);
    }
  }
  const auto from = query_number(call, "from_ns", 0, 0, INT64_MAX);
  const auto to = query_number(call, "to_ns", 0, 0, INT64_MAX);
  const auto points = query_number(call, "points", 1000, 2, kMostPoints);
  if (!from || !to || !points || request.names.empty() || request.names.size() > kMostNames) {
    return refusal(status::kBadRequest,
                   "number says which (1 to 64 times), from_ns and to_ns are times, points is 2 to 20000");
  }
  request.from_ns = static_cast<std::int64_t>(*from);
  request.to_ns = static_cast<std::int64_t>(*to);
  request.points = *points;
  const auto values = tools::read_values_of(file->path, request);
  if (!values) {
    return refusal(status::kWrongValue, values.error().text);
  }
  base::Json body = base::Json::object();
  body["name"] = file->name;
  body["begin_ns"] = values->begin_ns;
  body["end_ns"] = values->end_ns;
  base::Json lines = base::Json::array();
  for (std::size_t i = 0; i < request.names.size(); ++i) {
    base::Json numbers = base::Json::array();
    for (const double value : values->lines[i]) {
      numbers.push_back(std::isfinite(value) ? base::Json(value) : base::Json());
    }
    base::Json line = base::Json::object();
    line["name"] = request.names[i];
    line["values"] = std::move(numbers);
    lines.push_back(std::move(line));
  }
  body["lines"] = std::move(lines);
  return json_reply(body);
}

}  // namespace answers

}  // namespace indurop::serve
