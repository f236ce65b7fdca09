// SPDX-License-Identifier: Apache-2.0
#include "store/operate/schedule_request.h"

#include "store/operate/node_json.h"

namespace indurop::operate {
namespace {

using base::Json;

constexpr const char* kScheduleRequestFile = "schedule.request";
constexpr const char* kScheduleReportFile = "schedule.report";

}  // namespace

Status write_schedule_request(const std::string& node, const ScheduleRequest& request) {
  return write_json(node, kScheduleRequestFile,
                    {{"config", request.config}, {"back", request.back}, {"dry_run", request.dry_run}});
}

std::optional<ScheduleRequest> take_schedule_request(const std::string& node) {
  const auto json = take_json(node, kScheduleRequestFile);
  if (!json) {
    return std::nullopt;
  }
  ScheduleRequest request;
  base::read(*json, "config", request.config);
  base::read(*json, "back", request.back);
  base::read(*json, "dry_run", request.dry_run);
  return request;
}

Json json_of(const std::vector<ScheduleReport::Module>& modules) {
  Json list = Json::array();
  for (const ScheduleReport::Module& module : modules) {
    list.push_back({{"name", module.name}, {"fate", module.fate}, {"text", module.text}});
  }
  return list;
}

std::vector<ScheduleReport::Module> fates_of(const Json& json) {
  std::vector<ScheduleReport::Module> modules;
  for (const Json& module : json.values()) {
    ScheduleReport::Module& one = modules.emplace_back();
    base::read(module, "name", one.name);
    base::read(module, "fate", one.fate);
    base::read(module, "text", one.text);
  }
  return modules;
}

Json json_of(const ScheduleReport& report) {
  return {{"text", report.text},         {"messages", report.messages}, {"modules", json_of(report.modules)},
          {"restarts", report.restarts}, {"schedule", report.schedule}, {"tick", report.tick}};
}

Status write_schedule_report(const std::string& node, const ScheduleReport& report) {
  return write_json(node, kScheduleReportFile, json_of(report));
}

std::optional<ScheduleReport> read_schedule_report(const std::string& node) {
  const auto json = read_json(node, kScheduleReportFile);
  if (!json) {
    return std::nullopt;
  }
  ScheduleReport report;
  base::read(*json, "text", report.text);
  base::read(*json, "messages", report.messages);
  report.modules = fates_of((*json)["modules"]);
  base::read(*json, "restarts", report.restarts);
  base::read(*json, "schedule", report.schedule);
  base::read(*json, "tick", report.tick);
  return report;
}

}  // namespace indurop::operate
