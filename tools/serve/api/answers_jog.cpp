// SPDX-License-Identifier: Apache-2.0
// Answers about remote jogging of robots.
#include <utility>

#include "store/operate/set.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/jog/jog_desk.h"

namespace indurop::serve::answers {
namespace {

template <class What>
Reply about_hand(const Call& call, What what) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& name = call.part.find("jog")->second;
  if (!what((*found)->name(), name)) {
    return refusal(status::kNotFound,
                   "this jog has ended: it was not renewed in time, you may no longer jog the robot, its board has "
                   "ended or is locked, or another client has written ROBOT_JOG");
  }
  base::Json body = about(**found);
  body["jog"] = name;
  return json_reply(body);
}

}  // namespace

Reply begin_jog(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "jog");
  const auto json = base::Json::parse(call.request->body);
  JogRequest jog;
  std::string robot;
  bool sound = json && base::read(*json, "frame", jog.frame) && base::read(*json, "robot", robot);
  for (const base::Json& one : sound ? (*json)["speed"].values() : std::span<const base::Json>()) {
    sound = sound && one.number().has_value();
    jog.speed.push_back(one.number().value_or(0));
  }
  if (!sound || (jog.speed.empty() && jog.frame != "hand")) {
    return write.failed(status::kBadRequest, "robot, frame and speed are needed; for the frame hand no speed");
  }
  write.about(call.request->body, "");
  if (!(*found)->alive()) {
    return write.failed(status::kConflict, "the board does not run");
  }
  if (const auto locked = operate::refusal((*found)->name(), vars::Act::Command)) {
    return write.failed(*locked);
  }
  if (const auto unlogged = write.begin({{robot.empty() ? "ROBOT_JOG" : robot + "::ROBOT_JOG"}})) {
    return write.failed(*unlogged);
  }
  auto begun = api.jogs().begin((*found)->name(), robot, call.who, call.request->from, jog);
  if (!begun) {
    return write.failed(status::kConflict, begun.error().text);
  }
  base::Json body = about(**found);
  body["jog"] = *begun;
  body["keep_ns"] = jog.frame == "hand" ? JogDesk::kKeepByHandNs : JogDesk::kKeepNs;
  return json_reply(body);
}

Reply keep_jog(Api& api, const Call& call) {
  const auto found = board_of(call);
  const bool alive = found && (*found)->alive();
  return about_hand(call, [&](const std::string& board, const std::string& name) {
    return alive && api.jogs().keep(board, name, call.request->client);
  });
}

Reply end_jog(Api& api, const Call& call) {
  return about_hand(
      call, [&](const std::string& board, const std::string& name) { return api.jogs().end(board, name, call.who); });
}

}  // namespace indurop::serve::answers
