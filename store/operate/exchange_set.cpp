// SPDX-License-Identifier: Apache-2.0
#include "store/operate/exchange_set.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "store/operate/node_json.h"

namespace indurop::operate {
namespace {

using base::Json;

constexpr const char* kSetRequestFile = "exchange.request";
constexpr const char* kSetReportFile = "exchange.report";

struct ActWord {
  SetRequest::Act act;
  std::string_view word;
};
constexpr std::array kActWords{
    ActWord{SetRequest::Act::Compare, "compare"}, ActWord{SetRequest::Act::Prepare, "prepare"},
    ActWord{SetRequest::Act::Exchange, "exchange"}, ActWord{SetRequest::Act::Decide, "decide"}};

struct StateWord {
  SetReport::State state;
  std::string_view word;
};
constexpr std::array kStateWords{
    StateWord{SetReport::State::None, "none"},         StateWord{SetReport::State::Preparing, "preparing"},
    StateWord{SetReport::State::Compared, "compared"}, StateWord{SetReport::State::Ready, "ready"},
    StateWord{SetReport::State::Waiting, "waiting"},   StateWord{SetReport::State::Exchanged, "exchanged"},
    StateWord{SetReport::State::Leaving, "leaving"},   StateWord{SetReport::State::Undone, "undone"},
    StateWord{SetReport::State::Stuck, "stuck"}};

std::optional<SetRequest> set_request_of(const Json& json) {
  std::string word;
  base::read(json, "act", word);
  const auto* const found =
      std::find_if(kActWords.begin(), kActWords.end(), [&](const ActWord& one) { return one.word == word; });
  if (found == kActWords.end()) {
    return std::nullopt;
  }
  SetRequest request;
  request.act = found->act;
  base::read(json, "deployment", request.deployment);
  base::read(json, "tick", request.tick);
  base::read(json, "config", request.config);
  for (const Json& module : json["modules"].values()) {
    SetRequest::Module& one = request.modules.emplace_back();
    base::read(module, "name", one.name);
    base::read(module, "file", one.file);
  }
  return request;
}

}  // namespace

Status write_set_request(const std::string& node, const SetRequest& request) {
  Json modules = Json::array();
  for (const SetRequest::Module& module : request.modules) {
    modules.push_back({{"name", module.name}, {"file", module.file}});
  }
  const auto* const found =
      std::find_if(kActWords.begin(), kActWords.end(), [&](const ActWord& one) { return one.act == request.act; });
  return write_json(node, kSetRequestFile,
                    {{"act", found->word},
                     {"deployment", request.deployment},
                     {"tick", request.tick},
                     {"config", request.config},
                     {"modules", std::move(modules)}});
}

std::optional<SetRequest> take_set_request(const std::string& node) {
  const auto json = take_json(node, kSetRequestFile);
  return json ? set_request_of(*json) : std::nullopt;
}

Status write_set_report(const std::string& node, const SetReport& report) {
  Json modules = Json::array();
  for (const ReloadReport& module : report.modules) {
    modules.push_back(json_of(module));
  }
  const auto* const found = std::find_if(kStateWords.begin(), kStateWords.end(),
                                         [&](const StateWord& one) { return one.state == report.state; });
  return write_json(node, kSetReportFile,
                    {{"state", found->word},
                     {"node_pid", report.node_pid},
                     {"problem", report.problem},
                     {"refused", report.refused},
                     {"needs_restart", report.needs_restart},
                     {"modules", std::move(modules)},
                     {"schedule", json_of(report.schedule)},
                     {"schedule_tick", report.schedule_tick},
                     {"grid_ticks", report.grid_ticks},
                     {"grid_begin", report.grid_begin}});
}

std::optional<SetReport> read_set_report(const std::string& node) {
  const auto json = read_json(node, kSetReportFile);
  if (!json) {
    return std::nullopt;
  }
  SetReport report;
  std::string word;
  std::int64_t pid = 0;
  base::read(*json, "state", word);
  const auto* const found =
      std::find_if(kStateWords.begin(), kStateWords.end(), [&](const StateWord& one) { return one.word == word; });
  if (found == kStateWords.end() || !base::read(*json, "node_pid", pid)) {
    return std::nullopt;
  }
  report.state = found->state;
  report.node_pid = static_cast<std::int32_t>(pid);
  base::read(*json, "problem", report.problem);
  base::read(*json, "refused", report.refused);
  base::read(*json, "needs_restart", report.needs_restart);
  for (const Json& module : (*json)["modules"].values()) {
    report.modules.push_back(report_of(module));
  }
  report.schedule = fates_of((*json)["schedule"]);
  base::read(*json, "schedule_tick", report.schedule_tick);
  base::read(*json, "grid_ticks", report.grid_ticks);
  base::read(*json, "grid_begin", report.grid_begin);
  return report;
}

}  // namespace indurop::operate
