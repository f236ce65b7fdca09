// SPDX-License-Identifier: Apache-2.0
#include "config/network_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/duration.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

template <class Number>
bool read_number(std::string_view text, Number& to) {
  const auto end = std::from_chars(text.data(), text.data() + text.size(), to);
  return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

std::string read_time(std::string_view name, std::string_view text, base::Nanos least, base::Nanos& to) {
  const base::DurationText time = base::read_duration(text, true);
  if (!time.value) {
    return fmt::format("{}: {}", name, time.problem);
  }
  if (*time.value < least || *time.value > SimulatedNetwork::kLongest) {
    return fmt::format("{}: {} is not possible; write a time from {} to {}", name, base::format_duration(*time.value),
                       base::format_duration(least), base::format_duration(SimulatedNetwork::kLongest));
  }
  to = *time.value;
  return {};
}

std::string read_one(std::string_view name, std::string_view value, SimulatedNetwork& network) {
  if (name == "delay") {
    return read_time(name, value, SimulatedNetwork::kLeastDelay, network.delay);
  }
  if (name == "jitter") {
    return read_time(name, value, {}, network.jitter);
  }
  if (name == "repeat") {
    return read_time(name, value, SimulatedNetwork::kLeastDelay, network.repeat);
  }
  if (name == "loss") {
    double loss = -1;
    if (!read_number(value, loss) || loss < 0 || loss > SimulatedNetwork::kMaxLoss) {
      return fmt::format("loss: {} is not a share of lost messages; write a number from 0 to {}",
                         base::in_quotes(value), SimulatedNetwork::kMaxLoss);
    }
    network.loss = loss;
    return {};
  }
  if (name == "seed") {
    return read_number(value, network.seed) && network.seed >= 0
               ? ""
               : fmt::format("seed: {} is not a whole number from 0", base::in_quotes(value));
  }
  return fmt::format("{} is not a property of a network{}", base::in_quotes(name),
                     base::suggestion(name, {"delay", "jitter", "loss", "repeat", "seed"}));
}

}  // namespace

std::string read_network(std::string_view text, SimulatedNetwork& network) {
  SimulatedNetwork changed = network;
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(','));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    const auto equals = one.find('=');
    if (equals == std::string_view::npos) {
      return fmt::format("{} has no value; write, for example, delay=200us,jitter=50us,loss=0.001,seed=7",
                         base::in_quotes(one));
    }
    if (std::string problem =
            read_one(base::trimmed(one.substr(0, equals)), base::trimmed(one.substr(equals + 1)), changed);
        !problem.empty()) {
      return problem;
    }
  }
  network = changed;
  return {};
}

}  // namespace indurop::config
