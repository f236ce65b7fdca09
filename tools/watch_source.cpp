// SPDX-License-Identifier: Apache-2.0
#include "tools/watch_source.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "rt/clock.h"
#include "tools/far_values.h"
#include "tools/node_choice.h"
#include "tools/units.h"
#include "vars/shm_file.h"

namespace indurop::tools {
namespace {

// Number of the store's file now, 0 if there is none.
ino_t current_inode(const std::string& node) {
  const std::string path = std::string(vars::kShmDirectory) + "/" + vars::block_file(node);
  struct stat info {};
  return stat(path.c_str(), &info) == 0 ? info.st_ino : 0;
}

}  // namespace

bool WatchSource::open(Context& context, int& code) {
  context.node = node_;
  store_ = open_store(context, vars::Mode::ReadOnly, code);
  if (!store_) {
    return false;
  }
  node_ = name_of_source(context);
  if (context.far_values != nullptr) {
    generation_ = context.far_values->generation();
  } else {
    inode_ = current_inode(node_);
  }
  std::vector<Item> items;
  if (!select_items(context, *store_, names_, items)) {
    code = kFailed;
    return false;
  }
  for (Item& item : items) {
    std::vector<std::uint8_t> bytes(item.place.type.size());
    values_.push_back({std::move(item), std::move(bytes)});
  }
  note_absence(context);
  return true;
}

bool WatchSource::replaced(const Context& context) const {
  return context.far_values != nullptr ? context.far_values->generation() != generation_
                                       : store_->retired() || current_inode(node_) != inode_;
}

void WatchSource::note_absence(const Context& context) {
  if (context.far_values != nullptr) {
    absence_ = context.far_values->absence();
    return;
  }
  const auto& header = store_->header();
  const std::int64_t beat = header.heartbeat_ns.load(std::memory_order_relaxed);
  if (beat != 0) {
    last_beat_ns_ = beat;
  }
  absence_ = store_absence(header);
}

void WatchSource::attach_again(Context& context) {
  auto fresh =
      context.far_values != nullptr ? context.far_values->attach() : vars::Store::attach(node_, vars::Mode::ReadOnly);
  if (!fresh.ok() && context.far_values != nullptr) {
    return;
  }
  if (!fresh.ok()) {
    const std::int64_t age = rt::now_ns() - last_beat_ns_;
    absence_ =
        last_beat_ns_ > 0 && age >= 0 ? fmt::format("not running, last seen {} ago", human_age(age)) : "not running";
    return;
  }
  if (context.far_values != nullptr) {
    generation_ = context.far_values->generation();
  } else {
    inode_ = current_inode(node_);
  }
  ++reconnects_;
  store_ = std::move(fresh).value();
  for (WatchedValue& value : values_) {
    std::string message;
    const auto place = schema::find_place(store_->schema(), value.item.name, message);
    const auto* entry = place.ok() ? store_->find(place.value().variable->name_hash()) : nullptr;
    value.gone = entry == nullptr;
    value.changed = true;
    value.known = false;
    if (!value.gone) {
      value.item.place = place.value();
      value.item.entry = entry;
      value.bytes.assign(value.item.place.type.size(), 0);
    } else {
      context.out.note(fmt::format("node '{}' came back without {}", node_, value.item.name));
    }
  }
  note_absence(context);
}

void WatchSource::sample(Context& context, std::size_t first, std::size_t count) {
  if (replaced(context)) {
    attach_again(context);
  } else {
    note_absence(context);
  }
  const std::size_t end = std::min(values_.size(), first + count);
  std::vector<std::uint8_t> now;
  for (std::size_t i = first; i < end; ++i) {
    WatchedValue& value = values_[i];
    value.changed = false;
    if (value.gone) {
      continue;
    }
    now.resize(value.bytes.size());
    // A value that cannot be read consistently right now is shown in the next round.
    if (!store_->read(*value.item.entry, value.item.place.offset, now).ok()) {
      continue;
    }
    value.known = true;
    if (now != value.bytes) {
      value.bytes.swap(now);
      value.changed = true;
    }
  }
}

bool read_watch_list(Context& context, const std::string& file, std::vector<std::string>& names) {
  std::ifstream in(file);
  if (!in) {
    context.out.error(fmt::format("cannot read {}: {}", file, std::strerror(errno)));
    return false;
  }
  const std::size_t before = names.size();
  for (std::string line; std::getline(in, line);) {
    line = line.substr(0, line.find('#'));
    const auto first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos) {
      names.push_back(line.substr(first, line.find_last_not_of(" \t\r") - first + 1));
    }
  }
  if (names.size() == before) {
    context.out.error(fmt::format("{} names no variable; write one name or glob per line, # begins a comment", file));
    return false;
  }
  return true;
}

}  // namespace indurop::tools
