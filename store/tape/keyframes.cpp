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
  return create(KeyframeFile{vars::keyframe_file(node), ::getpid()}, plans);
}

Result<KeyframeWriter> KeyframeWriter::create(const KeyframeFile& where, std::span<const KeyframePlan> plans) {
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
  auto file = vars::ShmFile::create(where.name, total + where.more_bytes);
  if (!file) {
    return file.error();
  }
  auto& header = *reinterpret_cast<KeyframeHeader*>(file->data());
  header.abi = kKeyframeAbi;
  header.module_count = static_cast<std::uint32_t>(plans.size());
  header.total_size = total;
  header.node_pid = where.node_pid;
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
  if (where.prepare != nullptr) {
    where.prepare(writer.more());
  }
  header.magic.store(kKeyframeMagic, std::memory_order_release);
  if (const Status published = writer.file_.publish(); !published) {
    return published.error();
  }
  return writer;
}

Result<KeyframeWriter> KeyframeWriter::open(const KeyframeFile& where) {
  auto file = vars::ShmFile::open(where.name, vars::Mode::ReadWrite);
  if (!file) {
    return file.error();
  }
  const auto& header = *reinterpret_cast<const KeyframeHeader*>(file->data());
  if (file->size() < kModulesOffset + sizeof(KeyframeModule) ||
      header.magic.load(std::memory_order_acquire) != kKeyframeMagic) {
    return Error{Errc::Corrupt, 0, "no keyframes"};
  }
  if (header.abi != kKeyframeAbi) {
    return Error{Errc::VersionMismatch, 0, "the keyframes of another release"};
  }
  if (header.node_pid != where.node_pid) {
    return Error{Errc::NotFound, 0, "the keyframes belong to another run"};
  }
  KeyframeWriter writer(std::move(file).value());
  const KeyframeModule& own = writer.module(0);
  const std::uint64_t total = header.total_size;
  if (total > writer.file_.size() || where.more_bytes > writer.file_.size() - total ||
      !lies_inside(own.form_offset, own.form_bytes, total) || own.slot_bytes < sizeof(KeyframeHead) ||
      own.slot_bytes > total / kKeyframeSlots ||
      !lies_inside(own.slots_offset, own.slot_bytes * kKeyframeSlots, total)) {
    return Error{Errc::Corrupt, 0, "the keyframes are inconsistent"};
  }
  return writer;
}

std::string KeyframeWriter::form(std::size_t index) const {
  const KeyframeModule& own = module(index);
  return {reinterpret_cast<const char*>(file_.data() + own.form_offset), own.form_bytes};
}

std::span<const std::uint8_t> KeyframeWriter::newest(std::size_t index) const noexcept {
  const KeyframeModule& own = module(index);
  const std::uint64_t count = own.count.load(std::memory_order_acquire);
  if (count == 0) {
    return {};
  }
  const std::byte* const at = file_.data() + own.slots_offset + (count - 1) % kKeyframeSlots * own.slot_bytes;
  KeyframeHead head;
  std::memcpy(static_cast<void*>(&head), at, sizeof head);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(at) + sizeof head;
  return {bytes, std::min(head.bytes, own.slot_bytes - sizeof head)};
}

std::byte* KeyframeWriter::more() const noexcept {
  return file_.data() + reinterpret_cast<const KeyframeHeader*>(file_.data())->total_size;
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
  return open_file(vars::keyframe_file(node), tape);
}

Result<KeyframeFollower> KeyframeFollower::open_file(const std::string& name, const TapeHeader& tape) {
  auto file = vars::ShmFile::open(name, vars::Mode::ReadOnly);
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
