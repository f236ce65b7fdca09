// SPDX-License-Identifier: Apache-2.0
#include "doors/c/stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/rt/clock.h"

using indurop::Result;
using indurop::c::Failure;
namespace rt = indurop::rt;
namespace tape = indurop::tape;

namespace {

// A run becomes visible when it ends: one that began earlier and ends later may still come within this time.
constexpr std::int64_t kPatienceNs = 20'000'000;
constexpr std::int64_t kPollNs = 1'000'000;
constexpr std::size_t kHead = sizeof(std::uint64_t) + sizeof(std::int64_t);  // tick and time

bool has(std::span<const std::uint32_t> indices, std::uint32_t one) {
  return std::find(indices.begin(), indices.end(), one) != indices.end();
}

Failure not_on_tape(const std::string& name) {
  return {IRP_NOT_FOUND, fmt::format("{} is too large for the tape; start the node with a larger --tape", name)};
}

}  // namespace

Result<irp_stream*, Failure> irp_stream::open(const irp_node& node, std::span<const std::uint32_t> ids, bool past) {
  auto follower = tape::Follower::open(node.name(), past);
  if (!follower) {
    return indurop::c::failure_of(follower.error(), fmt::format("tape of node '{}'", node.name()));
  }
  std::unique_ptr<irp_stream> stream(new irp_stream(node, std::move(follower).value()));
  if (!stream->follower_.is_of(node.store())) {
    return node.changed();
  }
  for (const std::uint32_t id : ids) {
    if (auto added = stream->add_column(id); !added) {
      return std::move(added).error();
    }
  }
  if (!past) {
    if (auto taken = stream->take_present_values(); !taken) {
      return std::move(taken).error();
    }
  }
  return stream.release();
}

Result<void, Failure> irp_stream::add_column(std::uint32_t id) {
  auto found = node_.found(id);
  if (!found) {
    return std::move(found).error();
  }
  const indurop::operate::Item& item = (*found)->item;
  const auto variable = static_cast<std::uint32_t>(item.entry - node_.store().directory().data());
  if (variable >= follower_.variables().size()) {
    return Failure{IRP_NOT_FOUND,
                   fmt::format("{} appeared while the node runs; its tape has it after a restart", item.name)};
  }
  if (follower_.variables()[variable].taped == 0) {
    return not_on_tape(item.name);
  }
  Column column{variable, item.place.offset, std::vector<std::uint8_t>(item.place.type.size())};
  std::memcpy(column.bytes.data(), follower_.first_value(variable).data() + column.offset, column.bytes.size());
  std::vector<std::size_t> writers;
  std::optional<std::size_t> reader;
  for (std::size_t number = 0; number < follower_.tracks(); ++number) {
    if (has(follower_.items_of(number).written, variable)) {
      writers.push_back(number);
    } else if (!reader && has(follower_.items_of(number).only_read, variable)) {
      reader = number;
    }
  }
  if (writers.empty() && reader) {
    writers.push_back(*reader);
  }
  if (writers.empty()) {
    return not_on_tape(item.name);
  }
  for (const std::size_t number : writers) {
    track(number).columns.push_back(columns_.size());
  }
  columns_.push_back(std::move(column));
  return {};
}

irp_stream::Track& irp_stream::track(std::size_t number) {
  const auto known =
      std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& one) { return one.number == number; });
  if (known != tracks_.end()) {
    return *known;
  }
  tracks_.emplace_back();
  tracks_.back().number = number;
  return tracks_.back();
}

// The follower is at the end of the tape already, so runs that end while the values are read come as well. They are
// applied without a row.
Result<void, Failure> irp_stream::take_present_values() {
  for (Column& column : columns_) {
    const auto& entry = node_.store().directory()[column.variable];
    if (const auto read = node_.store().read(entry, column.offset, column.bytes); !read) {
      return indurop::c::failure_of(read.error(), node_.name());
    }
  }
  from_ns_ = rt::to_ns(node_.store().now());
  return {};
}

Result<void, Failure> irp_stream::fits(const RowForm& form) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::size_t size = columns_[i].bytes.size();
    if (form.offsets[i] < kHead || form.offsets[i] > form.size || size > form.size - form.offsets[i]) {
      return Failure{
          IRP_SIZE, fmt::format("value {} of {} bytes at byte {} exceeds a row of {} bytes, or its head of {}", i, size,
                                form.offsets[i], form.size, kHead)};
    }
  }
  return form.size >= kHead ? Result<void, Failure>()
                            : Failure{IRP_SIZE, fmt::format("a row has {} bytes or more", kHead)};
}

// Returns the track with the run that ended first, if no earlier one can come any more.
irp_stream::Track* irp_stream::earliest() {
  Track* first = nullptr;
  bool complete = true;
  for (Track& one : tracks_) {
    one.has_run = one.has_run || follower_.next(one.number, one.run);
    complete = complete && one.has_run;
    if (one.has_run && (first == nullptr || one.run.tail.end_ns < first->run.tail.end_ns)) {
      first = &one;
    }
  }
  const bool settled =
      complete || (first != nullptr && rt::to_ns(node_.store().now()) - first->run.tail.end_ns > kPatienceNs);
  return settled ? first : nullptr;
}

void irp_stream::apply(const Track& track) {
  for (const tape::Value& value : track.run.values) {
    for (const std::size_t i : track.columns) {
      Column& column = columns_[i];
      if (column.variable == value.variable && value.bytes.size() >= column.offset + column.bytes.size()) {
        std::memcpy(column.bytes.data(), value.bytes.data() + column.offset, column.bytes.size());
      }
    }
  }
}

bool irp_stream::next(const RowForm& form, std::uint8_t* row) {
  for (Track* one = earliest(); one != nullptr; one = earliest()) {
    apply(*one);
    one->has_run = false;
    const tape::RunTail& tail = one->run.tail;
    if (tail.end_ns <= from_ns_) {
      continue;
    }
    std::memcpy(row, &tail.tick, sizeof tail.tick);
    std::memcpy(row + sizeof tail.tick, &tail.end_ns, sizeof tail.end_ns);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      std::memcpy(row + form.offsets[i], columns_[i].bytes.data(), columns_[i].bytes.size());
    }
    return true;
  }
  return false;
}

bool irp_stream::has_runs() const noexcept {
  return std::any_of(tracks_.begin(), tracks_.end(), [](const Track& one) { return one.has_run; });
}

std::uint64_t irp_stream::lost() const noexcept {
  std::uint64_t lost = 0;
  for (const Track& one : tracks_) {
    lost += follower_.lost(one.number);
  }
  return lost;
}

irp_code irp_stream_open(const irp_node* node, const uint32_t* ids, size_t count, int past, irp_stream** stream) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || ids == nullptr || count == 0 || stream == nullptr) {
      return Failure{IRP_INVALID, "irp_stream_open: an argument is null, or there is no variable"};
    }
    *stream = nullptr;
    auto opened = irp_stream::open(*node, {ids, count}, past != 0);
    if (!opened) {
      return std::move(opened).error();
    }
    *stream = *opened;
    return {};
  });
}

void irp_stream_close(irp_stream* stream) {
  const std::unique_ptr<irp_stream> closed(stream);
}

irp_code irp_stream_read(irp_stream* stream, void* rows, size_t row_size, const size_t* offsets, size_t max,
                         int64_t timeout_ns, size_t* taken) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (stream == nullptr || rows == nullptr || offsets == nullptr || taken == nullptr || timeout_ns < 0) {
      return Failure{IRP_INVALID, "irp_stream_read: an argument is null, or the time is negative"};
    }
    *taken = 0;
    const irp_stream::RowForm form{row_size, {offsets, stream->columns()}};
    if (auto fits = stream->fits(form); !fits) {
      return fits;
    }
    for (const std::int64_t begin = rt::now_ns();;) {
      const Result<void, Failure> running = stream->node().running();  // before the rows: after its end no more come
      while (*taken < max && stream->next(form, static_cast<std::uint8_t*>(rows) + *taken * row_size)) {
        ++*taken;
      }
      if (*taken != 0 || max == 0) {
        return {};
      }
      if (!running && !stream->has_runs()) {
        return running;
      }
      const std::int64_t left = timeout_ns - (rt::now_ns() - begin);
      if (left <= 0) {
        return Failure{IRP_TIMEOUT, "no run within this time"};
      }
      rt::sleep_until(rt::now_ns() + std::min(left, kPollNs));
    }
  });
}

uint64_t irp_stream_lost(const irp_stream* stream) {
  return stream == nullptr ? 0 : stream->lost();
}
