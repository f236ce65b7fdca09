// SPDX-License-Identifier: Apache-2.0
// A feed: variables of a board at a rate, sampled and encoded once for all clients that request the same.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/serve/boards/board.h"
#include "tools/serve/boards/variable.h"
#include "tools/serve/door/house.h"
#include "tools/serve/stream/record.h"

namespace indurop::serve {

class Feed {
 public:
  Feed(std::uint32_t number, std::string board, std::vector<std::string> names, double rate_hz);

  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }
  [[nodiscard]] const std::string& board() const noexcept { return board_; }
  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
  [[nodiscard]] std::uint64_t seq() const noexcept { return seq_; }
  [[nodiscard]] bool due(std::int64_t now_ns) const noexcept { return now_ns >= due_ns_; }
  [[nodiscard]] std::int64_t due_ns() const noexcept { return due_ns_; }

  // Finds the names in the board's store. To be called once, before anything else.
  void attach(const Board& board);
  // Takes the next sample and computes when the following one is due. `board`: refreshed, null if there is none.
  // Returns false if the layout has changed: this feed has ended.
  bool sample(const Board* board, std::int64_t now_ns);

  // These four return values of the last sample.
  [[nodiscard]] const tools::Item& item(std::size_t i) const { return items_[i]; }
  [[nodiscard]] std::span<const std::uint8_t> value(std::size_t i) const {
    return record_.value(i, items_[i].place.type.size());
  }
  [[nodiscard]] bool readable(std::size_t i) const { return head_.alive && quality_[i] != Quality::Unread; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept { return head_.wall_ns; }

  // The sample as a message, encoded when it is first requested. changes() is relative to the previous sample.
  SharedMessage binary();
  SharedMessage everything();
  SharedMessage changes();
  // The answer {"type": "subscribed", ...}.
  [[nodiscard]] base::Json subscribed(std::uint32_t id, bool binary) const;

 private:
  void find_items(const vars::Store& store);
  void read(const vars::Store& store);
  [[nodiscard]] std::string json(bool all) const;

  std::uint32_t number_;
  std::string board_;
  std::vector<std::string> names_;
  double rate_hz_;
  std::int64_t interval_ns_;
  std::int64_t due_ns_ = 0;
  std::string layout_;
  std::uint64_t attachment_ = 0;
  std::vector<tools::Item> items_;
  std::vector<std::string> keys_;                             // names as JSON: "\"tick\":"
  std::vector<std::pair<std::string, std::string>> missing_;  // name, why
  Record record_;
  RecordHead head_;
  std::vector<bool> changed_;
  std::vector<Quality> quality_;
  std::vector<bool> forced_;
  std::uint64_t seq_ = 0;
  SharedMessage binary_;
  SharedMessage everything_;
  SharedMessage changes_;
};

}  // namespace indurop::serve
