// SPDX-License-Identifier: Apache-2.0
#include "mirror/external_topic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "mirror/external_type.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kUnreadNs = 100'000'000;    // how fresh the last value is kept that a late joiner gets first
constexpr std::int64_t kRepeatNs = 1'000'000'000;  // for readers that missed the first one while they were matched
constexpr auto kRelaxed = std::memory_order_relaxed;

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Qos make_qos(dds_durability_kind_t durability) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_durability(qos.get(), durability);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

}  // namespace

ExternalTopic::ExternalTopic(vars::Store& store, const vars::DirectoryEntry& entry, const Exported& exported,
                             ExternalBlock& block, rt::SignalWord& wake)
    : store_(store),
      entry_(entry),
      type_(*static_cast<const dds_topic_descriptor_t*>(exported.type)),
      block_(block),
      wake_(wake),
      topic_name_(external_topic(exported.variable)),
      writable_(exported.writable),
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

dds_listener_t* ExternalTopic::listener() {
  dds_listener_t* made = dds_create_listener(this);
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
  dds_lset_data_available(made, [](dds_entity_t, void* self) {
    auto& topic = *static_cast<ExternalTopic*>(self);
    if (!topic.arrived_.exchange(true, std::memory_order_acq_rel)) {
      topic.wake_.wake();
    }
  });
  return made;
}

bool ExternalTopic::make_topic(dds_entity_t participant, std::string& problem) {
  if (!topic_.ok()) {
    topic_ = Entity(dds_create_topic(participant, &type_, topic_name_.c_str(), nullptr, nullptr));
    if (!topic_.ok()) {
      problem = fmt::format("cannot make the topic {}: {}", topic_name_, topic_.why());
    }
  }
  return topic_.ok();
}

bool ExternalTopic::open_reader(dds_entity_t participant, std::string& problem) {
  if (!writable_ || reader_.ok()) {
    return true;
  }
  if (!make_topic(participant, problem)) {
    return false;
  }
  const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listening(listener(), &dds_delete_listener);
  // Whoever only sends what is new matches too; and what was set before this node ran does not count.
  const Qos qos = make_qos(DDS_DURABILITY_VOLATILE);
  reader_ = Entity(dds_create_reader(participant, topic_.get(), qos.get(), listening.get()));
  if (!reader_.ok()) {
    problem = fmt::format("cannot receive {}: {}", topic_name_, reader_.why());
  }
  return reader_.ok();
}

bool ExternalTopic::open(dds_entity_t participant, std::string& problem) {
  if (!open_reader(participant, problem) || !make_topic(participant, problem)) {
    return false;
  }
  if (!writer_.ok()) {
    const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listening(listener(), &dds_delete_listener);
    const Qos qos = make_qos(DDS_DURABILITY_TRANSIENT_LOCAL);
    writer_ = Entity(dds_create_writer(participant, topic_.get(), qos.get(), listening.get()));
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
  topic_.reset();
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

std::int64_t ExternalTopic::publish(std::int64_t now_ns) noexcept {
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
