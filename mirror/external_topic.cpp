// SPDX-License-Identifier: Apache-2.0
#include "mirror/external_topic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "mirror/external_type.h"
#include "schema/ros_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kUnreadNs = 100'000'000;    // how fresh the last value is kept that a late joiner gets first
constexpr std::int64_t kRepeatNs = 1'000'000'000;  // for readers that missed the first one while they were matched
constexpr auto kRelaxed = std::memory_order_relaxed;

// The same bytes under another name, unless that is empty. Without the description of the type, because ROS 2 calls the
// fields otherwise, and DDS would refuse to connect two descriptions that differ.
dds_topic_descriptor_t renamed(const dds_topic_descriptor_t& type, const std::string& name) {
  if (name.empty()) {
    return type;
  }
  return {type.m_size,  type.m_align, type.m_flagset & ~DDS_TOPIC_XTYPES_METADATA,
          type.m_nkeys, name.c_str(), type.m_keys,
          type.m_nops,  type.m_ops,   type.m_meta,
          {},           {},           type.restrict_data_representation};
}

}  // namespace

ExternalTopic::ExternalTopic(vars::Store& store, const vars::DirectoryEntry& entry, const Exported& exported, bool ros2,
                             ExternalBlock& block, rt::SignalWord& wake, const MirrorBlock* plant)
    : store_(store),
      entry_(entry),
      ros_type_(ros2 ? schema::ros_type_name(variable()) : std::string{}),
      type_(renamed(*static_cast<const dds_topic_descriptor_t*>(exported.type), ros_type_)),
      block_(block),
      wake_(wake),
      topic_name_(ros2 ? schema::ros_topic(exported.variable) : external_topic(exported.variable)),
      writable_(exported.writable),
      lead_(plant, exported.rivals),
      texts_(holds_text(variable().type)),
      every_ns_(exported.every_ns > 0 ? std::max(exported.every_ns, kExternalFastestNs) : kExternalEveryNs),
      sent_(entry.value_size),
      scratch_(entry.value_size) {
  if (entry.kind == abi::Kind::Ring) {
    ring_ = static_cast<const abi::RingHeader*>(store_.entry(entry.name_hash, 0));
  }
}

const schema::Variable& ExternalTopic::variable() const {
  return store_.schema().variables[entry_.schema_index];
}

Listener ExternalTopic::listener() {
  Listener listener = data_listener(
      [](dds_entity_t, void* self) {
        auto& topic = *static_cast<ExternalTopic*>(self);
        if (!topic.arrived_.exchange(true, std::memory_order_acq_rel)) {
          topic.wake_.wake();
        }
      },
      this);
  dds_listener_t* const made = listener.get();
  dds_lset_publication_matched(made, [](dds_entity_t, const dds_publication_matched_status_t status, void* self) {
    static_cast<ExternalTopic*>(self)->readers_.store(static_cast<int>(status.current_count),
                                                      std::memory_order_release);
  });
  dds_lset_offered_incompatible_qos(made, [](dds_entity_t, const dds_offered_incompatible_qos_status_t, void* self) {
    static_cast<ExternalTopic*>(self)->disagreements_.fetch_add(1, kRelaxed);
  });
  dds_lset_requested_incompatible_qos(made,
                                      [](dds_entity_t, const dds_requested_incompatible_qos_status_t, void* self) {
                                        static_cast<ExternalTopic*>(self)->disagreements_.fetch_add(1, kRelaxed);
                                      });
  return listener;
}

bool ExternalTopic::open_reader(dds_entity_t participant, std::string& problem) {
  if (!writable_ || reader_.ok()) {
    return true;
  }
  // Whoever only sends what is new matches too; and what was set before this node ran does not count.
  reader_ = make_reader(participant, type_, topic_name_, make_qos({.for_late_ones = false}), listener());
  if (!reader_.ok()) {
    problem = fmt::format("cannot receive {}: {}", topic_name_, reader_.why());
  }
  return reader_.ok();
}

bool ExternalTopic::open(dds_entity_t participant, std::string& problem) {
  if (!open_reader(participant, problem)) {
    return false;
  }
  if (!writer_.ok()) {
    writer_ = make_writer(participant, type_, topic_name_, make_qos({}), listener());
    if (!writer_.ok()) {
      problem = fmt::format("cannot publish {}: {}", topic_name_, writer_.why());
    }
  }
  return writer_.ok();
}

void ExternalTopic::close() noexcept {
  // Each waits for a listener that is running.
  reader_.reset();
  writer_.reset();
}

// True if the variable is not what was published last.
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
  // DDS looks at some types only; readers would drop the sample without a word.
  const std::string strange = strange_value(variable().type, sent_);
  const dds_return_t result = strange.empty() ? dds_write(writer_.get(), sent_.data()) : DDS_RETCODE_BAD_PARAMETER;
  if (result == DDS_RETCODE_BAD_PARAMETER) {
    block_.refused_by_dds.fetch_add(1, kRelaxed);
    refusal_ = fmt::format("{} is not published: an enum or bool in it has a value its type does not know ({})",
                           variable().name, strange);
    return true;  // the same value would be refused again
  }
  if (result < 0) {
    refusal_ = fmt::format("cannot publish {}: {}", variable().name, dds_strretcode(-result));
    return false;
  }
  block_.samples.fetch_add(1, kRelaxed);
  if (repeat_ns_ != 0 && now_ns >= repeat_ns_) {
    repeat_ns_ = 0;
  }
  return true;
}

bool ExternalTopic::look_who_leads(std::int64_t now_ns) noexcept {
  if (!lead_.look(now_ns)) {
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
  const int readers = readers_.load(std::memory_order_acquire);
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
  // On its grid, unless that was missed.
  due_ns_ = due_ns_ + pause > now_ns ? due_ns_ + pause : now_ns + pause;
  return due_ns_;
}

void ExternalTopic::receive() noexcept {
  if (!reader_.ok() || !arrived_.exchange(false, std::memory_order_acq_rel)) {
    return;
  }
  void* sample = nullptr;  // lend us memory
  dds_sample_info_t info{};
  if (dds_take(reader_.get(), &sample, &info, 1, 1) <= 0) {
    return;
  }
  if (info.valid_data) {
    take_over(static_cast<const std::uint8_t*>(sample));
  }
  (void)dds_return_loan(reader_.get(), &sample, 1);
}

void ExternalTopic::take_over(const std::uint8_t* sample) noexcept {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const schema::Variable& known = variable();
  std::copy_n(sample, scratch_.size(), scratch_.begin());
  tidy_texts(known.type, scratch_);
  std::string message = strange_value(known.type, scratch_);
  const schema::Range range = known.range.value_or(schema::Range{-kUnlimited, kUnlimited});
  bool taken = message.empty() && schema::check_range(range, known.type, scratch_, message).ok();
  if (taken && !store_.write(entry_, 0, scratch_)) {
    taken = false;
    message = "its writer lock is held by somebody who is stopped";
  }
  (taken ? block_.received : block_.refused).fetch_add(1, kRelaxed);
  if (!taken) {
    refusal_ = fmt::format("a value for {} from outside is refused: {}", known.name, message);
  }
  // Who reads the topic has seen what was asked for; now what holds.
  again_ = true;
  seen_ = ~std::uint64_t{0};
  due_ns_ = 0;
}

std::string ExternalTopic::complaint() {
  const std::uint32_t disagreements = disagreements_.load(kRelaxed);
  if (disagreements != told_) {
    block_.mismatched.fetch_add(disagreements - told_, kRelaxed);
    told_ = disagreements;
    return fmt::format(
        "somebody who uses the topic {} has another type for it or wants what is not offered: generate its code from "
        "the same .idl, and ask for at most reliable, transient-local",
        topic_name_);
  }
  return std::exchange(refusal_, {});
}

}  // namespace indurop::mirror
