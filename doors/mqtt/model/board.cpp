// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/model/board.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

#include "core/schema/leaf.h"
#include "doors/mqtt/model/form.h"

namespace indurop::mqtt {
namespace {

constexpr std::size_t kHeadSize = 40;
constexpr std::uint8_t kQualityBits = 3;
constexpr std::uint8_t kForcedBit = 4;

template <class T>
T read_at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// Appends the leaves of a type at `offset`; stops beyond the most that are listed.
void add_leaves(std::vector<Leaf>& to, const schema::Type& type, std::size_t dim, const std::string& name,
                std::uint32_t offset, const std::string& unit) {
  if (to.size() > Board::kMostLeaves) {
    return;
  }
  if (dim < type.dims.size()) {
    const auto stride = static_cast<std::uint32_t>(schema::stride_of(type, dim));
    for (std::uint32_t i = 0; i < type.dims[dim] && to.size() <= Board::kMostLeaves; ++i) {
      add_leaves(to, type, dim + 1, fmt::format("{}[{}]", name, i), offset + i * stride, unit);
    }
    return;
  }
  if (type.base != schema::Base::Struct) {
    to.push_back({name, offset, type.element_size, type.base, unit});
    return;
  }
  for (const schema::Field& field : type.fields) {
    add_leaves(to, field.type, 0, name + "." + field.name, offset + field.offset,
               field.unit.empty() ? unit : field.unit);
  }
}

double deadband_of(const std::string& name, const std::vector<Deadband>& deadbands) {
  for (const Deadband& one : deadbands) {
    if (schema::glob_match(one.pattern, name)) {
      return one.distance;
    }
  }
  return 0;
}

std::optional<Variable> variable_of(const base::Json& json, const std::vector<Deadband>& deadbands) {
  auto type = type_of(json["form"]);
  const auto offset = json["offset"].natural();
  if (!type || !offset) {
    return std::nullopt;
  }
  Variable variable;
  variable.name = json["name"].text().value_or("");
  variable.size = type->size();
  variable.offset = *offset;
  variable.unit = json["unit"].text().value_or("");
  variable.deadband = deadband_of(variable.name, deadbands);
  add_leaves(variable.leaves, *type, 0, variable.name, 0, variable.unit);
  if (variable.leaves.size() > Board::kMostLeaves) {
    variable.leaves.clear();
  }
  variable.type = std::move(*type);
  return variable;
}

// Returns true if a leaf has left its deadband; values that are no numbers do with any difference.
bool has_moved(const Leaf& leaf, double deadband, const std::uint8_t* before, const std::uint8_t* now) {
  if (deadband <= 0 || leaf.base == schema::Base::Bool || leaf.base == schema::Base::Enum) {
    return true;
  }
  const auto from = schema::as_number<double>(leaf.base, before);
  const auto to = schema::as_number<double>(leaf.base, now);
  return !from || !to || !(std::abs(*to - *from) <= deadband);  // also if one is not a number
}

}  // namespace

const char* word_of(Quality quality) noexcept {
  constexpr std::array kWords{"good", "stale", "silent", "unread", "stopped"};
  return kWords.at(static_cast<std::size_t>(quality));
}

std::optional<Frame> read_frame(std::string_view bytes) {
  constexpr std::size_t kFlagsAt = 2;
  constexpr std::size_t kStreamAt = 4;
  constexpr std::size_t kTimeAt = 16;
  constexpr std::size_t kWallAt = 24;
  if (bytes.size() < kHeadSize || bytes[0] != 1 || bytes[1] != 1) {
    return std::nullopt;
  }
  return Frame{read_at<std::uint32_t>(bytes, kStreamAt), (read_at<std::uint16_t>(bytes, kFlagsAt) & 1U) != 0,
               read_at<std::int64_t>(bytes, kTimeAt), read_at<std::int64_t>(bytes, kWallAt), bytes};
}

Result<Board, base::Problem> Board::from(const base::Json& subscribed, const std::vector<Deadband>& deadbands) {
  Board board;
  board.name_ = subscribed["board"].text().value_or("");
  board.stream_ = static_cast<std::uint32_t>(subscribed["stream"].natural().value_or(0));
  board.record_size_ = subscribed["record_size"].natural().value_or(0);
  board.quality_offset_ = subscribed["quality_offset"].natural().value_or(0);
  const base::Problem wrong{fmt::format("the server's description of board {} is not understood", board.name_)};
  for (const base::Json& one : subscribed["variables"].values()) {
    auto variable = variable_of(one, deadbands);
    if (!variable || variable->offset + variable->size > board.quality_offset_) {
      return wrong;
    }
    board.variables_.push_back(std::move(*variable));
  }
  if (board.quality_offset_ < kHeadSize || board.record_size_ < board.quality_offset_ + board.variables_.size()) {
    return wrong;
  }
  return board;
}

std::vector<Change> Board::update(const Frame& frame) {
  std::vector<Change> changes;
  if (frame.stream != stream_ || frame.bytes.size() != record_size_) {
    return changes;
  }
  const auto* const now = reinterpret_cast<const std::uint8_t*>(frame.bytes.data());
  const bool first = bytes_.empty() || alive_ != frame.alive;
  if (bytes_.empty()) {
    bytes_.assign(now, now + record_size_);
  }
  alive_ = frame.alive;
  time_ns_ = frame.time_ns;
  wall_ns_ = frame.wall_ns;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Variable& variable = variables_[i];
    std::uint8_t* const mine = bytes_.data() + variable.offset;
    const std::uint8_t* const theirs = now + variable.offset;
    std::uint8_t& quality = bytes_[quality_offset_ + i];
    const bool other_quality = quality != now[quality_offset_ + i];
    if (!first && !other_quality && std::memcmp(mine, theirs, variable.size) == 0) {
      continue;
    }
    Change change{i, first || other_quality, {}};
    bool moved = first || other_quality || variable.leaves.empty();
    for (std::size_t leaf = 0; leaf < variable.leaves.size(); ++leaf) {
      const Leaf& one = variable.leaves[leaf];
      const bool differs = std::memcmp(mine + one.offset, theirs + one.offset, one.size) != 0;
      if (first || differs || other_quality) {
        change.leaves.push_back(leaf);
      }
      moved = moved || (differs && has_moved(one, variable.deadband, mine + one.offset, theirs + one.offset));
    }
    if (moved) {
      std::memcpy(mine, theirs, variable.size);
      quality = now[quality_offset_ + i];
      changes.push_back(std::move(change));
    }
  }
  return changes;
}

std::span<const std::uint8_t> Board::value(std::size_t variable) const {
  const Variable& one = variables_[variable];
  return std::span(bytes_).subspan(one.offset, one.size);
}

std::span<const std::uint8_t> Board::value(std::size_t variable, const Leaf& leaf) const {
  return value(variable).subspan(leaf.offset, leaf.size);
}

Quality Board::quality(std::size_t variable) const {
  return alive_ ? static_cast<Quality>(bytes_[quality_offset_ + variable] & kQualityBits) : Quality::Stopped;
}

bool Board::is_forced(std::size_t variable) const {
  return (bytes_[quality_offset_ + variable] & kForcedBit) != 0;
}

}  // namespace indurop::mqtt
