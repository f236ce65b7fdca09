// SPDX-License-Identifier: Apache-2.0
// The picture of a topic in docs/robot: the path of the tool, what is switched on it, and both over time.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "topic_trace.h"

namespace indurop::robot {

struct ShownSignal {
  std::string name, meaning, colour;
  bool is_output = true;
  bool has_band = false;  // the path is marked while it is on
  bool is_curve = false;  // a number, not a switch
};

// A numbered remark, in the picture where and when its trigger begins, and in the list below.
struct Remark {
  std::string trigger;  // TopicTrace::begin()
  int nth = 1;
  std::string text;  // "{x}", "{y}" and "{z}": where the tip is, mm
};

enum class Views : std::uint8_t { SideAndAbove, AboveAndSide, Side, SideAndHeight, None };

struct PictureScript {
  std::string topic, page, title;
  char across = 'y';
  Views views = Views::SideAndAbove;
  std::vector<ShownSignal> signals{};
  std::vector<Remark> remarks{};
  bool shows_axis = false;                                    // the first axis over time
  std::vector<std::pair<std::string, std::string>> taught{};  // points between which the taught line is shown
};

const std::vector<PictureScript>& picture_scripts();

// An SVG document, the same bytes for the same job. Throws std::runtime_error if a remark begins nowhere.
std::string picture_of(const PictureScript& script);

}  // namespace indurop::robot
