// SPDX-License-Identifier: Apache-2.0
#include "recorder/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

namespace indurop::recorder {
namespace {

using base::Problem;
namespace fs = std::filesystem;

constexpr std::int64_t kShares = 8;  // parts of what is kept

fs::path part_of(const fs::path& path, std::uint64_t number) {
  fs::path part = path;
  return part.replace_filename(fmt::format("{}.{:04}{}", path.stem().string(), number, path.extension().string()));
}

// A part of a recording of this name, whoever made it; empty: there is none.
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

Result<Parts, Problem> Parts::create(const fs::path& path, const Limits& limits, const About& about,
                                     const vars::Store& store, tape::Follower follower,
                                     const std::vector<std::string>& globs) {
  if (limits.in_parts()) {
    if (const fs::path other = find_part(path); !other.empty()) {
      return Problem{fmt::format("{} exists already, a part of another recording; remove it, or give another name",
                                 other.string())};
    }
  }
  auto recorder =
      Recorder::create(limits.in_parts() ? part_of(path, 1) : path, about, store, std::move(follower), globs);
  if (!recorder) {
    return std::move(recorder).error();
  }
  Parts parts(path, limits, std::move(recorder).value());
  Limits& own = parts.limits_;
  if (limits.in_parts() && limits.split_ns == 0 && limits.split_bytes == 0) {
    own.split_ns = limits.keep_ns / kShares;
    own.split_bytes = limits.keep_bytes / kShares;
  }
  if (limits.in_parts()) {
    parts.recorder_.remember();
  }
  return parts;
}

fs::path Parts::path_of(std::uint64_t number) const {
  return limits_.in_parts() ? part_of(path_, number) : path_;
}

bool Parts::remove_oldest() {
  if (closed_.empty() || (limits_.keep_ns == 0 && limits_.keep_bytes == 0)) {
    return false;
  }
  std::error_code ignored;  // somebody else took it away
  fs::remove(closed_.front().path, ignored);
  closed_.pop_front();
  ++removed_;
  return true;
}

void Parts::remove_old_ones() {
  while (!closed_.empty() &&
         ((limits_.keep_ns > 0 && closed_.front().end_ns < recorder_.latest_ns() - limits_.keep_ns) ||
          (limits_.keep_bytes > 0 && bytes() > limits_.keep_bytes))) {
    remove_oldest();
  }
}

// Once more for each part that makes room.
template <class Work>
Result<void, Problem> Parts::with_room(const Work& work) {
  auto done = work();
  while (!done && remove_oldest()) {
    done = work();
  }
  return done;
}

bool Parts::part_is_full() const noexcept {
  return (limits_.split_ns > 0 && recorder_.latest_ns() - begin_ns_ >= limits_.split_ns) ||
         (limits_.split_bytes > 0 && recorder_.bytes() >= limits_.split_bytes);
}

Result<void, Problem> Parts::begin_next() {
  if (auto closed = close(); !closed) {
    return closed;
  }
  std::error_code ignored;
  const fs::path full = path_of(number_);
  const std::uint64_t bytes = fs::file_size(full, ignored);
  closed_.push_back({full, recorder_.latest_ns(), ignored ? 0 : bytes});
  begin_ns_ = recorder_.latest_ns();
  const fs::path next = path_of(++number_);
  return with_room([&] { return recorder_.go_on_in(next); });
}

Result<void, Problem> Parts::take() {
  if (auto taken = with_room([this] { return recorder_.take(); }); !taken) {
    return taken;
  }
  if (begin_ns_ == 0) {
    begin_ns_ = recorder_.latest_ns();
  }
  if (part_is_full()) {
    if (auto next = begin_next(); !next) {
      return next;
    }
  }
  remove_old_ones();
  return {};
}

Result<void, Problem> Parts::flush() {
  return with_room([this] { return recorder_.flush(); });
}

Result<void, Problem> Parts::close() {
  return with_room([this] { return recorder_.close(); });
}

std::string Parts::files() const {
  const std::string last = path_of(number_).string();
  return closed_.empty() ? last : fmt::format("{} ... {}", closed_.front().path.string(), last);
}

std::uint64_t Parts::bytes() const noexcept {
  std::uint64_t sum = recorder_.bytes();
  for (const Part& part : closed_) {
    sum += part.bytes;
  }
  return sum;
}

}  // namespace indurop::recorder
