// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

namespace indurop::recorder {
namespace {

using base::Problem;
namespace fs = std::filesystem;

constexpr std::int64_t kShares = 8;               // number of parts in the kept data
constexpr std::int64_t kPortionNs = 100'000'000;  // time taken before the next check whether the part is full
constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();  // earlier than any run: they are only read

fs::path part_of(const fs::path& path, std::uint64_t number) {
  fs::path part = path;
  return part.replace_filename(fmt::format("{}.{:04}{}", path.stem().string(), number, path.extension().string()));
}

// Returns a part of a recording of this name, by any program; empty: there is none.
fs::path find_part(const fs::path& path) {
  const std::string before = path.stem().string() + ".";
  const std::string after = path.extension().string();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) {
      continue;
    }
    const std::string number = name.substr(before.size(), name.size() - before.size() - after.size());
    if (std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
      return entry.path();
    }
  }
  return {};
}

}  // namespace

Result<Parts, Problem> Parts::create(const fs::path& path, const Limits& limits, std::vector<Taped> nodes,
                                     const std::vector<std::string>& globs) {
  if (limits.in_parts()) {
    if (const fs::path other = find_part(path); !other.empty()) {
      return Problem{fmt::format("{} exists already, a part of another recording; remove it, or give another name",
                                 other.string())};
    }
  }
  std::vector<Recorder> recorders;
  std::vector<bool> matched(globs.size(), false);
  for (Taped& node : nodes) {
    auto recorder =
        Recorder::create_one_of(node.prefix, node.about, *node.store, std::move(node.follower), globs, matched);
    if (!recorder) {
      return std::move(recorder).error();
    }
    if (limits.in_parts()) {
      recorder->remember();
    }
    recorders.push_back(std::move(recorder).value());
  }
  if (const auto none = std::find(matched.begin(), matched.end(), false); none != matched.end()) {
    const std::string& glob = globs[static_cast<std::size_t>(none - matched.begin())];
    return Problem{nodes.size() == 1
                       ? fmt::format("node {} has no variable '{}'; see indurop vars", nodes.front().about.node, glob)
                       : fmt::format("no board has a variable '{}'; see indurop vars", glob)};
  }
  Parts parts(path, limits, std::move(recorders));
  if (limits.in_parts() && limits.split_ns == 0 && limits.split_bytes == 0) {
    parts.limits_.split_ns = limits.keep_ns / kShares;
    parts.limits_.split_bytes = limits.keep_bytes / kShares;
  }
  if (auto begun = parts.begin(1); !begun) {
    return std::move(begun).error();
  }
  return parts;
}

void Parts::learn() {
  for (Recorder& recorder : recorders_) {
    recorder.learn();
  }
}

std::int64_t Parts::latest_ns() const noexcept {
  std::int64_t latest = 0;
  for (const Recorder& recorder : recorders_) {
    latest = std::max(latest, recorder.latest_ns());
  }
  return latest;
}

// Removes a part that could not be begun.
Result<void, Problem> Parts::begin(std::uint64_t number) {
  const fs::path path = path_of(number);
  auto writer = recording::McapWriter::create(path, {});
  if (!writer) {
    return std::move(writer).error();
  }
  writer_ = std::make_shared<recording::McapWriter>(std::move(writer).value());
  for (Recorder& recorder : recorders_) {
    if (auto begun = recorder.go_on_in(writer_, limits_.in_parts() ? number : 0); !begun) {
      std::error_code ignored;
      fs::remove(path, ignored);
      return begun;
    }
  }
  return {};
}

fs::path Parts::path_of(std::uint64_t number) const {
  return limits_.in_parts() ? part_of(path_, number) : path_;
}

bool Parts::remove_oldest() {
  if (closed_.empty() || (limits_.keep_ns == 0 && limits_.keep_bytes == 0)) {
    return false;
  }
  std::error_code ignored;  // another process has removed it
  fs::remove(closed_.front().path, ignored);
  closed_.pop_front();
  ++removed_;
  return true;
}

void Parts::remove_old_ones() {
  while (!closed_.empty() && ((limits_.keep_ns > 0 && closed_.front().end_ns < latest_ns() - limits_.keep_ns) ||
                              (limits_.keep_bytes > 0 && bytes() > limits_.keep_bytes))) {
    remove_oldest();
  }
}

// Tries again for each part that is deleted. After any disk error other than a full disk, parts are kept.
template <class Work>
Result<void, Problem> Parts::with_room(const Work& work) {
  const auto full = [](int error) { return error == ENOSPC || error == EDQUOT; };
  auto done = work();
  while (!done && full(done.error().sys_errno) && remove_oldest()) {
    done = work();
  }
  return done;
}

bool Parts::part_is_full() const noexcept {
  return (limits_.split_ns > 0 && latest_ns() - begin_ns_ >= limits_.split_ns) ||
         (limits_.split_bytes > 0 && writer_->size() >= limits_.split_bytes);
}

Result<void, Problem> Parts::begin_next() {
  if (auto closed = close(); !closed) {
    return closed;
  }
  std::error_code ignored;
  const fs::path full = path_of(number_);
  const std::uint64_t bytes = fs::file_size(full, ignored);
  closed_.push_back({full, latest_ns(), ignored ? 0 : bytes});
  begin_ns_ = latest_ns();
  ++number_;
  return with_room([this] { return begin(number_); });
}

Result<void, Problem> Parts::take_until(std::int64_t until_ns) {
  for (Recorder& recorder : recorders_) {
    if (auto taken = with_room([&recorder, until_ns] { return recorder.take(until_ns); }); !taken) {
      return taken;
    }
  }
  return {};
}

// A part is begun only when there is a run for it: one without runs could not be replayed.
Result<void, Problem> Parts::begin_next_if_needed() {
  if (!part_is_full()) {
    return {};
  }
  if (auto read = take_until(kNone); !read) {
    return read;
  }
  return waiting_ns() ? begin_next() : Result<void, Problem>{};
}

// Takes a limited time span, so that a part does not grow too large when there is much data at once, after a stall.
Result<void, Problem> Parts::take_portion(std::int64_t until_ns) {
  if (auto begun = begin_next_if_needed(); !begun) {
    return begun;
  }
  if (auto taken = take_until(until_ns); !taken) {
    return taken;
  }
  if (begin_ns_ == 0) {
    begin_ns_ = latest_ns();
  }
  remove_old_ones();
  return {};
}

Result<void, Problem> Parts::take() {
  if (!limits_.in_parts()) {
    return take_portion(std::numeric_limits<std::int64_t>::max());
  }
  for (std::optional<std::int64_t> from = latest_ns(); from; from = waiting_ns()) {
    if (auto taken = take_portion(*from + kPortionNs); !taken) {
      return taken;
    }
  }
  return {};
}

std::optional<std::int64_t> Parts::waiting_ns() const noexcept {
  std::optional<std::int64_t> first;
  for (const Recorder& recorder : recorders_) {
    if (const auto waiting = recorder.waiting_ns()) {
      first = std::min(first.value_or(*waiting), *waiting);
    }
  }
  return first;
}

Result<void, Problem> Parts::flush() {
  if (auto flushed = with_room([this] { return writer_->flush(); }); !flushed) {
    return flushed;
  }
  return writer_->begin_sync();
}

Result<void, Problem> Parts::attach(std::size_t node, std::string_view name, std::string_view text) {
  return with_room([&] { return recorders_[node].attach(name, text); });
}

Result<void, Problem> Parts::close() {
  for (Recorder& recorder : recorders_) {
    if (auto concluded = with_room([&recorder] { return recorder.conclude(); }); !concluded) {
      return concluded;
    }
  }
  return with_room([this] { return writer_->close(); });
}

std::string Parts::files() const {
  const std::string last = path_of(number_).string();
  return closed_.empty() ? last : fmt::format("{} ... {}", closed_.front().path.string(), last);
}

std::uint64_t Parts::bytes() const noexcept {
  std::uint64_t sum = writer_->size();
  for (const Part& part : closed_) {
    sum += part.bytes;
  }
  return sum;
}

}  // namespace indurop::recorder
