// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/reported_board.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "deploy/words/node_texts.h"
#include "store/vars/shm_file.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kWantedNs = 5'000'000'000;        // after the last request
constexpr std::int64_t kUnwantedNs = 5'000'000'000;      // interval to find out whether its node runs
constexpr std::int64_t kEveryNs = 250'000'000;           // minimum interval
constexpr std::int64_t kMostBytesPerSecond = 512 << 10;  // maximum of one board
constexpr std::int64_t kValuesLateNs = 1'000'000'000;    // added for the transmission
constexpr std::int64_t kSecondNs = 1'000'000'000;

std::uint64_t next_store() {
  static std::atomic<std::uint64_t> stores{0};
  return ++stores;
}

// Splits the text into the line of JSON at its begin and the rest.
std::optional<std::pair<base::Json, std::string_view>> parts_of(std::string_view text) {
  const auto line = text.find('\n');
  auto head = base::Json::parse(std::string(text.substr(0, line)));
  if (line == std::string_view::npos || !head || !head->is_object()) {
    return std::nullopt;
  }
  return std::pair(std::move(*head), text.substr(line + 1));
}

std::int64_t confirmed_by(std::int64_t freshness, std::int64_t now_ns) {
  if (freshness == deploy::kNeverHeard) {
    return abi::kNeverConfirmed;
  }
  return freshness >= 0 ? now_ns - freshness : -(now_ns + freshness);
}

// Returns the forced names with their values, without the remaining times.
std::string held_by(const base::Json& reported) {
  std::string all;
  for (const base::Json& one : reported.values()) {
    all += fmt::format("{} {} {}\n", one["name"].dump(), one["offset"].dump(), one["value"].dump());
  }
  return all;
}

base::Json shown_forces(const base::Json& reported) {
  base::Json list = base::Json::array();
  for (const base::Json& one : reported.values()) {
    list.push_back({{"name", one["name"]},
                    {"value", one["raw"]},
                    {"left_ns", one["left_ns"]},
                    {"who", one["who"]},
                    {"from", one["from"]},
                    {"reason", one["reason"]},
                    {"lease", one["lease"]}});
  }
  return list;
}

}  // namespace

std::string remote_store_prefix() {
  return fmt::format("remote-{}-b", ::getpid());
}

bool ReportedBoard::knows_variables() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  return store_.has_value();
}

bool ReportedBoard::take_variables(std::string_view text) {
  const auto parts = parts_of(text);
  std::string layout;
  if (!parts || !base::read(parts->first, "layout", layout)) {
    return false;
  }
  auto schema = schema::from_json(parts->second);
  if (!schema) {
    return false;
  }
  std::uint64_t size = 0;
  for (schema::Variable& variable : schema->variables) {
    variable.maxage_ns += variable.maxage_ns > 0 ? kValuesLateNs : 0;
    size += std::min<std::uint64_t>(variable.type.size(), deploy::kMaxValuesBytes + 1);
  }
  if (size > deploy::kMaxValuesBytes) {
    return false;  // no agent reports that much
  }
  const std::string name = remote_store_prefix() + std::to_string(next_store());
  auto fresh = vars::Store::create(name, *schema);
  if (!fresh) {
    return false;
  }
  std::array<std::optional<vars::Store>, kReaders> views;
  for (auto& view : views) {
    auto attached = vars::Store::attach(name, vars::Mode::ReadOnly);
    view = attached ? std::optional(std::move(attached).value()) : std::nullopt;
  }
  (void)vars::remove_shm_file(vars::block_file(name));  // only this process uses it
  const std::lock_guard<std::mutex> guard(mutex_);
  store_ = std::move(fresh).value();
  views_ = std::move(views);
  report_.layout = layout;
  forced_.clear();
  next_ns_ = 0;
  generation_.fetch_add(1, std::memory_order_release);
  return true;
}

ReportedBoard::Taken ReportedBoard::take_values(std::string_view text, std::int64_t now_ns) {
  const auto parts = parts_of(text);
  std::string layout;
  if (!parts || !base::read(parts->first, "layout", layout)) {
    return Taken::Nonsense;
  }
  const std::lock_guard<std::mutex> guard(mutex_);
  if (!store_ || layout != report_.layout) {
    return Taken::OtherVariables;
  }
  const auto& variables = store_->schema().variables;
  std::size_t size = 0;
  for (const schema::Variable& variable : variables) {
    size += sizeof(std::int64_t) + variable.type.size();
  }
  if (size != parts->second.size()) {
    return Taken::Nonsense;
  }
  const base::Json& reported = parts->first["forces"];
  const std::string forced = held_by(reported);
  if (forced != forced_) {
    for (const vars::Force& force : store_->forces()) {
      (void)store_->release(*force.variable, force.offset);
    }
  }
  write(parts->second, now_ns);
  if (forced != forced_) {
    hold(reported);
    forced_ = forced;
  }
  report_.forces = shown_forces(reported);
  report_.lock = parts->first["lock"];
  report_.alarms = parts->first["alarms"];
  report_.values = true;
  node_runs_ = parts->first["running"].boolean().value_or(false);
  next_ns_ = now_ns +
             std::max<std::int64_t>(kEveryNs, static_cast<std::int64_t>(text.size()) * kSecondNs / kMostBytesPerSecond);
  return Taken::Yes;
}

// Forces the same parts in the local store, so that readers see the forces of the board.
void ReportedBoard::hold(const base::Json& forces) {
  for (const base::Json& one : forces.values()) {
    std::string name;
    const auto offset = one["offset"].natural();
    const auto size = one["size"].natural();
    if (!base::read(one, "variable", name) || !offset || !size || *size == 0) {
      continue;
    }
    const auto* const entry = store_->find(abi::fnv1a64(name.data(), name.size()));
    if (entry == nullptr || *offset > entry->value_size || *size > entry->value_size - *offset) {
      continue;
    }
    std::vector<std::uint8_t> bytes(std::bit_floor(std::min<std::uint64_t>(*size, sizeof(std::uint64_t))));
    const auto at = static_cast<std::uint32_t>(*offset);
    if (store_->read(*entry, at, bytes).ok()) {
      (void)store_->force(*entry, at, bytes, vars::kForever);
    }
  }
}

void ReportedBoard::write(std::string_view bytes, std::int64_t now_ns) {
  for (const schema::Variable& variable : store_->schema().variables) {
    std::int64_t freshness = 0;
    std::memcpy(&freshness, bytes.data(), sizeof freshness);
    bytes.remove_prefix(sizeof freshness);
    const std::span value(reinterpret_cast<const std::uint8_t*>(bytes.data()), variable.type.size());
    bytes.remove_prefix(value.size());
    const auto* const entry = store_->find(variable.name_hash());
    void* const place = entry != nullptr ? store_->entry(entry->name_hash, entry->type_hash) : nullptr;
    if (place != nullptr && freshness != deploy::kNotRead) {
      (void)store_->write(*entry, 0, value);
      abi::confirmed_of(place, entry->kind).store(confirmed_by(freshness, now_ns), std::memory_order_release);
    }
  }
}

void ReportedBoard::update(const base::Json& row) {
  const std::lock_guard<std::mutex> guard(mutex_);
  report_.row = row;
  report_.heard = row["heard"].boolean().value_or(false);
  const std::string state = row["state"].text().value_or("");
  // An agent does not control a node that was started by hand; its values show that it runs.
  report_.running = report_.heard && (state == "running" || (report_.values && node_runs_));
  report_.state = !report_.heard ? fmt::format("not heard, last {} ago", human_age(row["age_ns"].integer().value_or(0)))
                  : report_.running ? "running"
                                    : state;
}

void ReportedBoard::silent() {
  const std::lock_guard<std::mutex> guard(mutex_);
  report_.values = false;
  next_ns_ = rt::now_ns() + kSecondNs;
  for (const vars::DirectoryEntry& entry : store_ ? store_->directory() : std::span<const vars::DirectoryEntry>()) {
    auto& confirmed = abi::confirmed_of(store_->entry(entry.name_hash, entry.type_hash), entry.kind);
    if (const std::int64_t was = confirmed.load(std::memory_order_relaxed); was > 0) {
      confirmed.store(-was, std::memory_order_release);
    }
  }
}

bool ReportedBoard::due(std::int64_t now_ns) const {
  const std::lock_guard<std::mutex> guard(mutex_);
  const bool wanted = now_ns - wanted_ns_.load(std::memory_order_relaxed) < kWantedNs;
  return now_ns >= next_ns_ + (wanted ? 0 : kUnwantedNs);
}

Result<vars::Store> ReportedBoard::attach(std::size_t reader) {
  const std::lock_guard<std::mutex> guard(mutex_);
  if (!store_) {
    return Error{Errc::NotFound, 0, "variables of the board"};
  }
  if (!views_.at(reader)) {
    return Error{Errc::Busy, 0, "variables of the board"};
  }
  vars::Store view = std::move(*views_[reader]);
  views_[reader].reset();
  return view;
}

ReportedBoard::Report ReportedBoard::report() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  return report_;
}

}  // namespace indurop::tools
