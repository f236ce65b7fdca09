// SPDX-License-Identifier: Apache-2.0
#include "store/operate/reload.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/rt/file_lock.h"
#include "store/operate/node_json.h"
#include "store/vars/retain.h"

namespace indurop::operate {
namespace {

using base::Json;

constexpr const char* kRequestFile = "reload.request";
constexpr const char* kReportFile = "reload.report";

Json json_of_plan(const ReloadPlan& plan) {
  return {{"compared", plan.compared},   {"with_state", plan.with_state},
          {"why_not", plan.why_not},     {"bytes", plan.bytes},
          {"kept", plan.kept},           {"grown", plan.grown},
          {"added", plan.added},         {"removed", plan.removed},
          {"changed", plan.changed},     {"appeared", plan.appeared},
          {"converted", plan.converted}, {"lost", plan.lost}};
}

ReloadPlan plan_of(const Json& json) {
  ReloadPlan plan;
  base::read(json, "compared", plan.compared);
  base::read(json, "with_state", plan.with_state);
  base::read(json, "why_not", plan.why_not);
  base::read(json, "bytes", plan.bytes);
  base::read(json, "kept", plan.kept);
  base::read(json, "grown", plan.grown);
  base::read(json, "added", plan.added);
  base::read(json, "removed", plan.removed);
  base::read(json, "changed", plan.changed);
  base::read(json, "appeared", plan.appeared);
  base::read(json, "converted", plan.converted);
  base::read(json, "lost", plan.lost);
  return plan;
}

}  // namespace

Json json_of(const ReloadRequest& request) {
  return {{"file", request.file},
          {"lossy", request.lossy},
          {"dry_run", request.dry_run},
          {"health_ns", request.health_ns},
          {"guard", request.guard}};
}

ReloadRequest request_of(const Json& json) {
  ReloadRequest request;
  base::read(json, "file", request.file);
  base::read(json, "lossy", request.lossy);
  base::read(json, "dry_run", request.dry_run);
  base::read(json, "health_ns", request.health_ns);
  base::read(json, "guard", request.guard);
  return request;
}

Status write_request(const std::string& node, const ReloadRequest& request) {
  return write_json(node, kRequestFile, json_of(request));
}

std::optional<ReloadRequest> take_reload_request(const std::string& node) {
  const auto json = take_json(node, kRequestFile);
  return json ? std::optional(request_of(*json)) : std::nullopt;
}

Status write_report(const std::string& node, const ReloadReport& report) {
  return write_json(node, kReportFile, json_of(report));
}

std::optional<ReloadReport> read_report(const std::string& node) {
  const auto json = read_json(node, kReportFile);
  return json ? std::optional(report_of(*json)) : std::nullopt;
}

ReloadReport report_of(const Json& json) {
  ReloadReport report;
  base::read(json, "module", report.module);
  base::read(json, "text", report.text);
  base::read(json, "errors", report.errors);
  base::read(json, "needs_restart", report.needs_restart);
  report.plan = plan_of(json["plan"]);
  base::read(json, "from", report.from);
  base::read(json, "to", report.to);
  base::read(json, "version", report.version);
  base::read(json, "tick", report.tick);
  base::read(json, "left_out", report.left_out);
  base::read(json, "copying_ns", report.copying_ns);
  base::read(json, "response_ns", report.response_ns);
  return report;
}

Json json_of(const ReloadReport& report) {
  return {{"module", report.module},
          {"text", report.text},
          {"errors", report.errors},
          {"needs_restart", report.needs_restart},
          {"plan", json_of_plan(report.plan)},
          {"from", report.from},
          {"to", report.to},
          {"version", report.version},
          {"tick", report.tick},
          {"left_out", report.left_out},
          {"copying_ns", report.copying_ns},
          {"response_ns", report.response_ns}};
}

Result<ReloadLock> ReloadLock::acquire(const std::string& node) {
  const std::filesystem::path path = vars::state_directory(node) / "reload.lock";
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  constexpr mode_t kMode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP;
  base::Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode));
  if (!file.is_open()) {
    return Error{Errc::System, errno, "folder of the node"};
  }
  if (const Status locked = rt::lock_file(file.get(), rt::FileLock::Exclusive); !locked) {
    return locked.error();
  }
  return ReloadLock(std::move(file));
}

}  // namespace indurop::operate
