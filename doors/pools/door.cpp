// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/door.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "core/base/print.h"
#include "doors/pools/own_network.h"
#include "doors/pools/report.h"
#include "store/vars/node_lock.h"
#include "store/vars/nodes.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"

namespace indurop::pool_door {
namespace {

using std::chrono::milliseconds;
using tools::Failure;

constexpr milliseconds kWaitForNode{300};
constexpr unsigned kLongestEnd = 10;  // s

std::chrono::nanoseconds period_of(double hz) {
  return hz > 0 ? std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / hz)) : std::chrono::nanoseconds(0);
}

}  // namespace

PoolDoor::PoolDoor(DoorOptions options)
    : options_(std::move(options)),
      node_(options_.node.empty() ? vars::node_of_environment() : options_.node),
      log_("indurop-pools", node_.empty() ? "local" : node_, options_.quiet) {}

// What is waited for is said once.
bool PoolDoor::wait_for(base::StopSignal& stop, const std::string& what) {
  if (what != waited_for_) {
    log_.info("waits: {}", what);
  }
  waited_for_ = what;
  return stop.wait(kWaitForNode) == 0;
}

Result<void, Failure> PoolDoor::find_node(base::StopSignal& stop) {
  if (node_.empty()) {
    auto chosen = tools::choose_node("");
    if (!chosen) {
      return std::move(chosen).error();
    }
    node_ = std::move(*chosen);
  }
  if (!vars::valid_node_name(node_)) {
    return Failure{kUsage,
                   fmt::format("'{}' is not a valid node name: 1 to 40 of A-Z a-z 0-9 _ -", tools::printable(node_))};
  }
  for (;;) {
    const auto store = vars::Store::attach(node_, vars::Mode::ReadOnly);
    if (store && vars::is_running(node_, store->header())) {
      return {};
    }
    if (!store && store.error().code != Errc::NotFound && store.error().code != Errc::Busy) {
      return Failure{tools::exit_code_of(store.error()), tools::explain_open_error(store.error(), node_, false)};
    }
    if (!wait_for(stop,
                  fmt::format("node '{}' does not run. Start it: indurop run module.xml --node {}", node_, node_))) {
      return {};
    }
  }
}

Result<void, Failure> PoolDoor::find_pools() {
  const auto store = vars::Store::attach(node_, vars::Mode::ReadOnly);
  std::vector<std::string> known;
  if (store) {
    for (const schema::Pool& pool : store->schema().pools) {
      known.push_back(pool.name);
    }
  }
  std::vector<std::string> problems;
  const auto full_name = [&](std::string& name) {
    const std::vector<std::string> meant = tools::variables_named(name, known);
    if (meant.size() == 1) {
      name = meant.front();
    } else if (!meant.empty()) {
      problems.push_back(tools::which_variable(name, meant));
    } else {
      problems.push_back(fmt::format("node '{}' has no pool '{}'.{} {}", node_, tools::printable(name),
                                     tools::did_you_mean(name, known),
                                     known.empty() ? "None of its modules declares a pool (docs/pools.md)"
                                                   : fmt::format("Its pools: {}", fmt::join(known, ", "))));
    }
  };
  for (const std::string& text : options_.send) {
    std::string ignored;  // checked with the options
    full_name(sent_.emplace_back(read_sent_pool(text, ignored)).name);
  }
  std::ranges::for_each(options_.receive, full_name);
  for (const auto& [name, every_ns] : sent_) {
    if (std::ranges::count(sent_, name, &SentPool::name) > 1 || std::ranges::count(options_.receive, name) > 0) {
      problems.push_back(
          fmt::format("{} is named twice: a pool is either sent or received, else its chunks would go "
                      "round and round",
                      name));
    }
  }
  return problems.empty() ? Result<void, Failure>() : Failure{kUsage, fmt::format("{}", fmt::join(problems, "\n"))};
}

bool PoolDoor::join(base::StopSignal& stop, const dds::NetworkSettings& network) {
  for (;;) {
    auto joined = dds::join_network(network);
    if (joined) {
      if (!joined->note.empty()) {
        log_.warning("{}", joined->note);
      }
      participant_ = std::move(joined->participant);
      return true;
    }
    if (!wait_for(stop, joined.error().text)) {
      return false;
    }
  }
}

Result<void, Failure> PoolDoor::open(const std::string& plant) {
  const auto open_one = [this, &plant](auto& end) -> Result<void, Failure> {
    const auto opened = end.open(participant_.get(), plant);
    return opened ? Result<void, Failure>() : Failure{kFailed, opened.error().text};
  };
  for (const SentPool& sent : sent_) {
    const auto every = sent.every_ns < 0 ? period_of(options_.hz) : std::chrono::nanoseconds(sent.every_ns);
    senders_.push_back(std::make_unique<Sender>(node_, sent.name, every, log_));
    if (auto opened = open_one(*senders_.back()); !opened) {
      return opened;
    }
  }
  for (const std::string& name : options_.receive) {
    receivers_.push_back(std::make_unique<Receiver>(node_, name, log_));
    if (auto opened = open_one(*receivers_.back()); !opened) {
      return opened;
    }
  }
  return {};
}

void PoolDoor::start_threads() {
  for (const auto& sender : senders_) {
    threads_.emplace_back([this, &one = *sender] { one.run(stop_); });
  }
  for (const auto& receiver : receivers_) {
    threads_.emplace_back([this, &one = *receiver] { one.run(stop_); });
  }
}

void PoolDoor::end_threads() noexcept {
  stop_.store(true);
  for (const auto& sender : senders_) {
    sender->wake();
  }
  for (const auto& receiver : receivers_) {
    receiver->wake();
  }
  for (std::thread& thread : threads_) {
    thread.join();
  }
  threads_.clear();
}

void PoolDoor::report() const {
  tools::JsonValue pools = tools::JsonValue::array();
  const auto add = [&](const auto& end) {
    if (options_.json) {
      pools.push_back(json_of(end->pool(), end->counts()));
    } else {
      base::print(stdout, "{}\n", line_of(end->pool(), end->counts()));
    }
  };
  std::ranges::for_each(senders_, add);
  std::ranges::for_each(receivers_, add);
  if (options_.json) {
    base::print(stdout, "{}\n", tools::JsonValue{{"schema_version", tools::kJsonVersion}, {"pools", pools}}.dump());
  }
  (void)std::fflush(stdout);
}

Result<void, Failure> PoolDoor::run(base::StopSignal& stop) {
  if (auto found = find_node(stop); !found || stop.received() != 0) {
    return found;
  }
  if (auto found = find_pools(); !found) {
    return found;
  }
  tools::be_gentle(node_);
  auto network = own_network(options_, node_);
  if (!network) {
    return std::move(network).error();
  }
  if (!join(stop, *network)) {
    return {};
  }
  // Keys separate plants already, and permit no partition.
  if (auto opened = open(network->security.on() ? std::string() : options_.plant); !opened) {
    return opened;
  }
  log_.info("DDS domain {}{}", network->domain, network->security.on() ? ", with keys" : "");
  start_threads();
  const std::chrono::nanoseconds every =
      options_.report_ns > 0 ? std::chrono::nanoseconds(options_.report_ns) : std::chrono::hours(1);
  while (stop.wait(every) == 0) {
    if (options_.report_ns > 0) {
      report();
    }
  }
  // An agent that was killed cannot kill this program: it ends even if DDS does not let it.
  (void)::alarm(kLongestEnd);
  end_threads();
  report();
  return {};
}

}  // namespace indurop::pool_door
