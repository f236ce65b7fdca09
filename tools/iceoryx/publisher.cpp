// SPDX-License-Identifier: Apache-2.0
#include "tools/iceoryx/publisher.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <deque>

#include <iceoryx_hoofs/log/logmanager.hpp>
#include <iceoryx_posh/popo/untyped_publisher.hpp>
#include <iceoryx_posh/runtime/posh_runtime.hpp>

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"

namespace indurop::iceoryx {
namespace {

using iox::capro::IdString_t;
using iox::capro::ServiceDescription;
using tools::WatchedValue;

constexpr std::int64_t kSecond = 1'000'000'000;

IdString_t id(const std::string& text) {
  return {iox::cxx::TruncateToCapacity, text.c_str(), text.size()};
}

iox::popo::PublisherOptions keep_last_value() {
  iox::popo::PublisherOptions options;
  options.historyCapacity = 1;  // later subscribers get the last value
  return options;
}

class Topic {
 public:
  Topic(const std::string& node, const WatchedValue& value)
      : type_hash_(value.item.entry->type_hash),
        publisher_(ServiceDescription(IdString_t("InduRoP"), id(node), id(value.item.name)), keep_last_value()) {}

  // Returns false if iceoryx has no memory left; the value is then tried again in the next round.
  bool publish_if_new(tools::Context& context, const WatchedValue& value) {
    if (stopped_ || value.gone || !value.known || (published_ && value.bytes == last_)) {
      return true;
    }
    if (value.item.entry->type_hash != type_hash_) {
      stopped_ = true;
      context.out.error(fmt::format(
          "{} has another type now and is no longer published; restart indurop-iceoryx and the programs that read it",
          value.item.name));
      return true;
    }
    auto chunk = publisher_.loan(static_cast<std::uint32_t>(value.bytes.size()));
    if (chunk.has_error()) {
      return false;
    }
    std::memcpy(chunk.value(), value.bytes.data(), value.bytes.size());
    publisher_.publish(chunk.value());
    last_ = value.bytes;
    published_ = true;
    return true;
  }

 private:
  std::uint64_t type_hash_;
  std::vector<std::uint8_t> last_;
  bool published_ = false;
  bool stopped_ = false;
  iox::popo::UntypedPublisher publisher_;
};

void report_memory(tools::Context& context, bool full, bool& reported) {
  if (full && !reported) {
    context.out.note("RouDi has no free memory of the right size: values wait until a subscriber gives some back");
  }
  reported = full;
}

}  // namespace

std::size_t most_topics() noexcept {
  return iox::MAX_PUBLISHERS - iox::NUMBER_OF_INTERNAL_PUBLISHERS;
}

std::size_t longest_name() noexcept {
  return IdString_t::capacity();
}

int publish(tools::Context& context, tools::WatchSource& source, int hz) {
  alarm(kStuckSeconds);
  // iceoryx changes and restores the umask in several threads; all of them have to find the same value.
  umask(0007);
  iox::log::LogManager::GetLogManager().SetDefaultLogLevel(iox::log::LogLevel::kError,
                                                           iox::log::LogLevelOutput::kHideLogLevel);
  const std::string name = "indurop-iceoryx-" + source.node();
  iox::runtime::PoshRuntime::initRuntime(iox::RuntimeName_t(iox::cxx::TruncateToCapacity, name.c_str(), name.size()));
  std::deque<Topic> topics;  // publishers cannot be moved
  for (const WatchedValue& value : source.values()) {
    alarm(kStuckSeconds);
    topics.emplace_back(source.node(), value);
  }
  context.out.note(
      fmt::format("publishes {} variable{} of node '{}'", topics.size(), topics.size() == 1 ? "" : "s", source.node()));
  const std::int64_t period = kSecond / hz;
  bool memory_reported = false;
  while (!tools::interrupted()) {
    alarm(kStuckSeconds);
    const std::int64_t start = rt::now_ns();
    source.sample(context, 0, topics.size());
    bool full = false;
    for (std::size_t i = 0; i < topics.size(); ++i) {
      full = !topics[i].publish_if_new(context, source.values()[i]) || full;
    }
    report_memory(context, full, memory_reported);
    tools::wait_until(start + period);
  }
  return kOk;
}

}  // namespace indurop::iceoryx
