// SPDX-License-Identifier: Apache-2.0
// How conveyor, gripper and pallet behave. Pure arithmetic of time; no variables, no network.
#pragma once

#include <cstdint>

struct Commands {
  bool conveyor = false;
  bool close_gripper = false;
  bool next_pallet = false;
  bool open_valve = false;
};

struct Tool {
  double x = 0, y = 0, z = 0;  // mm
};

class Surroundings {
 public:
  void step(double seconds, const Commands& commands, const Tool& tool);

  [[nodiscard]] bool part_at_end() const { return belt_ >= kBelt; }
  [[nodiscard]] bool holds() const { return holds_; }
  [[nodiscard]] bool open() const { return opening_ >= 1; }
  [[nodiscard]] bool pallet_has_room() const { return away_ <= 0 && on_pallet_ < kPallet; }
  [[nodiscard]] double belt() const { return belt_; }
  [[nodiscard]] double opening() const { return opening_; }
  [[nodiscard]] std::uint16_t on_pallet() const { return on_pallet_; }
  [[nodiscard]] std::uint32_t placed() const { return placed_; }
  [[nodiscard]] std::uint32_t lost() const { return lost_; }
  [[nodiscard]] std::uint32_t dots() const { return dots_; }
  [[nodiscard]] std::uint32_t spilled() const { return spilled_; }

 private:
  void move_belt(double seconds, bool runs);
  void move_gripper(double seconds, bool closes, const Tool& tool);
  void exchange_pallet(double seconds, bool wanted);
  void glue(bool open, const Tool& tool);

  static constexpr double kBelt = 1000;        // mm
  static constexpr std::uint16_t kPallet = 4;  // parts
  double belt_ = 600;                          // of the first part on it, mm
  double opening_ = 1;                         // 1 open, 0 closed
  bool holds_ = false;
  double away_ = 0;  // s until the next pallet is there
  std::uint16_t on_pallet_ = 0;
  std::uint32_t placed_ = 0;
  std::uint32_t lost_ = 0;
  bool glues_ = false;
  std::uint32_t dots_ = 0;
  std::uint32_t spilled_ = 0;
};
