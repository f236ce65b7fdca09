// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/watch_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/base/read_file.h"
#include "core/base/text.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
Result<void, Failure> WatchSource::open(Access& access) {
  access.node = node_;
  auto store = open_store(access, vars::Mode::ReadOnly, names_);
  if (!store.ok()) {
    return std::move(store).error();
  }
  store_ = std::move(store).value();
  node_ = access.values->title();
  generation_ = access.values->generation();
  std::vector<Item> items;
  if (const int code = select_items(access, *store_, names_, items); code != kOk) {
    return Failure{code, {}};
  }
  for (Item& item : items) {
    std::vector<std::uint8_t> bytes(item.place.type.size());
    values_.push_back({std::move(item), std::move(bytes)});
  }
  absence_ = access.values->absence(&*store_);
  return {};
}

void WatchSource::attach_again(Access& access) {
  auto fresh = access.values->attach();
  if (!fresh.ok()) {
    absence_ = access.values->absence(nullptr);
    return;
  }
  generation_ = access.values->generation();
  ++reconnects_;
  store_ = std::move(fresh).value();
  for (WatchedValue& value : values_) {
    const auto place = schema::find_place(store_->schema(), value.item.name);
    const auto* entry = place.ok() ? store_->find(place.value().variable->name_hash()) : nullptr;
    value.gone = entry == nullptr;
    value.changed = true;
    value.known = false;
    if (!value.gone) {
      value.item.place = place.value();
      value.item.entry = entry;
      value.bytes.assign(value.item.place.type.size(), 0);
    } else {
      access.messages->note(fmt::format("node '{}' came back without {}", node_, value.item.name));
    }
  }
  absence_ = access.values->absence(&*store_);
}

void WatchSource::sample(Access& access, std::size_t first, std::size_t count) {
  if (store_->retired() || store_->grown() || access.values->generation() != generation_) {
    attach_again(access);
  } else {
    absence_ = access.values->absence(&*store_);
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
    // A value that cannot be read consistently now is shown in the next round.
    if (!store_->read(*value.item.entry, value.item.place.offset, now).ok()) {
      continue;
    }
    value.changed = !std::exchange(value.known, true) || now != value.bytes;  // the first value counts as changed, zero
                                                                              // or not
    value.bytes.swap(now);
  }
}

bool read_watch_list(Messages& messages, const std::string& file, std::vector<std::string>& names) {
  const auto text = base::read_file(file);
  if (!text) {
    messages.error(base::cannot_read(file, text.error()));
    return false;
  }
  std::istringstream in(*text);
  const std::size_t before = names.size();
  for (std::string line; std::getline(in, line);) {
    const std::string_view name = base::trimmed(std::string_view(line).substr(0, line.find('#')));
    if (!name.empty()) {
      names.emplace_back(name);
    }
  }
  if (names.size() == before) {
    messages.error(fmt::format("{} names no variable; write one name or glob per line, # begins a comment", file));
    return false;
  }
  return true;
}

}  // namespace indurop::tools
