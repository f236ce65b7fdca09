// SPDX-License-Identifier: Apache-2.0
// Answers with values over time: what variables were between two times, in pages.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "core/base/hexadecimal.h"
#include "tools/client/history/value_history.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/boards/variable.h"

namespace indurop::serve::answers {
namespace {

// How values are written: as JSON, or as the bytes of the board's memory.
class ValueWriter {
 public:
  ValueWriter(const std::vector<tools::Item>& items, bool bytes) : items_(&items), bytes_(bytes) {}

  [[nodiscard]] base::Json json_of(const tools::HistoryValue& value) const {
    base::Json out = base::Json::object();
    out["time_ns"] = value.time_ns;
    if (bytes_) {
      out["bytes"] = base::in_hexadecimal(value.bytes);
    } else {
      out["value"] = tools::raw_value((*items_)[value.item].place.type, value.bytes);
    }
    return out;
  }

 private:
  const std::vector<tools::Item>* items_;
  bool bytes_;
};

Result<std::vector<tools::Item>, Reply> requested_items(const Call& call, const Board& board) {
  std::vector<std::string> names;
  for (const auto& [key, value] : call.request->query) {
    if (key == "name") {
      names.push_back(value);
    }
  }
  if (names.empty() || names.size() > tools::kMostHistoryItems) {
    return refusal(status::kBadRequest,
                   fmt::format("name says which variable or part, 1 to {} times", tools::kMostHistoryItems));
  }
  std::vector<tools::Item> items;
  std::vector<std::string> problems;
  for (const std::string& name : names) {
    if (tools::is_glob(name)) {
      problems.push_back(fmt::format("'{}' is a pattern: name each variable", name));
      continue;
    }
    for (tools::Item& item : items_named(*board.store(), board.name(), {name}, problems)) {
      items.push_back(std::move(item));
    }
  }
  if (!problems.empty()) {
    return refusal(status::kWrongValue, problems.front(), problems);
  }
  return items;
}

Result<tools::HistoryRequest, Reply> requested_history(const Call& call, std::vector<tools::Item> items) {
  const bool follow = query_value(*call.request, "follow") == "true";
  const auto from = query_number(call, "from_ns", tools::kHistoryFromNow, 0, INT64_MAX);
  const auto to = query_number(call, "to_ns", INT64_MAX, 0, INT64_MAX);
  const auto most = query_number(call, "most", 1000, 1, tools::kMostHistoryValues);
  if ((!follow && !query_value(*call.request, "from_ns")) || !from || !to || !most) {
    return refusal(status::kBadRequest, fmt::format("from_ns and to_ns are times in ns since 1970, most is 1 to {}",
                                                    tools::kMostHistoryValues));
  }
  tools::HistoryRequest request{
      std::move(items), {static_cast<std::int64_t>(*from), static_cast<std::int64_t>(*to)}, *most, {}, follow};
  if (const auto next = query_value(*call.request, "next")) {
    request.position = tools::history_position(*next, request.items.size());
    if (!request.position) {
      return refusal(status::kBadRequest, "next is the text of the page before, in a request with the same names");
    }
  }
  return request;
}

base::Json body_of(const Board& board, const tools::HistoryRequest& request, const tools::HistoryPage& page,
                   const ValueWriter& writer) {
  base::Json variables = base::Json::array();
  for (std::uint32_t item = 0; item < request.items.size(); ++item) {
    base::Json one = base::Json::object();
    one["name"] = request.items[item].name;
    one["before"] = page.before[item] ? writer.json_of(*page.before[item]) : base::Json();
    base::Json values = base::Json::array();
    for (const tools::HistoryValue& value : page.values) {
      if (value.item == item) {
        values.push_back(writer.json_of(value));
      }
    }
    one["values"] = std::move(values);
    base::Json gaps = base::Json::array();
    for (const tools::HistoryGap& gap : page.gaps) {
      if (gap.item == item) {
        gaps.push_back({{"from_ns", gap.span.begin_ns}, {"to_ns", gap.span.end_ns}});
      }
    }
    one["gaps"] = std::move(gaps);
    variables.push_back(std::move(one));
  }
  base::Json body = about(board);
  body["layout"] = board.layout();
  body["end_ns"] = page.end_ns;
  body["next"] = page.next ? base::Json(tools::to_text(*page.next)) : base::Json();
  body["variables"] = std::move(variables);
  return body;
}

}  // namespace

Reply value_history(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& board = **found;
  if (board.store() == nullptr) {
    return refusal(status::kConflict, board.no_store());
  }
  const std::string form = query_value(*call.request, "values").value_or("json");
  if (form != "json" && form != "bytes") {
    return refusal(status::kBadRequest, "values is json or bytes");
  }
  const std::string follow = query_value(*call.request, "follow").value_or("false");
  if (follow != "true" && follow != "false") {
    return refusal(status::kBadRequest, "follow is true or false");
  }
  auto items = requested_items(call, board);
  if (!items) {
    return items.error();
  }
  const auto request = requested_history(call, std::move(*items));
  if (!request) {
    return request.error();
  }
  const tools::HistoryPage page = api.history().read(board.name(), *board.store(), *request);
  return json_reply(body_of(board, *request, page, ValueWriter(request->items, form == "bytes")));
}

}  // namespace indurop::serve::answers
