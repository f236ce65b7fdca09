// SPDX-License-Identifier: Apache-2.0
// What lies on the bench, and what the fingers do with it. Pure arithmetic of time and of where the tip is; it does not
// know what the robot, the camera and the jobs believe.
#pragma once

#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>

#include "arm_tip.h"
#include "shapes.h"

class BenchWorld {
 public:
  using Scene = INDUROP_TYPEOF(BENCH::scene)::value_type;
  using Truth = INDUROP_TYPEOF(BENCH::truth)::value_type;

  struct Valve {
    bool close = false, open = false;  // a pulse is enough
  };

  void lay_out(const Scene& scene);
  void step(double seconds, const Valve& valve, const Tip& tip);

  [[nodiscard]] bool holds() const { return held_ < kItems; }
  [[nodiscard]] bool is_open() const { return truth_.opening >= kOpen; }
  // The sensor between the fingers sees pieces (metal) below it, not the table.
  [[nodiscard]] bool sees_piece() const { return sees_; }
  [[nodiscard]] const Truth& truth() const { return truth_; }
  [[nodiscard]] std::array<BENCH::Item, 8> parts() const { return some<8>(0); }
  [[nodiscard]] std::array<BENCH::Item, 5> pieces() const { return some<5>(kPieces); }

 private:
  template <std::size_t count>
  [[nodiscard]] std::array<BENCH::Item, count> some(std::size_t first) const {
    std::array<BENCH::Item, count> items;
    std::copy_n(items_.begin() + first, count, items.begin());
    return items;
  }
  static Shape shape(std::size_t item) {
    return item < kWashers ? Shape::Part : item < kPieces ? Shape::Washer : Shape::Piece;
  }
  double random(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  void scatter(std::size_t first, std::size_t count);
  [[nodiscard]] bool is_free(std::size_t item) const;
  [[nodiscard]] bool is_between_fingers(std::size_t item, const Tip& tip) const;
  void take(const Tip& tip);
  void carry(const Tip& tip);
  void release();
  void sense(const Tip& tip);
  [[nodiscard]] double top_of_stack() const;

  static constexpr double kOpen = 44;                                   // mm between the open fingers
  static constexpr std::size_t kWashers = 6, kPieces = 8, kItems = 13;  // the first six are parts

  std::mt19937 random_;
  std::array<BENCH::Item, kItems> items_{};
  Truth truth_{};
  double table_ = 0;  // of the stack
  bool closes_ = false;
  bool sees_ = false;
  std::size_t held_ = kItems;
  BENCH::Item grip_{};      // pose of what is held, relative to the tip
  unsigned to_snatch_ = 0;  // parts that will be taken away before the fingers hold them
};
