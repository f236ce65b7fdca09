// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/segment.h"

#include <algorithm>
#include <utility>

namespace indurop::io::ethercat {

namespace {
constexpr std::array<std::size_t, 3> kOrder{3, 1, 2};  // of ports through which a frame leaves a slave
constexpr std::size_t kSourceByte = 6;
constexpr std::uint8_t kLocallyGiven = 0x02;  // the first slave sets this bit of the source address

std::size_t turn_of(std::size_t port) noexcept {
  return static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), port) - kOrder.begin());
}

}  // namespace

bool Segment::can_add(Outlet outlet) const noexcept {
  if (is_ring_ || outlet.slave >= nodes_.size() || outlet.port == 0 || outlet.port >= kPorts) {
    return false;
  }
  // The frame is on its way back from the slave that was added last: it has left behind it what comes before in kOrder.
  std::size_t from = kNone;
  std::size_t slave = nodes_.size() - 1;
  while (slave != outlet.slave) {
    from = std::exchange(slave, nodes_[slave].parent);
    if (slave == kNone) {
      return false;
    }
  }
  return from == kNone || turn_of(outlet.port) > turn_of(nodes_[from].port);
}

Slave& Segment::add(SlaveConfig config, Slave::Application application) {
  return add_at(std::move(config), std::move(application), nodes_.empty() ? kNone : nodes_.size() - 1, 1);
}

Slave& Segment::add(SlaveConfig config, Slave::Application application, Outlet outlet) {
  return add_at(std::move(config), std::move(application), outlet.slave, outlet.port);
}

Slave& Segment::add_at(SlaveConfig config, Slave::Application application, std::size_t parent, std::size_t port) {
  if (parent != kNone) {
    nodes_[parent].behind[port] = nodes_.size();
  }
  nodes_.push_back({parent, port});
  slaves_.emplace_back(std::move(config), std::move(application));
  is_cut_.push_back(false);
  link();
  return slaves_.back();
}

void Segment::set_power(std::size_t index, bool on) {
  slaves_[index].set_power(on);
  link();
}

void Segment::make_ring() {
  is_ring_ = true;
  link();
}

void Segment::set_cable(std::size_t before, bool whole) {
  is_cut_[before] = !whole;
  link();
}

bool Segment::is_linked(std::size_t before) const noexcept {
  if (before == slaves_.size()) {
    return is_ring_ && (slaves_.empty() || slaves_.back().is_on()) && !is_cut_[before];
  }
  const std::size_t parent = nodes_[before].parent;
  return (parent == kNone || slaves_[parent].is_on()) && slaves_[before].is_on() && !is_cut_[before];
}

void Segment::link() noexcept {
  for (std::size_t i = slaves_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.reached = 1;
    std::array<bool, kPorts> open{is_linked(i)};
    for (std::size_t port = 1; port < kPorts; ++port) {
      if (leads_on(node, port)) {
        open[port] = true;
        node.reached += nodes_[node.behind[port]].reached;
      }
    }
    if (i + 1 == slaves_.size() && is_linked(i + 1)) {
      open[1] = true;
    }
    slaves_[i].set_ports(open);
  }
}

void Segment::pass_branch(std::span<std::uint8_t> frame, Time now, std::size_t slave) {
  const Node& node = nodes_[slave];
  Returns returns;
  std::array<Time, kPorts> left{};
  Time at = now;
  for (const std::size_t port : kOrder) {
    left[port] = at;
    if (leads_on(node, port)) {
      at += 2 * static_cast<std::int64_t>(nodes_[node.behind[port]].reached) * delay_;
      returns[port] = at;
    }
  }
  slaves_[slave].process(frame, now, returns);
  for (const std::size_t port : kOrder) {
    if (returns[port]) {
      pass_branch(frame, left[port] + delay_, node.behind[port]);
    }
  }
}

// Through all slaves from this one on, out of the last one.
Time Segment::pass_line(std::span<std::uint8_t> frame, Time now, std::size_t begin) {
  for (std::size_t i = begin; i < slaves_.size(); ++i) {
    now += delay_;
    slaves_[i].process(frame, now, {std::nullopt, now});
  }
  return now + delay_;
}

std::optional<Segment::Passed> Segment::pass(std::span<std::uint8_t> frame, Time now, End from) {
  if (FrameReader(frame).fault() != FrameFault::None) {
    return std::nullopt;
  }
  const std::size_t count = slaves_.size();
  const std::size_t first = count > 0 && is_linked(0) ? nodes_[0].reached : 0;  // how many are reached from there
  const bool is_whole = first == count && is_linked(count);
  if (from == End::Last && is_whole) {
    return Passed{now + static_cast<std::int64_t>(count + 1) * delay_, End::First};  // no slave works on it
  }
  if (from == End::First && first == 0 && !is_whole) {
    return std::nullopt;
  }
  frame[kSourceByte] |= kLocallyGiven;
  if (from == End::First && is_whole) {
    return Passed{pass_line(frame, now, 0), End::Last};
  }
  if (from == End::First) {
    pass_branch(frame, now + delay_, 0);
    return Passed{now + 2 * static_cast<std::int64_t>(first) * delay_, End::First};
  }
  std::size_t last = count;  // the first one that is reached from there
  while (last > 0 && is_linked(last)) {
    --last;
  }
  // To the cut without work, and back.
  const Time turned = now + static_cast<std::int64_t>(count - last) * delay_;
  return last == count ? std::nullopt : std::optional(Passed{pass_line(frame, turned, last), End::Last});
}

std::optional<Time> Segment::process(std::span<std::uint8_t> frame, Time now) {
  const auto passed = pass(frame, now, End::First);
  return passed && passed->at == End::First ? std::optional(passed->back) : std::nullopt;
}

void Segment::compute() {
  for (Slave& slave : slaves_) {
    if (slave.is_on()) {
      slave.compute();
    }
  }
}

void Segment::break_frame_at(std::size_t index) noexcept {
  auto& esc = slaves_[index].esc();
  const std::uint8_t errors = esc.at(reg::kRxErrors);
  esc.set<std::uint8_t>(reg::kRxErrors, errors == 0xFF ? errors : static_cast<std::uint8_t>(errors + 1));
}

}  // namespace indurop::io::ethercat
