// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/rt/clock.h"

namespace indurop::serve {
namespace {

constexpr double kNsPerSecond = 1e9;

}  // namespace

Feed::Feed(std::uint32_t number, std::string board, std::vector<std::string> names, double rate_hz)
    : number_(number),
      board_(std::move(board)),
      names_(std::move(names)),
      rate_hz_(rate_hz),
      interval_ns_(static_cast<std::int64_t>(kNsPerSecond / rate_hz)),
      record_({}) {}

void Feed::find_items(const vars::Store& store) {
  items_.clear();
  missing_.clear();
  for (const std::string& name : names_) {
    std::vector<std::string> problems;
    auto found = items_named(store, board_, {name}, problems);
    if (found.empty()) {
      missing_.emplace_back(name, problems.empty() ? "there is no such variable" : problems.front());
    }
    std::move(found.begin(), found.end(), std::back_inserter(items_));
  }
  if (names_.size() > 1) {  // a variable that several globs match is sent once
    std::vector<tools::Item> once;
    std::map<std::string, bool, std::less<>> seen;
    for (tools::Item& item : items_) {
      if (seen.emplace(item.name, true).second) {
        once.push_back(std::move(item));
      }
    }
    items_ = std::move(once);
  }
}

void Feed::attach(const Board& board) {
  find_items(*board.store());
  attachment_ = board.attachment();
  layout_ = board.layout();
  record_ = Record(items_);
  changed_.assign(items_.size(), true);
  quality_.assign(items_.size(), Quality::Unread);
  forced_.assign(items_.size(), false);
  keys_.clear();
  for (const tools::Item& item : items_) {
    keys_.push_back(base::Json(item.name).dump());
  }
}

void Feed::read(const vars::Store& store) {
  std::vector<std::uint8_t> bytes;
  const auto forces = store.forces();
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const tools::Item& item = items_[i];
    bytes.resize(item.place.type.size());
    const bool fine = store.read(*item.entry, item.place.offset, bytes).ok();
    forced_[i] = operate::overlay(forces, item, bytes);
    const bool other = fine && record_.set_value(i, bytes);
    changed_[i] = other || quality_[i] == Quality::Unread;
    quality_[i] = fine ? quality_of(store, item) : Quality::Unread;
    record_.set_quality(i, quality_[i], forced_[i]);
  }
  head_.time_ns = store.now().time_since_epoch().count();
}

bool Feed::sample(const Board* board, std::int64_t now_ns) {
  due_ns_ = (now_ns / interval_ns_ + 1) * interval_ns_;
  if (board != nullptr) {
    board->want();
  }
  const vars::Store* const store = board != nullptr ? board->store() : nullptr;
  if (store != nullptr && board->attachment() != attachment_) {
    if (board->layout() != layout_) {
      return false;
    }
    find_items(*store);
    attachment_ = board->attachment();
  }
  if (store != nullptr) {
    read(*store);
  } else {
    std::fill(quality_.begin(), quality_.end(), Quality::Unread);
    changed_.assign(items_.size(), false);
  }
  head_.alive = board != nullptr && board->alive();
  head_.forced = std::find(forced_.begin(), forced_.end(), true) != forced_.end();
  head_.stream = number_;
  head_.seq = ++seq_;
  head_.wall_ns = rt::wall_ns();
  record_.set_head(head_);
  binary_.reset();
  everything_.reset();
  changes_.reset();
  return true;
}

std::string Feed::json(bool all) const {
  std::string out = fmt::format(
      R"({{"type":"values","stream":{},"seq":{},"time_ns":{},"wall_ns":{},"alive":{},"full":{},"values":{{)", number_,
      head_.seq, head_.time_ns, head_.wall_ns, head_.alive, all);
  std::string quality;
  std::string forced;
  bool first = true;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const schema::Type& type = items_[i].place.type;
    if (all || changed_[i]) {
      out += first ? "" : ",";
      out += keys_[i];
      out += ':';
      out += schema::value_to_json(type, record_.value(i, type.size()));
      first = false;
    }
    if (quality_[i] != Quality::Good) {
      quality += fmt::format("{}{}:\"{}\"", quality.empty() ? "" : ",", keys_[i], word_of(quality_[i]));
    }
    if (forced_[i]) {
      forced += (forced.empty() ? "" : ",") + keys_[i];
    }
  }
  out += fmt::format(R"(}},"quality":{{{}}},"forced":[{}]}})", quality, forced);
  return out;
}

SharedMessage Feed::binary() {
  if (!binary_) {
    const auto bytes = record_.bytes();
    binary_ =
        std::make_shared<Message>(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), true);
  }
  return binary_;
}

SharedMessage Feed::everything() {
  if (!everything_) {
    everything_ = std::make_shared<Message>(json(true));
  }
  return everything_;
}

SharedMessage Feed::changes() {
  if (!changes_) {
    changes_ = std::make_shared<Message>(json(false));
  }
  return changes_;
}

base::Json Feed::subscribed(std::uint32_t id, bool binary) const {
  base::Json variables = base::Json::array();
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const tools::Item& item = items_[i];
    base::Json one = base::Json::object();
    one["name"] = item.name;
    one["type"] = schema::display_name(item.place.type);
    one["form"] = form_of(item.place.type);
    one["offset"] = record_.offset(i);
    one["unit"] = item.place.unit;
    variables.push_back(std::move(one));
  }
  base::Json missing = base::Json::array();
  for (const auto& [name, why] : missing_) {
    missing.push_back({{"name", name}, {"message", why}});
  }
  base::Json out = base::Json::object();
  out["type"] = "subscribed";
  out["id"] = id;
  out["stream"] = number_;
  out["board"] = board_;
  out["layout"] = layout_;
  out["rate_hz"] = rate_hz_;
  out["binary"] = binary;
  out["record_size"] = record_.bytes().size();
  out["quality_offset"] = record_.quality_offset();
  out["variables"] = std::move(variables);
  out["missing"] = std::move(missing);
  return out;
}

}  // namespace indurop::serve
