// SPDX-License-Identifier: Apache-2.0
// Births, deaths and data; commands are in edge_node_commands.cpp.
#include "doors/mqtt/sparkplug/edge_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/rt/clock.h"

namespace indurop::mqtt {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kSyncNs = 1'000'000'000;
// Boards that had kept data and are not there so long after the node's birth are given up.
constexpr std::int64_t kWaitForBoardsNs = 60'000'000'000;
constexpr std::uint64_t kBatchBytes = std::uint64_t{256} << 10U;
constexpr std::size_t kMostSentMetrics = 1'000'000;

std::uint64_t ms_of(std::int64_t ns) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0) / kNsPerMs);
}

Metric birth_metric(std::uint64_t birth, std::uint64_t now_ms) {
  Metric metric;
  metric.name = "bdSeq";
  metric.timestamp_ms = now_ms;
  metric.datatype = static_cast<std::uint32_t>(DataType::Int64);
  metric.value = birth;
  return metric;
}

}  // namespace

EdgeNode::EdgeNode(SparkplugSettings settings, Outlet& outlet, Backlog* backlog, std::function<void(Command)> submit,
                   const base::Log& log)
    : settings_(std::move(settings)), outlet_(&outlet), backlog_(backlog), submit_(std::move(submit)), log_(log) {}

Will EdgeNode::will_of(const SparkplugSettings& settings, std::uint64_t birth, std::int64_t now_ns) {
  Payload payload;
  payload.timestamp_ms = ms_of(now_ns);
  payload.metrics.push_back(birth_metric(birth, ms_of(now_ns)));
  return {fmt::format("spBv1.0/{}/NDEATH/{}", settings.group, settings.node), encode(payload), false, 1, birth};
}

std::string EdgeNode::topic(const char* kind, const std::string& device) const {
  return fmt::format("spBv1.0/{}/{}/{}{}{}", settings_.group, kind, settings_.node, device.empty() ? "" : "/", device);
}

void EdgeNode::connected(std::uint64_t birth) {
  birth_ = birth;
  state_ = State::Waiting;
  outlet_->subscribe(topic("NCMD"));
  outlet_->subscribe(topic("DCMD") + "/#");
  if (settings_.primary_host.empty()) {
    be_born();
  } else {
    outlet_->subscribe("spBv1.0/STATE/" + settings_.primary_host);
  }
}

void EdgeNode::be_born() {
  state_ = State::Born;
  born_ns_ = rt::now_ns();
  seq_ = 0;
  Payload payload;
  payload.timestamp_ms = ms_of(rt::wall_ns());
  payload.metrics.push_back(birth_metric(birth_, *payload.timestamp_ms));
  Metric rebirth;
  rebirth.name = "Node Control/Rebirth";
  rebirth.timestamp_ms = payload.timestamp_ms;
  rebirth.datatype = static_cast<std::uint32_t>(DataType::Boolean);
  rebirth.value = false;
  payload.metrics.push_back(std::move(rebirth));
  send("NBIRTH", {}, std::move(payload));
  for (auto& [name, device] : devices_) {
    device.born = false;
    publish_birth(device);
  }
}

void EdgeNode::publish_birth(Device& device) {
  if (state_ != State::Born || !device.board->is_alive() || !device.board->has_values()) {
    return;
  }
  Payload payload;
  payload.timestamp_ms = ms_of(device.board->wall_ns());
  for (std::size_t i = 0; i < device.board->variables().size(); ++i) {
    for (std::size_t leaf = 0; leaf < device.board->variables()[i].leaves.size(); ++leaf) {
      payload.metrics.push_back(metric_of(device, i, leaf, true));
    }
  }
  device.born = send("DBIRTH", device.board->name(), std::move(payload));
}

void EdgeNode::publish_death(const std::string& board) {
  Payload payload;
  payload.timestamp_ms = ms_of(rt::wall_ns());
  send("DDEATH", board, std::move(payload));
}

Metric EdgeNode::metric_of(const Device& device, std::size_t variable, std::size_t leaf, bool is_birth) const {
  const Board& board = *device.board;
  const Leaf& one = board.variables()[variable].leaves[leaf];
  Metric metric;
  metric.alias = device.aliases.alias(variable, leaf);
  metric.timestamp_ms = ms_of(board.wall_ns());
  metric.value = wire_value_of(one, board.value(variable, one));
  const std::int32_t quality = sparkplug_quality(board.quality(variable));
  if (is_birth) {
    metric.name = metric_name(one.name);
    metric.datatype = static_cast<std::uint32_t>(data_type_of(one.base));
    metric.unit = one.unit;
    metric.quality = quality;
  }
  return metric;
}

bool EdgeNode::send(const char* kind, const std::string& device, Payload payload) {
  payload.seq = seq_;
  if (!outlet_->publish(topic(kind, device), encode(payload), Retain::No)) {
    return false;
  }
  ++seq_;  // after 255 follows 0
  return true;
}

void EdgeNode::board_is_there(const Board& board) {
  const AliasTable aliases(board, next_alias_);
  next_alias_ = aliases.end();
  Device& device = devices_.insert_or_assign(board.name(), Device{&board, aliases, false}).first->second;
  if (backlog_ != nullptr) {
    Payload names;
    for (std::size_t i = 0; i < board.variables().size(); ++i) {
      for (std::size_t leaf = 0; leaf < board.variables()[i].leaves.size(); ++leaf) {
        Metric metric;
        metric.name = metric_name(board.variables()[i].leaves[leaf].name);
        metric.alias = aliases.alias(i, leaf);
        names.metrics.push_back(std::move(metric));
      }
    }
    backlog_->set_names(board.name(), names);
  }
  publish_birth(device);
}

void EdgeNode::board_is_gone(const std::string& board) {
  const auto found = devices_.find(board);
  if (found == devices_.end()) {
    return;
  }
  if (found->second.born && state_ == State::Born) {
    publish_death(board);
  }
  devices_.erase(found);
}

void EdgeNode::changed(const Board& board, const std::vector<Change>& changes) {
  const auto found = devices_.find(board.name());
  if (found == devices_.end()) {
    return;
  }
  Device& device = found->second;
  if (!board.is_alive()) {
    if (device.born && state_ == State::Born) {
      publish_death(board.name());
    }
    device.born = false;
    return;
  }
  if (state_ == State::Born && !device.born) {
    publish_birth(device);
    return;
  }
  Payload payload;
  payload.timestamp_ms = ms_of(board.wall_ns());
  for (const Change& change : changes) {
    for (const std::size_t leaf : change.leaves) {
      payload.metrics.push_back(metric_of(device, change.variable, leaf, false));
      if (change.quality) {
        payload.metrics.back().quality = sparkplug_quality(board.quality(change.variable));
      }
    }
  }
  if (payload.metrics.empty()) {
    return;
  }
  if (state_ != State::Born || !send("DDATA", board.name(), payload)) {
    keep(board.name(), payload);
    return;
  }
  if (backlog_ != nullptr) {
    sent_metrics_ += payload.metrics.size();
    sent_.push_back({board.name(), std::move(payload)});
  }
}

void EdgeNode::keep(const std::string& board, const Payload& payload) {
  if (backlog_ == nullptr) {
    return;
  }
  Payload kept = payload;
  for (Metric& metric : kept.metrics) {
    metric.timestamp_ms.reset();  // that of the payload
  }
  const std::string problem = backlog_->add(board, kept);
  if (!problem.empty() && problem != noted_problem_) {
    log_.error("data of board {} are lost: {}", board, problem);
  }
  noted_problem_ = problem;
}

// What was sent and not confirmed may not have arrived.
void EdgeNode::lost() {
  state_ = State::Offline;
  receipt_ = {};
  for (const Sent& one : sent_) {
    keep(one.board, one.payload);
  }
  sent_.clear();
  sent_metrics_ = 0;
  for (auto& [name, device] : devices_) {
    device.born = false;
  }
  if (backlog_ != nullptr) {
    backlog_->rewind();
  }
}

void EdgeNode::tick(std::int64_t now_ns) {
  if (backlog_ == nullptr) {
    return;
  }
  if (now_ns - synced_ns_ > kSyncNs) {
    synced_ns_ = now_ns;
    backlog_->sync();
    note_lost();
  }
  if (state_ == State::Born && sent_metrics_ > kMostSentMetrics) {
    log_.warning("the broker does not confirm what it receives; the connection is made again");
    die();
    outlet_->reconnect();
  }
  if (state_ != State::Born || receipt_.id != 0) {
    return;
  }
  receipt_.stored.reset();
  if (send_kept(now_ns) || !sent_.empty()) {
    receipt_.sent = sent_.size();
    receipt_.id = outlet_->request_receipt();
  }
}

void EdgeNode::note_lost() {
  constexpr std::uint64_t kMega = 1'000'000;
  if (backlog_->lost_bytes() > noted_lost_) {
    log_.warning("the store is full: {:.1f} MB of the oldest data are gone",
                 static_cast<double>(backlog_->lost_bytes() - noted_lost_) / static_cast<double>(kMega));
    noted_lost_ = backlog_->lost_bytes();
  }
}

bool EdgeNode::can_send(const Backlog::Stored& stored) const {
  const auto device = devices_.find(stored.board);
  return device != devices_.end() && device->second.born;
}

bool EdgeNode::send_kept(std::int64_t now_ns) {
  if (backlog_->is_empty()) {
    return false;
  }
  const bool waits = now_ns - born_ns_ < kWaitForBoardsNs;
  const auto batch = backlog_->read(kBatchBytes);
  if (batch.empty()) {
    backlog_->commit(backlog_->position());  // nothing was left but names
  }
  for (const Backlog::Stored& one : batch) {
    if (!can_send(one)) {
      if (waits) {
        backlog_->seek(one.begin);
        break;
      }
      if (noted_missing_ != one.board) {
        log_.warning("data of board {} are given up: it is not there", one.board);
        noted_missing_ = one.board;
      }
      receipt_.stored = one.end;
      continue;
    }
    const Device& device = devices_.find(one.board)->second;
    Payload payload = one.payload;
    std::erase_if(payload.metrics, [&device](const Metric& metric) { return !device.aliases.find(metric); });
    if (!payload.metrics.empty() && !send("DDATA", one.board, std::move(payload))) {
      backlog_->seek(one.begin);
      break;
    }
    receipt_.stored = one.end;
  }
  return receipt_.stored.has_value();
}

void EdgeNode::confirmed(int receipt) {
  if (receipt != receipt_.id || receipt == 0) {
    return;
  }
  for (std::size_t i = 0; i < receipt_.sent && !sent_.empty(); ++i) {
    sent_metrics_ -= sent_.front().payload.metrics.size();
    sent_.pop_front();
  }
  if (receipt_.stored) {
    backlog_->commit(*receipt_.stored);
  }
  receipt_ = {};
  tick(rt::now_ns());
}

void EdgeNode::die() {
  if (state_ != State::Offline) {
    const Will will = will_of(settings_, birth_, rt::wall_ns());
    outlet_->publish(will.topic, will.payload, Retain::No);
  }
  lost();
}

}  // namespace indurop::mqtt
