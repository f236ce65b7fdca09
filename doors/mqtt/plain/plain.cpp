// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/plain/plain.h"

#include <fmt/format.h>

#include <algorithm>

#include "doors/mqtt/plain/topics.h"

namespace indurop::mqtt {

void Plain::connected(const std::vector<const Board*>& boards) {
  outlet_->subscribe(settings_.prefix + "/+/set/#");
  outlet_->publish(status_topic(), "true", Retain::Yes);
  for (const Board* const board : boards) {
    publish_state(board->name(), board->is_alive());
    for (std::size_t i = 0; board->has_values() && i < board->variables().size(); ++i) {
      publish_value(*board, i);
    }
  }
}

void Plain::publish_state(const std::string& board, bool alive) {
  outlet_->publish(fmt::format("{}/{}/alive", settings_.prefix, board), alive ? "true" : "false", Retain::Yes);
}

std::string Plain::topic_of(const std::string& board, const std::string& variable) const {
  return fmt::format("{}/{}/values/{}", settings_.prefix, board, levels_of(variable));
}

void Plain::publish(const Board& board, const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    publish_value(board, change.variable);
  }
}

void Plain::publish_value(const Board& board, std::size_t variable) {
  const Variable& one = board.variables()[variable];
  const std::string payload =
      fmt::format(R"({{"value":{},"unit":{},"quality":"{}","forced":{},"time_ns":{},"wall_ns":{}}})",
                  schema::value_to_json(one.type, board.value(variable)), base::Json(one.unit).dump(),
                  word_of(board.quality(variable)), board.is_forced(variable), board.time_ns(), board.wall_ns());
  outlet_->publish(topic_of(board.name(), one.name), payload, settings_.retain);
}

void Plain::forget(const Board& board) {
  for (const Variable& variable : board.variables()) {
    if (settings_.retain == Retain::Yes) {
      outlet_->publish(topic_of(board.name(), variable.name), "", Retain::Yes);
    }
  }
}

void Plain::receive(const std::string& topic, const std::string& payload, bool retained) {
  const auto to = read_set_topic(settings_.prefix, topic);
  if (!to) {
    return;
  }
  const auto json = base::Json::parse(payload);
  base::Json id = json && to->variable.empty() ? (*json)["id"] : base::Json();
  const auto refuse = [&](const char* error, const std::string& message) {
    answer(to->board, to->user, id, refused_command(error, message));
  };
  if (retained) {  // it would be executed again with each connection
    refuse("bad_request", "commands must not be retained");
    return;
  }
  Command command;
  command.board = to->board;
  command.reason = "MQTT";
  if (!to->variable.empty()) {
    command.values = base::Json::object();
    command.values[to->variable] = json ? *json : base::Json(payload);
  } else if (json && (*json)["values"].is_object()) {
    command.values = (*json)["values"];
    command.reason = (*json)["reason"].text().value_or(command.reason);
  } else {
    refuse("bad_request", "a command is a JSON object with values, an object of NAME: value");
    return;
  }
  const auto user = std::find_if(settings_.users.begin(), settings_.users.end(),
                                 [&to](const UserToken& one) { return one.user == to->user; });
  if (user == settings_.users.end()) {
    refuse("forbidden", fmt::format("there is no token of user {}", to->user));
    return;
  }
  command.token = user->token;
  command.then = [this, board = to->board, user = to->user, id](const CommandResult& result) {
    answer(board, user, id, result);
  };
  submit_(std::move(command));
}

void Plain::answer(const std::string& board, const std::string& user, const base::Json& id,
                   const CommandResult& result) {
  base::Json out{{"id", id}, {"done", result.done}};
  out.update(result.answer);
  outlet_->publish(fmt::format("{}/{}/answer/{}", settings_.prefix, board, user), out.dump(), Retain::No);
}

}  // namespace indurop::mqtt
