// SPDX-License-Identifier: Apache-2.0
#include "store/tape/track.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "core/rt/relaxed.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::tape {
namespace {

using rt::kRelaxed;
constexpr std::uint64_t kAhead = 64;  // words claimed in advance, so that not each entry has to claim
constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
constexpr std::uint32_t kOnce = kRestarted | kExchanged;  // marks of one run
constexpr std::uint64_t kStepsPerClockReading =
    16;  // variables checked and words written in the time of a clock reading

// The bits of a scalar.
std::uint64_t load_scalar(const void* entry, std::uint32_t size) noexcept {
  switch (size) {
    case 1:
      return __atomic_load_n(static_cast<const std::uint8_t*>(entry), __ATOMIC_ACQUIRE);
    case 2:
      return __atomic_load_n(static_cast<const std::uint16_t*>(entry), __ATOMIC_ACQUIRE);
    case 4:
      return __atomic_load_n(static_cast<const std::uint32_t*>(entry), __ATOMIC_ACQUIRE);
    default:
      return __atomic_load_n(static_cast<const std::uint64_t*>(entry), __ATOMIC_ACQUIRE);
  }
}

const abi::RingHeader& ring_of(const void* entry) noexcept {
  return *static_cast<const abi::RingHeader*>(entry);
}

}  // namespace

Track::Track(std::byte* tape, TapeTrack& shared, const vars::Store& store, Writer writer)
    : orders_(reinterpret_cast<TapeHeader*>(tape)->order),
      head_(shared.head.load(kRelaxed)),
      at_(head_),
      claimed_(shared.claimed.load(kRelaxed)),
      number_(shared.runs.load(kRelaxed)),
      marks_(number_ > 0 ? std::uint32_t{kRestarted} : 0U),  // another process of a module that has run
      shared_(shared),
      words_(reinterpret_cast<std::uint64_t*>(tape + shared.data_offset)),
      mask_(shared.words - 1),
      part_shift_(static_cast<std::uint8_t>(std::bit_width(shared.words / kMarks) - 1)),
      shows_open_(writer == Writer::Process),
      reads_end_(shared.only_read + shared.both),
      writes_begin_(shared.only_read) {
  const auto* const indices = reinterpret_cast<const std::uint32_t*>(tape + shared.items_offset);
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < std::size_t{reads_end_} + shared.only_written; ++i) {
    items_.push_back(item_of(store, indices[i]));
    largest = std::max(largest, words_of(items_.back().size));
  }
  copy_.resize(largest);
}

void Track::go_on(std::uint32_t number, std::uint32_t marks) noexcept {
  head_ = shared_.head.load(std::memory_order_acquire);
  at_ = head_;
  claimed_ = shared_.claimed.load(kRelaxed);
  number_ = shared_.runs.load(kRelaxed);
  all_ = true;
  open_ = false;
  marks_.store(mark_of(number) | marks, std::memory_order_release);
}

Track::Item Track::item_of(const vars::Store& store, std::uint32_t variable) {
  const vars::DirectoryEntry& entry = store.directory()[variable];
  return {store.entry(entry.name_hash, 0), 0, entry.value_size, variable, entry.kind == abi::Kind::Scalar};
}

bool Track::has_room_for(std::uint32_t bytes) const noexcept {
  return words_of(bytes) < (mask_ + 1) / kMarks;
}

void Track::offer(std::span<const VariableUse> uses, const vars::Store& store) {
  struct Entry {
    Item item;
    std::uint32_t from = kNowhere;
    VariableUse use;
  };
  offered_.store(nullptr, std::memory_order_relaxed);
  std::vector<Entry> all;
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    const Item& known = items_[i];
    all.push_back({{known.entry, 0, known.size, known.variable, known.scalar},
                   i,
                   {known.variable, i < reads_end_, i >= writes_begin_}});
  }
  bool more = false;
  for (const VariableUse& use : uses) {
    auto found =
        std::find_if(all.begin(), all.end(), [&](const Entry& one) { return one.use.variable == use.variable; });
    if (found == all.end()) {
      all.push_back({item_of(store, use.variable), kNowhere, {use.variable, false, false}});
      found = all.end() - 1;
    }
    more = more || (use.reads && !found->use.reads) || (use.writes && !found->use.writes);
    found->use.reads = found->use.reads || use.reads;
    found->use.writes = found->use.writes || use.writes;
  }
  if (!more) {
    return;
  }
  const auto is_only_read = [](const Entry& one) { return !one.use.writes; };
  const auto is_read = [](const Entry& one) { return one.use.reads; };
  const auto both = std::stable_partition(all.begin(), all.end(), is_only_read);
  const auto only_written = std::stable_partition(both, all.end(), is_read);
  offer_ = std::make_unique<Offer>();
  offer_->writes_begin = static_cast<std::uint32_t>(both - all.begin());
  offer_->reads_end = static_cast<std::uint32_t>(only_written - all.begin());
  std::uint64_t largest = 0;
  for (const Entry& one : all) {
    offer_->items.push_back(one.item);
    offer_->from.push_back(one.from);
    largest = std::max(largest, words_of(one.item.size));
  }
  offer_->copy.resize(largest);
  offered_.store(offer_.get(), std::memory_order_release);
}

// What is new is recorded in the next run, whatever its value is.
void Track::take_offered() noexcept {
  Offer* const offer = offered_.exchange(nullptr, std::memory_order_acq_rel);
  if (offer == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < offer->items.size(); ++i) {
    Item& item = offer->items[i];
    if (offer->from[i] != kNowhere) {
      item.seen = items_[offer->from[i]].seen;
    } else {
      item.seen =
          item.scalar && item.size == sizeof(std::uint64_t) ? ~load_scalar(item.entry, item.size) : ~std::uint64_t{0};
    }
  }
  std::swap(items_, offer->items);
  std::swap(copy_, offer->copy);
  reads_end_ = offer->reads_end;
  writes_begin_ = offer->writes_begin;
}

void Track::note_exchange() noexcept {
  const std::uint32_t before = marks_.load(std::memory_order_acquire);
  marks_.store(other_.load(std::memory_order_acquire) | kExchanged | (before & kOnce), std::memory_order_release);
  other_.store(before & ~kOnce, std::memory_order_release);
  take_offered();
}

void Track::claim(std::uint64_t words) noexcept {
  if (at_ + words > claimed_) {
    claimed_ = at_ + words + kAhead;
    shared_.claimed.store(claimed_, kRelaxed);
    std::atomic_thread_fence(std::memory_order_release);  // before the data that it announces
  }
}

void Track::put(std::uint64_t word) noexcept {
  __atomic_store_n(words_ + (at_ & mask_), word, __ATOMIC_RELAXED);
  ++at_;
}

void Track::put_head(EntryKind kind, std::uint32_t which) noexcept {
  put(std::bit_cast<std::uint64_t>(EntryHead{kind, which}));
}

// A value that writers keep overtaking is recorded the next time.
void Track::record_entry(Item& item, EntryKind kind) noexcept {
  const std::uint64_t length = words_of(item.size);
  if (item.scalar) {
    claim(1 + length);
    put_head(kind, item.variable);
    put(item.seen);
    return;
  }
  copy_[length - 1] = 0;  // the bytes after the value in its last word
  if (!vars::try_read(ring_of(item.entry), item.size, 0, copy_.data(), item.size)) {
    item.seen = ~std::uint64_t{0};
    return;
  }
  claim(1 + length);
  put_head(kind, item.variable);
  for (std::uint64_t i = 0; i < length; ++i) {
    put(copy_[i]);
  }
}

bool Track::record_changed(Item& item, EntryKind kind, bool anyway) noexcept {
  const std::uint64_t now =
      item.scalar ? load_scalar(item.entry, item.size) : ring_of(item.entry).seq.load(std::memory_order_acquire);
  if (now == item.seen && !anyway) [[likely]] {
    return false;
  }
  item.seen = now;
  record_entry(item, kind);
  return true;
}

bool Track::begin() noexcept {
  at_ = head_;
  all_ = all_ || open_;
  open_ = true;
  clock_left_ = kMaxReadings;
  answers_left_ = kMaxAnswers;
  answer_words_left_ = (mask_ + 1) / kAnswerShare;
  order_ = orders_.fetch_add(1, kRelaxed);
  for (std::size_t i = 0; i < reads_end_; ++i) {
    record_changed(items_[i], EntryKind::Before, all_);
  }
  if (shows_open_) {
    shared_.open_order.store(order_, kRelaxed);
    shared_.open_flags.store(marks_.load(kRelaxed), kRelaxed);
    show_open();
  }
  return much(reads_end_, head_);
}

// About a nanosecond for each variable that was checked and for each word that was written since `from`.
bool Track::much(std::size_t checks, std::uint64_t from) const noexcept {
  return checks + (at_ - from) > kStepsPerClockReading;
}

// The words so far belong to the open run, even if its writer dies.
void Track::show_open() noexcept {
  if (shows_open_) {
    shared_.open.store(at_, std::memory_order_release);
  }
}

void Track::clock(std::int64_t ns) noexcept {
  if (open_ && clock_left_ > 0) {
    --clock_left_;
    claim(2);
    put_head(EntryKind::Clock, 0);
    put(static_cast<std::uint64_t>(ns));
    show_open();
  }
}

void Track::record_answer(std::int64_t code, std::span<const std::uint8_t> bytes) noexcept {
  if (!open_ || answers_left_ == 0 || answer_words_left_ < 2) {
    return;
  }
  --answers_left_;
  const std::uint64_t length = words_of(bytes.size());
  const bool fits = 2 + length <= answer_words_left_;
  answer_words_left_ -= 2 + (fits ? length : 0);
  claim(2 + (fits ? length : 0));
  put_head(EntryKind::Answer, fits ? static_cast<std::uint32_t>(bytes.size()) : 0);
  put(static_cast<std::uint64_t>(fits ? code : kTooLongToTell));
  for (std::size_t from = 0; fits && from < bytes.size(); from += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + from, std::min(sizeof word, bytes.size() - from));
    put(word);
  }
  show_open();
}

void Track::end_of_dead(RunTail times) noexcept {
  at_ = shared_.open.load(std::memory_order_acquire);
  if (at_ > head_) {
    order_ = shared_.open_order.load(kRelaxed);
    marks_.store(static_cast<std::uint32_t>(shared_.open_flags.load(kRelaxed)), kRelaxed);
    times.start_ns = std::max(times.start_ns, times.release_ns);
    publish(times, kFaulted);
  }
}

bool Track::end(const RunTail& times, std::uint32_t flags) noexcept {
  const std::uint64_t from = at_ + 1 + kRunWords;
  for (std::size_t i = 0; i < writes_begin_; ++i) {
    record_changed(items_[i], EntryKind::During, false);
  }
  for (std::size_t i = writes_begin_; i < items_.size(); ++i) {
    record_changed(items_[i], EntryKind::After, all_ && i >= reads_end_);
  }
  record_next_again();
  publish(times, flags);
  return much(items_.size(), from);
}

void Track::record_others(const RunTail& times) noexcept {
  at_ = head_;
  bool changed = false;
  for (Item& item : items_) {
    changed = record_changed(item, EntryKind::Before, all_) || changed;
  }
  if (changed) {
    order_ = orders_.fetch_add(1, kRelaxed);
    record_next_again();
    publish(times, 0);
  }
}

void Track::record_next_again() noexcept {
  if (!items_.empty()) {
    again_ = again_ + 1U < items_.size() ? again_ + 1U : 0U;
    Item& item = items_[again_];
    if (item.scalar || ring_of(item.entry).seq.load(kRelaxed) == item.seen) {
      record_entry(item, EntryKind::Again);
    }
  }
}

// Written from available data, and a mark without a division: most runs consist only of this.
void Track::publish(const RunTail& times, std::uint32_t flags) noexcept {
  claim(1 + kRunWords);
  const std::uint32_t marks = marks_.load(std::memory_order_acquire);
  if ((marks & kOnce) != 0) [[unlikely]] {
    marks_.store(marks & ~kOnce, kRelaxed);
  }
  std::uint64_t* const words = words_;
  const std::uint64_t mask = mask_;
  std::uint64_t at = at_;
  const auto write = [&](std::uint64_t word) { __atomic_store_n(words + (at++ & mask), word, __ATOMIC_RELAXED); };
  write(std::bit_cast<std::uint64_t>(EntryHead{EntryKind::Run, flags | marks}));
  // In the order of RunTail.
  static_assert(kRunWords == 6 && offsetof(RunTail, order) == 8 && offsetof(RunTail, tick) == 16 &&
                offsetof(RunTail, release_ns) == 24 && offsetof(RunTail, start_ns) == 32);
  write(number_);
  write(order_);
  write(times.tick);
  write(static_cast<std::uint64_t>(times.release_ns));
  write(static_cast<std::uint64_t>(times.start_ns));
  write(static_cast<std::uint64_t>(times.end_ns));
  if ((head_ ^ at) >> part_shift_ != 0) [[unlikely]] {
    shared_.marks[(at >> part_shift_) % kMarks].store(at, kRelaxed);
  }
  at_ = at;
  head_ = at;
  shared_.runs.store(++number_, kRelaxed);
  shared_.head.store(at, std::memory_order_release);
  all_ = false;
  open_ = false;
}

}  // namespace indurop::tape
