// SPDX-License-Identifier: Apache-2.0
// The names of plain topics: PREFIX/BOARD/values/knu/Robot/joints, PREFIX/BOARD/set/USER.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace indurop::mqtt {

// Returns a name of a variable as levels of a topic, "knu/Robot/gain"; and back, also for parts
// ("knu/Robot/joints[1].y").
std::string levels_of(std::string_view variable);
std::string variable_of(std::string_view levels);
// Returns true if the text can be one level of a topic.
bool is_level(std::string_view text);

// A command by its topic.
struct SetTopic {
  std::string board;
  std::string user;
  std::string variable;  // empty: the payload names the variables
};
// Returns nothing if it is no topic of a command.
std::optional<SetTopic> read_set_topic(std::string_view prefix, std::string_view topic);

}  // namespace indurop::mqtt
