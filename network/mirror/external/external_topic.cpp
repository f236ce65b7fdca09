// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/external_topic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/rt/relaxed.h"
#include "core/schema/ros_name.h"
#include "network/dds/descriptor.h"
#include "network/dds/guid.h"
#include "network/dds/remote_topic.h"
#include "network/mirror/external/external_type.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kUnreadNs = 100'000'000;    // maximum age of the value that a late joiner gets first
constexpr std::int64_t kRepeatNs = 1'000'000'000;  // for readers that missed the first value during matching
using rt::kRelaxed;

}  // namespace

ExternalTopic::ExternalTopic(vars::Store& store, const vars::DirectoryEntry& entry, const Exported& exported, bool ros2,
                             ExternalBlock& block, rt::SignalWord& wake, const MirrorBlock* plant,
                             const vars::Custody* custody)
    : store_(store),
      entry_(entry),
      ros_type_(ros2 ? schema::ros_type_name(variable()) : std::string{}),
      type_(dds::renamed(exported.type, ros_type_)),
      custody_(custody),
      block_(block),
      topic_name_(ros2 ? schema::ros_topic(exported.variable) : external_topic(exported.variable)),
      writable_(exported.writable),
      lead_(plant, exported.rivals),
      texts_(holds_text(variable().type)),
      every_ns_(exported.every_ns > 0 ? std::max(exported.every_ns, kExternalFastestNs) : kExternalEveryNs),
      events_(wake),
      sent_(entry.value_size),
      scratch_(entry.value_size) {
  if (entry.kind == abi::Kind::Ring) {
    ring_ = static_cast<const abi::RingHeader*>(store_.entry(entry.name_hash, 0));
  }
}

const schema::Variable& ExternalTopic::variable() const {
  return store_.schema().variables[entry_.schema_index];
}

Result<void, base::Problem> ExternalTopic::open_reader(dds::Handle participant) {
  if (!writable_ || reader_.ok()) {
    return {};
  }
  // Writers that send only new values match too; values that were set before this node ran do not count.
  reader_ =
      dds::make_reader(participant, type_, topic_name_, dds::make_qos({.for_late_ones = false}), events_.listener());
  if (!reader_.ok()) {
    return base::Problem{fmt::format("cannot receive {}: {}", topic_name_, reader_.why())};
  }
  return {};
}

Result<void, base::Problem> ExternalTopic::open(dds::Handle participant) {
  if (auto opened = open_reader(participant); !opened) {
    return opened;
  }
  if (!writer_.ok()) {
    writer_ = dds::make_writer(participant, type_, topic_name_, dds::make_qos({}), events_.listener());
    if (!writer_.ok()) {
      return base::Problem{fmt::format("cannot publish {}: {}", topic_name_, writer_.why())};
    }
  }
  return {};
}

void ExternalTopic::close() noexcept {
  // Each reset waits for a listener that is running.
  reader_.reset();
  writer_.reset();
}

// Returns true if the variable differs from what was published last.
bool ExternalTopic::refresh() noexcept {
  const std::uint64_t version = ring_ == nullptr ? 0 : ring_->seq.load(std::memory_order_acquire);
  if (ring_ != nullptr && version == seen_) {
    return false;
  }
  if (!store_.read(entry_, 0, scratch_)) {
    return false;
  }
  seen_ = version;  // a commit during the copy is seen next time
  if (texts_) {
    tidy_texts(variable().type, scratch_);
  }
  if (std::memcmp(scratch_.data(), sent_.data(), sent_.size()) == 0) {
    return false;
  }
  sent_.swap(scratch_);
  return true;
}

bool ExternalTopic::write(std::int64_t now_ns) noexcept {
  // DDS checks some types only; readers would discard the sample silently.
  const std::string strange = strange_value(variable().type, sent_);
  std::optional<dds::Written> written;
  if (strange.empty()) {
    written = dds::write_bytes(writer_.get(), sent_.data());
  }
  if (!written || written->bad_value()) {
    block_.refused_by_dds.fetch_add(1, kRelaxed);
    refusal_ = fmt::format("{} is not published: an enum or bool in it has a value its type does not know ({})",
                           variable().name, strange);
    return true;  // the same value would be rejected again
  }
  if (!written->ok()) {
    refusal_ = fmt::format("cannot publish {}: {}", variable().name, written->why());
    return false;
  }
  block_.samples.fetch_add(1, kRelaxed);
  if (repeat_ns_ != 0 && now_ns >= repeat_ns_) {
    repeat_ns_ = 0;
  }
  return true;
}

bool ExternalTopic::update_lead(std::int64_t now_ns) noexcept {
  if (!lead_.update(now_ns)) {
    return false;
  }
  again_ = true;
  due_ns_ = 0;
  return true;
}

std::int64_t ExternalTopic::publish(std::int64_t now_ns) noexcept {
  if (!leads()) {
    return std::numeric_limits<std::int64_t>::max();
  }
  const int readers = events_.readers();
  if (readers > known_readers_) {
    again_ = true;
    repeat_ns_ = now_ns + kRepeatNs;
    due_ns_ = std::min(due_ns_, now_ns);
  }
  known_readers_ = readers;
  if (now_ns < due_ns_) {
    return due_ns_;
  }
  const bool changed = refresh();
  if (changed || again_ || (repeat_ns_ != 0 && now_ns >= repeat_ns_)) {
    again_ = !write(now_ns);
  }
  const std::int64_t pause = readers > 0 ? every_ns_ : std::max(every_ns_, kUnreadNs);
  // Keeps its time grid, unless that was missed.
  due_ns_ = due_ns_ + pause > now_ns ? due_ns_ + pause : now_ns + pause;
  return due_ns_;
}

void ExternalTopic::receive() noexcept {
  if (!reader_.ok() || !events_.take_arrival()) {
    return;
  }
  dds::take_one<std::uint8_t>(reader_.get(), [this](const std::uint8_t& sample, const dds::SampleInfo& info) {
    if (info.valid) {
      take_over(&sample, dds::is_marked(reader_.get(), info.publication, dds::kToolMark));
    }
  });
}

// Returns why the write lock forbids tools to set the variable; empty if it does not.
std::string ExternalTopic::locked() const {
  const auto act = variable().is_parameter() ? vars::Act::SetParameter : vars::Act::Set;
  return custody_ == nullptr ? std::string() : vars::refusal(custody_->lock(), act).value_or("");
}

void ExternalTopic::take_over(const std::uint8_t* sample, bool by_tool) noexcept {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const schema::Variable& known = variable();
  std::copy_n(sample, scratch_.size(), scratch_.begin());
  tidy_texts(known.type, scratch_);
  std::string message = by_tool ? locked() : std::string();
  message = message.empty() ? strange_value(known.type, scratch_) : message;
  if (message.empty()) {
    const schema::Range range = known.range.value_or(schema::Range{-kUnlimited, kUnlimited});
    const auto inside = schema::check_range(range, known.type, scratch_);
    message = inside ? "" : inside.error().message;
  }
  if (message.empty() && !store_.write(entry_, 0, scratch_)) {
    message = "its write lock is held by a stopped process";
  }
  const bool taken = message.empty();
  (taken ? block_.received : block_.refused).fetch_add(1, kRelaxed);
  if (!taken) {
    refusal_ = fmt::format("a value for {} from outside is rejected: {}", known.name, message);
  }
  // Readers of the topic have seen the requested value; now the valid one is published.
  again_ = true;
  seen_ = ~std::uint64_t{0};
  due_ns_ = 0;
}

std::string ExternalTopic::complaint() {
  if (const std::uint32_t disagreements = events_.take_disagreements(); disagreements != 0) {
    block_.mismatched.fetch_add(disagreements, kRelaxed);
    return fmt::format(
        "a participant that uses the topic {} has another type for it or requests a QoS that is not offered: generate "
        "its code from the same .idl, and request at most reliable, transient-local",
        topic_name_);
  }
  return std::exchange(refusal_, {});
}

}  // namespace indurop::mirror
