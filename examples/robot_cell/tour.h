// SPDX-License-Identifier: Apache-2.0
// What people do around the cell when no operator is at the keyboard: twenty seconds that show everything.
#pragma once

#include <array>
#include <string_view>

struct Panel {
  bool start = false;
  bool stop = false;
  bool reset = false;
  bool emergency_stop = false;
  bool curtain = false;
};

struct TourStep {
  double from, to;  // s
  bool Panel::*what;
  std::string_view text;
};

constexpr std::array<TourStep, 7> kTour{{{1.0, 1.3, &Panel::start, "presses start"},
                                         {8.0, 8.8, &Panel::curtain, "walks through the light curtain"},
                                         {9.5, 9.8, &Panel::reset, "presses reset"},
                                         {10.5, 10.8, &Panel::start, "presses start"},
                                         {14.4, 15.2, &Panel::emergency_stop, "hits the emergency stop"},
                                         {15.5, 15.8, &Panel::reset, "presses reset"},
                                         {16.5, 16.8, &Panel::start, "presses start"}}};
