// SPDX-License-Identifier: Apache-2.0
#include "doors/c/recording.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "history/recording/cdr.h"
#include "history/recording/idl_type.h"
#include "store/operate/item.h"

using indurop::Result;
using indurop::c::Failure;
using indurop::c::RecordedItem;
namespace recording = indurop::recording;
namespace schema = indurop::schema;

namespace {

constexpr std::string_view kOwn = "indurop/";  // channels of runs and keyframes, which are no variables
constexpr std::uint32_t kMostDamages = 1000;   // a recording with more is not described any better by the rest

// The board of a topic with its '/', "sensor/"; empty: the file is of one board.
std::string board_of(std::string_view topic) {
  return std::string(topic.substr(0, topic.rfind('/') + 1));
}

std::optional<schema::Variable> variable_of(const recording::Contents& contents,
                                            const recording::McapChannel& channel) {
  const auto definition = contents.schemas.find(channel.schema);
  const std::string board = board_of(channel.topic);
  if (board.ends_with(kOwn) || channel.encoding != "cdr" || definition == contents.schemas.end()) {
    return std::nullopt;
  }
  auto type = recording::idl_type(definition->second.data, definition->second.name);
  if (!type) {
    return std::nullopt;
  }
  const auto text = [&channel](const char* key) {
    const auto found = channel.metadata.find(key);
    return found == channel.metadata.end() ? std::string() : found->second;
  };
  schema::Variable variable;
  variable.name = channel.topic.substr(board.size());
  variable.type = std::move(type).value();
  variable.type_hash = schema::hash_of(variable.type);
  variable.unit = text("unit");
  variable.description = text("description");
  variable.source = text("declared");
  return variable;
}

irp_code code_of_unreadable(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return IRP_NOT_FOUND;
  }
  return ::access(path.c_str(), R_OK) == 0 ? IRP_CORRUPT : IRP_DENIED;
}

}  // namespace

Result<irp_recording*, Failure> irp_recording::open(const std::string& path) {
  auto reader = recording::McapReader::open(path);
  if (!reader) {
    return Failure{code_of_unreadable(path), std::move(reader).error().text};
  }
  std::unique_ptr<irp_recording> opened(new irp_recording(std::move(reader).value()));
  for (const indurop::base::Problem& damage : opened->contents().damages) {
    opened->damages_.push_back(damage.text);
  }
  opened->find_variables();
  return opened.release();
}

// Channels of one topic and type are one variable: files that were joined may have several. All variables are there
// before one is pointed to.
void irp_recording::find_variables() {
  for (const auto& [id, channel] : contents().channels) {
    auto variable = variable_of(contents(), channel);
    schema::Schema& board = boards_[board_of(channel.topic)];
    if (variable && schema::find_variable(board, variable->name) == nullptr) {
      names_.push_back(channel.topic);
      board.variables.push_back(std::move(variable).value());
    }
  }
  std::sort(names_.begin(), names_.end());
  for (const auto& [id, channel] : contents().channels) {
    add_channel(id, channel);
  }
}

void irp_recording::add_channel(std::uint16_t id, const recording::McapChannel& about) {
  const auto variable = variable_of(contents(), about);
  if (!variable) {
    return;
  }
  const schema::Variable* known = schema::find_variable(boards_[board_of(about.topic)], variable->name);
  if (known->type_hash != variable->type_hash) {
    damages_.push_back(fmt::format("{} has another type in a part of the recording, which is left out", about.topic));
    return;
  }
  channels_[id] = {known, {}};
}

Result<std::uint32_t, Failure> irp_recording::find(const std::string& name) {
  const std::string prefix = board_of(name);
  const auto board = boards_.find(prefix);
  if (board == boards_.end()) {
    return Failure{IRP_NOT_FOUND, fmt::format("no variable '{}' in the recording; there is {}", name,
                                              names_.empty() ? "none" : names_.front())};
  }
  const std::string part = name.substr(prefix.size());
  auto place = schema::find_place(board->second, part);
  if (!place) {
    return Failure{IRP_NOT_FOUND, std::move(place).error().message};
  }
  const std::string full = prefix + indurop::operate::full_name(part, *place);
  const auto [known, is_new] = ids_.emplace(full, static_cast<std::uint32_t>(found_.size()));
  if (is_new) {
    indurop::c::Texts texts = indurop::c::texts_of(full, place->type);
    found_.push_back({std::move(texts), std::move(place).value()});
  }
  return known->second;
}

Result<const RecordedItem*, Failure> irp_recording::found(std::uint32_t id) const {
  if (id >= found_.size()) {
    return Failure{IRP_NOT_FOUND, fmt::format("{} is not an id that irp_recording_find() returned", id)};
  }
  return &found_[id];
}

Result<void, Failure> irp_recording::select(std::span<const std::uint32_t> ids, Period period, bool repeats) {
  std::vector<Column> columns;
  for (const std::uint32_t id : ids) {
    auto item = found(id);
    if (!item) {
      return std::move(item).error();
    }
    columns.push_back({*item, {}});
  }
  columns_ = std::move(columns);
  for (auto& [id, channel] : channels_) {
    channel.selected.clear();
    for (std::uint32_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].item->place.variable == channel.variable) {
        channel.selected.push_back(i);
      }
    }
  }
  period_ = period;
  repeats_ = repeats;
  message_ = nullptr;
  reader_.seek(static_cast<std::uint64_t>(std::max<std::int64_t>(period.from_ns, 0)));
  return {};
}

std::size_t irp_recording::longest_value() const noexcept {
  std::size_t longest = 0;
  for (const Column& column : columns_) {
    longest = std::max<std::size_t>(longest, column.item->place.type.size());
  }
  return longest;
}

void irp_recording::add_damage(std::string text) {
  if (damages_.size() < kMostDamages && std::find(damages_.begin(), damages_.end(), text) == damages_.end()) {
    damages_.push_back(std::move(text));
  }
}

// Takes the next message of a selected variable; returns false after the last one.
bool irp_recording::next_message() {
  for (;;) {
    const auto next = reader_.next();
    if (!next) {
      add_damage(next.error().text);
      continue;
    }
    if (!*next || (*next)->log_time_ns > static_cast<std::uint64_t>(std::max<std::int64_t>(period_.to_ns, 0))) {
      return false;
    }
    const auto channel = channels_.find((*next)->channel);
    if (channel == channels_.end() || channel->second.selected.empty()) {
      continue;
    }
    const Channel& to = channel->second;
    time_ns_ = static_cast<std::int64_t>((*next)->log_time_ns);
    value_.resize(to.variable->type.size());
    if (!recording::from_cdr(to.variable->type, (*next)->data.view, value_)) {
      add_damage(fmt::format("a value of {} is not of its type", to.variable->name));
      continue;
    }
    message_ = &to;
    next_column_ = 0;
    return true;
  }
}

bool irp_recording::next(indurop::c::Sample& to) {
  for (;;) {
    if (message_ == nullptr && !next_message()) {
      return false;
    }
    while (next_column_ < message_->selected.size()) {
      const std::uint32_t which = message_->selected[next_column_++];
      Column& column = columns_[which];
      const schema::Place& place = column.item->place;
      const auto value = std::span(value_).subspan(place.offset, place.type.size());
      if (!repeats_ && std::ranges::equal(column.value, value)) {
        continue;
      }
      column.value.assign(value.begin(), value.end());
      to = {time_ns_, which, value};
      return true;
    }
    message_ = nullptr;
  }
}

irp_code irp_recording_open(const char* path, irp_recording** recording) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (path == nullptr || recording == nullptr) {
      return Failure{IRP_INVALID, "irp_recording_open: an argument is null"};
    }
    *recording = nullptr;
    auto opened = irp_recording::open(path);
    if (!opened) {
      return std::move(opened).error();
    }
    *recording = *opened;
    return {};
  });
}

void irp_recording_close(irp_recording* recording) {
  const std::unique_ptr<irp_recording> closed(recording);
}

size_t irp_recording_count(const irp_recording* recording) {
  return recording == nullptr ? 0 : recording->names().size();
}

const char* irp_recording_name(const irp_recording* recording, size_t index) {
  return index < irp_recording_count(recording) ? recording->names()[index].c_str() : nullptr;
}

irp_code irp_recording_find(irp_recording* recording, const char* name, uint32_t* id) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (recording == nullptr || name == nullptr || id == nullptr) {
      return Failure{IRP_INVALID, "irp_recording_find: an argument is null"};
    }
    auto found = recording->find(name);
    if (!found) {
      return std::move(found).error();
    }
    *id = *found;
    return {};
  });
}

irp_code irp_recording_describe(const irp_recording* recording, uint32_t id, irp_variable* variable) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (recording == nullptr) {
      return Failure{IRP_INVALID, "irp_recording_describe: recording is null"};
    }
    const auto found = recording->found(id);
    if (!found) {
      return found.error();
    }
    return indurop::c::describe((*found)->texts, (*found)->place, variable)
               ? Result<void, Failure>()
               : Failure{IRP_INVALID, "irp_recording_describe: variable is null, or struct_size is not set"};
  });
}

irp_code irp_recording_span(const irp_recording* recording, int64_t* begin_ns, int64_t* end_ns) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (recording == nullptr || begin_ns == nullptr || end_ns == nullptr) {
      return Failure{IRP_INVALID, "irp_recording_span: an argument is null"};
    }
    const auto [begin, end] = recording->contents().span_ns();
    *begin_ns = begin;
    *end_ns = end;
    return {};
  });
}

irp_code irp_recording_select(irp_recording* recording, const uint32_t* ids, size_t count, int64_t from_ns,
                              int64_t to_ns, int repeats) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (recording == nullptr || (ids == nullptr && count != 0)) {
      return Failure{IRP_INVALID, "irp_recording_select: an argument is null"};
    }
    return recording->select({ids, count}, {from_ns, to_ns}, repeats != 0);
  });
}

irp_code irp_recording_read(irp_recording* recording, int64_t* times, uint32_t* which, void* values, size_t stride,
                            size_t max, size_t* taken) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (recording == nullptr || times == nullptr || which == nullptr || values == nullptr || taken == nullptr) {
      return Failure{IRP_INVALID, "irp_recording_read: an argument is null"};
    }
    *taken = 0;
    if (stride < recording->longest_value()) {
      return Failure{IRP_SIZE, fmt::format("values have up to {} bytes, but are {} bytes apart",
                                           recording->longest_value(), stride)};
    }
    for (indurop::c::Sample sample; *taken < max && recording->next(sample); ++*taken) {
      times[*taken] = sample.time_ns;
      which[*taken] = sample.which;
      std::memcpy(static_cast<std::uint8_t*>(values) + *taken * stride, sample.value.data(), sample.value.size());
    }
    return {};
  });
}

const char* irp_recording_damage(const irp_recording* recording, size_t index) {
  return recording == nullptr || index >= recording->damages().size() ? nullptr : recording->damages()[index].c_str();
}
