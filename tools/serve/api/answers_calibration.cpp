// SPDX-License-Identifier: Apache-2.0
// Answers about calibrations of robots: points are taken from their current positions, and results are declared in
// their files.
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/robot/files/calibrate.h"
#include "store/operate/set.h"
#include "tools/client/robot/robot_desk.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

using robot::Calibration;

// What the address names.
struct Chosen {
  tools::RobotChoice robot;
  robot::CalibrationOrder order;
};

std::optional<Chosen> chosen_in(const Call& call) {
  const auto kind = robot::calibration_kind(call.part.find("kind")->second);
  if (!kind) {
    return std::nullopt;
  }
  Chosen out;
  out.robot.module = call.part.find("module")->second;
  out.order.kind = *kind;
  out.order.name = call.part.find("name")->second;
  return out;
}

void add_calibration(base::Json& body, const Calibration& now) {
  base::Json points = base::Json::array();
  for (const robot::CalibrationPoint& one : now.points) {
    points.push_back({{"mark", one.mark},
                      {"place", one.place},
                      {"seen", one.seen},
                      {"off", one.off ? base::Json(*one.off) : base::Json()}});
  }
  body["points"] = std::move(points);
  body["wrong"] = now.wrong;
  body["next"] = now.next;
  body["next_mark"] = now.next_mark;
  body["declaration"] = now.declaration;
  body["before"] = now.before;
  body["rms"] = now.rms;
  body["most"] = now.most;
  body["worst"] = now.worst;
  body["sigma"] = now.sigma;
  body["spare"] = now.spare;
  body["turned"] = now.turned;
  body["place_deviation"] = list_of(now.place_deviation);
  body["turn_deviation"] = list_of(now.turn_deviation);
  body["scale"] = now.scale;
}

std::string problem_of(const Calibration& now) {
  if (!now.problem.empty() || now.errors.empty()) {
    return now.problem;
  }
  const base::Diagnostic& first = now.errors.front();
  return first.file + ":" + std::to_string(first.place.line) + ": " + first.text;
}

// The body of a change.
struct Change {
  std::string robot;  // namespace of its variables
  std::string reason;
  robot::TakenPoint taken;
  std::uint64_t point = 0;  // to drop; 0: all
};

std::optional<Change> change_in(const Call& call) {
  const auto json = base::Json::parse(call.request->body.empty() ? "{}" : call.request->body);
  if (!json || !json->is_object()) {
    return std::nullopt;
  }
  Change out;
  base::read(*json, "robot", out.robot);
  base::read(*json, "reason", out.reason);
  base::read(*json, "mark", out.taken.mark);
  base::read(*json, "point", out.point);
  for (const base::Json& one : (*json)["seen"].values()) {
    if (!one.number()) {
      return std::nullopt;
    }
    out.taken.seen.push_back(*one.number());
  }
  return out;
}

// Does what every change has in common. `act` returns the calibration after it, or why not.
template <class Act>
Reply change(Api& api, const Call& call, const char* action, Act act) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, action);
  const auto chosen = chosen_in(call);
  const auto wanted = change_in(call);
  if (!chosen || !wanted) {
    return write.failed(chosen ? status::kBadRequest : status::kNotFound,
                        chosen ? "the body is no JSON object with numbers in seen" : "there is no such calibration");
  }
  write.about(std::string(robot::word_of(chosen->order.kind)) + " " + chosen->order.name, wanted->reason);
  if (const auto locked = operate::refusal((*found)->name(), vars::Act::Command)) {
    return write.failed(*locked);
  }
  const auto files = tools::files_of_node((*found)->name(), chosen->robot, true);
  if (!files) {
    return write.failed(status::kConflict, files.error().text);
  }
  if (const auto unlogged = write.begin({{}, true})) {
    return write.failed(*unlogged);
  }
  const Calibration now = act(**found, files->names, chosen->order, *wanted);
  if (const std::string problem = problem_of(now); !problem.empty()) {
    return write.failed(status::kConflict, problem);
  }
  base::Json body = about(**found);
  add_calibration(body, now);
  return write.done(body);
}

Calibration take(const Board& board, const robot::FileNames& names, const robot::CalibrationOrder& order,
                 const Change& wanted) {
  Calibration refused;
  if (board.store() == nullptr || !board.alive()) {
    refused.problem = "the board does not run";
    return refused;
  }
  const auto place = tools::read_place(*board.store(), wanted.robot);
  if (!place || place->moves) {
    refused.problem = place ? "the robot moves: take points at standstill" : place.error().text;
    return refused;
  }
  robot::TakenPoint taken = wanted.taken;
  taken.tool = place->tool;
  return robot::take_point(names, order, taken, place->stand);
}

}  // namespace

Reply calibration(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto chosen = chosen_in(call);
  if (!chosen) {
    return refusal(status::kNotFound, "there is no such calibration: tool, frame, camera or hand-camera");
  }
  const auto files = tools::files_of_node((*found)->name(), chosen->robot, false);
  if (!files) {
    return refusal(status::kConflict, files.error().text);
  }
  const Calibration now = robot::show_calibration(files->names, chosen->order);
  if (const std::string problem = problem_of(now); !problem.empty()) {
    return refusal(status::kConflict, problem);
  }
  base::Json body = about(**found);
  add_calibration(body, now);
  return json_reply(body);
}

Reply take_calibration_point(Api& api, const Call& call) {
  return change(api, call, "take calibration point", &take);
}

Reply drop_calibration_point(Api& api, const Call& call) {
  return change(api, call, "drop calibration point",
                [](const Board& /*board*/, const robot::FileNames& names, const robot::CalibrationOrder& order,
                   const Change& wanted) { return robot::drop_point(names, order, wanted.point); });
}

Reply accept_calibration(Api& api, const Call& call) {
  return change(api, call, "accept calibration",
                [](const Board& /*board*/, const robot::FileNames& names, const robot::CalibrationOrder& order,
                   const Change& /*wanted*/) { return robot::accept_calibration(names, order); });
}

}  // namespace indurop::serve::answers
