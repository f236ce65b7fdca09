// SPDX-License-Identifier: Apache-2.0
// What hosts send to an edge node: the state of the primary host, the request of a rebirth, and values to set.
#include <algorithm>
#include <utility>

#include "core/rt/clock.h"
#include "doors/mqtt/sparkplug/edge_node.h"

namespace indurop::mqtt {

void EdgeNode::receive(const std::string& topic_of_message, const std::string& payload) {
  if (!settings_.primary_host.empty() && topic_of_message == "spBv1.0/STATE/" + settings_.primary_host) {
    receive_state(payload);
    return;
  }
  const auto message = decode(payload);
  const std::string devices = topic("DCMD") + "/";
  if (!message) {
    log_.warning("a message to {} is no payload of Sparkplug B", topic_of_message);
  } else if (topic_of_message == topic("NCMD")) {
    command_node(*message);
  } else if (topic_of_message.starts_with(devices)) {
    command_device(topic_of_message.substr(devices.size()), *message);
  }
}

// A state that is older than the last one is that of an earlier session of the host.
void EdgeNode::receive_state(const std::string& payload) {
  const auto json = base::Json::parse(payload);
  const auto online = json ? (*json)["online"].boolean() : std::nullopt;
  const std::int64_t time = json ? (*json)["timestamp"].integer().value_or(0) : 0;
  if (!online || time < host_time_) {
    return;
  }
  host_time_ = time;
  if (*online && state_ == State::Waiting) {
    be_born();
  } else if (!*online && state_ == State::Born) {
    log_.info("the primary host {} is offline: data are kept", settings_.primary_host);
    die();
    outlet_->reconnect();
  }
}

void EdgeNode::command_node(const Payload& payload) {
  constexpr std::int64_t kLeastNs = 1'000'000'000;  // hosts that start together may all request it
  for (const Metric& metric : payload.metrics) {
    const bool is_rebirth = metric.name == "Node Control/Rebirth";
    if (is_rebirth && metric.value == WireValue(true) && state_ == State::Born && rt::now_ns() - born_ns_ >= kLeastNs) {
      be_born();
    } else if (!is_rebirth) {
      log_.warning("the node has no metric '{}' that can be set", metric.name);
    }
  }
}

void EdgeNode::command_device(const std::string& board, const Payload& payload) {
  const auto found = devices_.find(board);
  if (found == devices_.end() || payload.metrics.empty()) {
    log_.warning("a command for board {} is refused: it is not there, or the command has no metrics", board);
    return;
  }
  const Device& device = found->second;
  Command command;
  command.board = board;
  command.reason = "Sparkplug";
  command.token = settings_.commander.token;
  command.values = base::Json::object();
  std::vector<AliasTable::Place> places;
  for (const Metric& metric : payload.metrics) {
    const auto place = device.aliases.find(metric);
    const Leaf* const leaf = place ? &device.board->variables()[place->variable].leaves[place->leaf] : nullptr;
    auto value = leaf != nullptr ? json_for(leaf->base, metric.value) : std::nullopt;
    if (!value) {
      log_.warning("a command for board {} is refused: {}", board,
                   leaf == nullptr ? "there is no metric '" + metric.name + "'" : leaf->name + " has another type");
      return;
    }
    command.values[leaf->name] = std::move(*value);
    places.push_back(*place);
  }
  command.then = [this, board, places](const CommandResult& result) {
    if (!result.done) {
      log_.warning("a command for board {} is refused: {}", board, result.answer["message"].text().value_or(""));
      publish_again(board, places);
    }
  };
  submit_(std::move(command));
}

// Shows the host the values that a refused command did not change.
void EdgeNode::publish_again(const std::string& board, const std::vector<AliasTable::Place>& places) {
  const auto found = devices_.find(board);
  if (found == devices_.end() || !found->second.born || !found->second.board->has_values()) {
    return;
  }
  Payload payload;
  for (const AliasTable::Place& place : places) {
    if (place.variable < found->second.board->variables().size() &&
        place.leaf < found->second.board->variables()[place.variable].leaves.size()) {
      payload.metrics.push_back(metric_of(found->second, place.variable, place.leaf, false));
    }
  }
  payload.timestamp_ms = payload.metrics.empty() ? std::nullopt : payload.metrics.front().timestamp_ms;
  send("DDATA", board, std::move(payload));
}

}  // namespace indurop::mqtt
