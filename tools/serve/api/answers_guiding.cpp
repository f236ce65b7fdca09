// SPDX-License-Identifier: Apache-2.0
// Answers about paths along which a hand guided a robot, and the jobs that are written of them. The guiding itself is a
// jog (answers_jog.cpp).
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "control/robot/files/teach.h"
#include "store/operate/set.h"
#include "tools/client/robot/robot_desk.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/jog/guided_path.h"
#include "tools/serve/jog/jog_desk.h"

namespace indurop::serve::answers {
namespace {

// The body of a request to write a job.
struct JobRequest {
  std::string robot;  // namespace of its variables
  std::string reason;
  robot::PathOrder path;
};

std::optional<JobRequest> job_request_in(const Call& call) {
  const auto json = base::Json::parse(call.request->body);
  JobRequest out;
  if (!json || !base::read(*json, "job", out.path.job)) {
    return std::nullopt;
  }
  base::read(*json, "robot", out.robot);
  base::read(*json, "reason", out.reason);
  for (const auto& [name, to] :
       {std::pair("within", &out.path.tolerance), {"turned", &out.path.turn_tolerance}, {"speed", &out.path.speed}}) {
    const base::Json& value = (*json)[name];
    if (value.number()) {
      *to = *value.number();
    } else if (!value.is_null()) {
      return std::nullopt;
    }
  }
  return out;
}

std::string problem_of_path(const robot::TaughtPath& taught) {
  return !taught.problem.empty() || taught.errors.empty() ? taught.problem : base::to_string(taught.errors.front());
}

}  // namespace

Reply guided_path(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto path = api.jogs().guided_path((*found)->name(), query_value(*call.request, "robot").value_or("PLC_ROBOT"));
  const GuidedPath::View view = path ? path->view() : GuidedPath::View{};
  base::Json body = about(**found);
  body["records"] = view.records;
  body["guided"] = view.guided;
  body["places"] = view.places;
  body["marks"] = view.marks;
  body["length"] = view.length;
  body["tool"] = view.tool;
  body["problem"] = view.problem;
  return json_reply(body);
}

Reply write_guided_path(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "write guided path");
  auto wanted = job_request_in(call);
  if (!wanted) {
    return write.failed(status::kBadRequest, "job is needed, and within, turned and speed are numbers");
  }
  write.about(wanted->robot + " " + wanted->path.job, wanted->reason);
  const auto path = api.jogs().guided_path((*found)->name(), wanted->robot);
  if (!path || path->view().places == 0) {
    return write.failed(status::kConflict, "this server has recorded no path of this robot: guide it first");
  }
  if (const auto locked = operate::refusal((*found)->name(), vars::Act::Command)) {
    return write.failed(*locked);
  }
  tools::RobotChoice choice;
  choice.module = call.part.find("module")->second;
  const auto files = tools::files_of_node((*found)->name(), choice, true);
  if (!files) {
    return write.failed(status::kConflict, files.error().text);
  }
  if (const auto unlogged = write.begin({{}, true})) {
    return write.failed(*unlogged);
  }
  wanted->path.tool = path->view().tool;
  const robot::TaughtPath taught = robot::teach_path(files->names, wanted->path, path->places());
  if (const std::string problem = problem_of_path(taught); !problem.empty()) {
    return write.failed(status::kConflict, problem);
  }
  base::Json body = about(**found);
  body["file"] = taught.file;
  body["text"] = taught.text;
  body["points"] = taught.points;
  body["length"] = taught.length;
  body["deviation"] = taught.deviation;
  body["turn_deviation"] = taught.turn_deviation;
  body["is_read"] = taught.is_read;
  return write.done(body);
}

}  // namespace indurop::serve::answers
