// SPDX-License-Identifier: Apache-2.0
#include "store/tape/keyframes.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "store/vars/process.h"

namespace indurop::tape {
namespace {

constexpr auto kUnordered = std::memory_order_relaxed;

constexpr std::uint64_t to_line(std::uint64_t bytes) noexcept {
  return (bytes + kLine - 1) / kLine * kLine;
}

constexpr std::uint64_t kModulesOffset = to_line(sizeof(KeyframeHeader));

// Word by word: another process may be writing or reading them.
// NOLINTNEXTLINE(readability-non-const-parameter): written through an atomic
void copy_words(std::uint64_t* to, const std::uint64_t* from, std::uint64_t bytes) noexcept {
  for (std::uint64_t i = 0; i < words_of(bytes); ++i) {
    __atomic_store_n(to + i, __atomic_load_n(from + i, __ATOMIC_RELAXED), __ATOMIC_RELAXED);
  }
}

bool lies_inside(std::uint64_t offset, std::uint64_t bytes, std::uint64_t total) noexcept {
  return offset % sizeof(std::uint64_t) == 0 && offset <= total && bytes <= total - offset;
}

}  // namespace

Result<KeyframeWriter> KeyframeWriter::create(const std::string& node, std::span<const KeyframePlan> plans) {
  std::uint64_t total = kModulesOffset + plans.size() * sizeof(KeyframeModule);
  std::vector<std::uint64_t> forms;
  for (const KeyframePlan& plan : plans) {
    forms.push_back(total);
    total = to_line(total + plan.form.size());
  }
  std::vector<std::uint64_t> slots;
  for (const KeyframePlan& plan : plans) {
    slots.push_back(total);
    total += kKeyframeSlots * to_line(sizeof(KeyframeHead) + plan.most);
  }
  auto file = vars::ShmFile::create(vars::keyframe_file(node), total);
  if (!file) {
    return file.error();
  }
  auto& header = *reinterpret_cast<KeyframeHeader*>(file->data());
  header.abi = kKeyframeAbi;
  header.module_count = static_cast<std::uint32_t>(plans.size());
  header.total_size = total;
  header.node_pid = ::getpid();
  header.node_start_time = vars::process_start_time(header.node_pid);
  KeyframeWriter writer(std::move(file).value());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    KeyframeModule& module = writer.module(i);
    module.module = plans[i].module;
    module.form_bytes = static_cast<std::uint32_t>(plans[i].form.size());
    module.form_offset = forms[i];
    module.slots_offset = slots[i];
    module.slot_bytes = to_line(sizeof(KeyframeHead) + plans[i].most);
    std::memcpy(writer.file_.data() + forms[i], plans[i].form.data(), plans[i].form.size());
  }
  header.magic.store(kKeyframeMagic, std::memory_order_release);
  if (const Status published = writer.file_.publish(); !published) {
    return published.error();
  }
  return writer;
}

KeyframeModule& KeyframeWriter::module(std::size_t index) const noexcept {
  return reinterpret_cast<KeyframeModule*>(file_.data() + kModulesOffset)[index];
}

std::byte* KeyframeWriter::slot(const KeyframeModule& module) const noexcept {
  return file_.data() + module.slots_offset + module.count.load(kUnordered) % kKeyframeSlots * module.slot_bytes;
}

std::span<std::byte> KeyframeWriter::room(std::size_t index) noexcept {
  const KeyframeModule& own = module(index);
  return {slot(own) + sizeof(KeyframeHead), own.slot_bytes - sizeof(KeyframeHead)};
}

void KeyframeWriter::publish(std::size_t index, const KeyframeHead& head) noexcept {
  KeyframeModule& own = module(index);
  std::memcpy(slot(own), &head, sizeof head);
  own.count.store(own.count.load(kUnordered) + 1, std::memory_order_release);
  std::atomic_thread_fence(std::memory_order_seq_cst);  // before anything of the next one is written
}

void KeyframeWriter::note_missed(std::size_t index) noexcept {
  module(index).missed.fetch_add(1, kUnordered);
}

Result<KeyframeFollower> KeyframeFollower::open(const std::string& node, const TapeHeader& tape) {
  auto file = vars::ShmFile::open(vars::keyframe_file(node), vars::Mode::ReadOnly);
  if (!file) {
    return file.error();
  }
  const auto& header = *reinterpret_cast<const KeyframeHeader*>(file->data());
  if (file->size() < kModulesOffset || header.magic.load(std::memory_order_acquire) != kKeyframeMagic) {
    return Error{Errc::Corrupt, 0, "no keyframes"};
  }
  if (header.abi != kKeyframeAbi) {
    return Error{Errc::VersionMismatch, 0, "the keyframes of another release"};
  }
  if (header.node_pid != tape.node_pid || header.node_start_time != tape.node_start_time) {
    return Error{Errc::NotFound, 0, "the keyframes belong to another run"};
  }
  KeyframeFollower follower(std::move(file).value());
  if (const Status good = follower.find_modules(); !good) {
    return good.error();
  }
  return follower;
}

Status KeyframeFollower::find_modules() {
  const std::uint64_t total = file_.size();
  const std::uint64_t count = reinterpret_cast<const KeyframeHeader*>(file_.data())->module_count;
  const Error wrong{Errc::Corrupt, 0, "the keyframes are inconsistent"};
  if (!lies_inside(kModulesOffset, count * sizeof(KeyframeModule), total)) {
    return wrong;
  }
  const auto* shared = reinterpret_cast<const KeyframeModule*>(file_.data() + kModulesOffset);
  for (std::uint64_t i = 0; i < count; ++i, ++shared) {
    const std::uint64_t form = shared->form_offset;
    const std::uint64_t form_bytes = shared->form_bytes;
    Place place{{shared->module, {}}, shared, shared->slots_offset, shared->slot_bytes, 0};
    if (!lies_inside(form, form_bytes, total) || place.slot_bytes < sizeof(KeyframeHead) ||
        place.slot_bytes % kLine != 0 || place.slot_bytes > total / kKeyframeSlots ||
        !lies_inside(place.slots_offset, place.slot_bytes * kKeyframeSlots, total)) {
      return wrong;
    }
    place.known.form.assign(reinterpret_cast<const char*>(file_.data() + form), form_bytes);
    places_.push_back(std::move(place));
  }
  return {};
}

bool KeyframeFollower::next(std::size_t index, Keyframe& keyframe) {
  Place& place = places_[index];
  for (;;) {
    const std::uint64_t count = place.shared->count.load(std::memory_order_acquire);
    if (count > place.at + kKeyframeSlots - 1) {
      place.at = count - (kKeyframeSlots - 1);  // the one before is being overwritten
    }
    if (place.at >= count) {
      return false;
    }
    const auto* const slot = reinterpret_cast<const std::uint64_t*>(file_.data() + place.slots_offset +
                                                                    place.at % kKeyframeSlots * place.slot_bytes);
    std::vector<std::uint64_t> words(place.slot_bytes / sizeof(std::uint64_t));
    copy_words(words.data(), slot, place.slot_bytes);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (place.shared->count.load(kUnordered) > place.at + kKeyframeSlots - 1) {
      continue;
    }
    ++place.at;
    std::memcpy(static_cast<void*>(&keyframe.head), words.data(), sizeof keyframe.head);
    if (keyframe.head.bytes > place.slot_bytes - sizeof keyframe.head) {
      continue;
    }
    keyframe.module = place.known.module;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(words.data()) + sizeof keyframe.head;
    keyframe.bytes.assign(bytes, bytes + keyframe.head.bytes);
    return true;
  }
}

}  // namespace indurop::tape
