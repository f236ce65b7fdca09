// SPDX-License-Identifier: Apache-2.0
// What Action::Force, Unforce, Set and SetLock carry besides their lines: for how long, who and why. One text, which
// agents that know less understand as far as they do.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::deploy {

struct WriteOrder {
  std::int64_t for_ns = 0;  // of a force, 0: until it is released
  bool lease = false;       // it ends unless it is renewed within that time
  bool renew = false;       // nothing new: the same commander's lease goes on for so long; no lines
  bool end = false;         // with renew: it ends now, instead
  std::string who;
  std::string reason;
  std::vector<std::string> lines;  // NAME=VALUE; of SetLock: the word of the lock; of Unforce: names, none: all
};

std::string text_of(const WriteOrder& order);
// Nothing if the text is none.
std::optional<WriteOrder> parse_write_order(std::string_view text);

}  // namespace indurop::deploy
