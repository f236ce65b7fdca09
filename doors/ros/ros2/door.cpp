// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/door.h"

#include <algorithm>
#include <utility>

#include "network/dds/log.h"

namespace indurop::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTurn{5};
constexpr milliseconds kWait{300};
constexpr std::chrono::seconds kReportEvery{1};

// Found by multicast as programs of ROS 2 are, and on this machine also without it.
dds::NetworkSettings network_of(const dds::NetworkSettings& chosen) {
  dds::NetworkSettings settings = chosen;
  settings.peers.emplace_back("127.0.0.1");
  settings.known_ports = true;
  settings.lease_ns = std::chrono::nanoseconds(std::chrono::seconds(10)).count();
  return settings;
}

}  // namespace

Ros2Door::Ros2Door(Ros2Options options, ArmFile arm)
    : options_(std::move(options)),
      choice_{options_.arm.robot, options_.arm.move, std::move(arm.joints)},
      urdf_(std::move(arm.text)),
      log_("indurop-ros2", options_.arm.node.empty() ? "local" : options_.arm.node, options_.arm.quiet),
      ros_(options_.space) {}

// Returns false after a signal. What is waited for is said once.
bool Ros2Door::wait_for(base::StopSignal& stop, const std::string& what) {
  if (what != waited_for_) {
    log_.info("waits: {}", what);
  }
  waited_for_ = what;
  return stop.wait(kWait) == 0;
}

bool Ros2Door::join(base::StopSignal& stop) {
  for (;;) {
    const auto joined = ros_.join(network_of(options_.network));
    if (joined) {
      if (!joined->empty()) {
        log_.warning("{}", *joined);
      }
      return true;
    }
    if (!wait_for(stop, joined.error().text)) {
      return false;
    }
  }
}

Result<void, base::Problem> Ros2Door::begin() {
  auto node = Node::open(options_.arm.node, options_.arm.move);
  if (!node) {
    return std::move(node).error();
  }
  auto arm = ServedArm::find(*node, choice_, ros_, log_);
  if (!arm) {
    return std::move(arm).error();
  }
  node_ = std::move(*node);
  arm_ = std::move(*arm);
  log_.info("node {}: an arm with {} joints{}", node_->name(), choice_.joints.size(),
            choice_.may_move ? ", which clients may move" : "");
  return {};
}

void Ros2Door::serve(Time now) {
  const Time period(static_cast<std::int64_t>(1e9 / options_.arm.rate_hz));
  const bool is_due = now >= next_;
  next_ = is_due ? std::max(next_ + period, now) : next_;
  arm_->serve(now, is_due);
  if (!node_->runs()) {
    end("the node has ended, or has other variables");
  }
}

void Ros2Door::end(const std::string& why) {
  if (arm_) {
    arm_->abandon(why);
  }
  arm_.reset();
  node_.reset();
}

void Ros2Door::report_unreadable(Time now) {
  const std::uint64_t count = dds::unreadable_samples();
  if (count != unreadable_ && now >= next_report_) {
    log_.warning("{} messages were ignored, because their bytes are none of their type: {}", count,
                 dds::last_dds_message());
    unreadable_ = count;
    next_report_ = now + kReportEvery;
  }
}

Result<void, base::Problem> Ros2Door::run(base::StopSignal& stop) {
  if (!join(stop)) {
    return {};
  }
  const std::string controller = choice_.may_move ? options_.arm.controller : "";
  if (auto added = ros_.add_arm(controller, urdf_, events_of(arm_, ros_, log_)); !added) {
    return added;
  }
  while (stop.wait(kTurn) == 0) {
    // What is wanted while the node is away is rejected now, and not executed when it is back.
    if (ros_.spin() > 0) {
      log_.warning(
          "a client of another middleware of ROS 2 was ignored; set RMW_IMPLEMENTATION=rmw_cyclonedds_cpp there");
    }
    const Time now = monotonic();
    report_unreadable(now);
    if (arm_) {
      serve(now);
    } else if (const auto begun = begin(); !begun && !wait_for(stop, begun.error().text)) {
      break;
    }
  }
  end("indurop-ros2 has ended");
  return {};
}

}  // namespace indurop::ros
