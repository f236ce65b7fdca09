// SPDX-License-Identifier: Apache-2.0
#include "bench_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kFingers = 100;  // mm/s
constexpr double kHeight = 20;    // mm, of parts and washers
constexpr double kGap = 76;       // mm between the centres of two parts, for the fingers
constexpr double kMargin = 45;    // mm from the border of the image
constexpr double kAside = 5;      // mm between the tip and the centre of what it takes, at most
constexpr double kTurned = 5;     // deg that it may be turned to it
constexpr double kTilted = 1;     // deg that it may be tilted
constexpr double kSinks = 1.2;    // mm that the fingers give way upwards
constexpr double kDrops = 3;      // mm that an item may fall without changing its place
constexpr double kRange = 12;     // mm below the tip that the sensor sees
constexpr double kNoise = 0.2;    // mm by which its range differs from time to time
constexpr double kPallet = 300;   // mm, its sides; its corner is at 330, 180

double turned(double from, double to) {
  return std::remainder(to - from, 360.0);
}

bool on_pallet(const BENCH::Item& item) {
  return item.x > 330 && item.x < 330 + kPallet && item.y > 180 && item.y < 180 + kPallet;
}

// Places in the view of the camera become poses in the base frame.
BENCH::Item from_view(double x, double y, double angle) {
  const double cosine = std::cos(BENCH::CAMERA_ANGLE * kRadians);
  const double sine = std::sin(BENCH::CAMERA_ANGLE * kRadians);
  return {BENCH::LIES, BENCH::CAMERA_X + x * cosine - y * sine, BENCH::CAMERA_Y + x * sine + y * cosine,
          double{BENCH::CAMERA_Z}, turned(0, angle + BENCH::CAMERA_ANGLE)};
}

}  // namespace

void BenchWorld::lay_out(const Scene& scene) {
  random_.seed(scene.seed);
  items_ = {};
  truth_ = {};
  truth_.opening = kOpen;
  closes_ = false;
  held_ = kItems;
  to_snatch_ = scene.snatch;
  scatter(0, std::min<std::size_t>(scene.parts, kWashers));
  scatter(kWashers, std::min<std::size_t>(scene.others, kPieces - kWashers));
  table_ = random(100, 125);
  for (std::size_t i = 0; i < std::min<std::size_t>(scene.pieces, kItems - kPieces); ++i) {
    items_[kPieces + i] = {BENCH::LIES, BENCH::STACK_X + random(-0.2, 0.2), BENCH::STACK_Y + random(-0.2, 0.2),
                           table_ + static_cast<double>(i) * BENCH::PIECE_HEIGHT, random(-0.3, 0.3)};
  }
}

// Where there is room; if the last ones find none, all of them are scattered again.
void BenchWorld::scatter(std::size_t first, std::size_t count) {
  std::size_t tries = 0;
  for (std::size_t i = first; i < first + count;) {
    items_[i] = from_view(random(kMargin, CAMERA::WIDTH * CAMERA::MM_PER_PX - kMargin),
                          random(kMargin, CAMERA::HEIGHT * CAMERA::MM_PER_PX - kMargin), random(-180, 180));
    if (is_free(i)) {
      ++i;
    } else if (++tries % 1000 == 0) {
      i = first;
    }
  }
}

bool BenchWorld::is_free(std::size_t item) const {
  return std::none_of(items_.begin(), items_.begin() + item, [&](const BENCH::Item& other) {
    return other.state != BENCH::ABSENT && std::hypot(items_[item].x - other.x, items_[item].y - other.y) < kGap;
  });
}

void BenchWorld::step(double seconds, const Valve& valve, const Tip& tip) {
  closes_ = (closes_ || valve.close) && !valve.open;
  truth_.tip = {tip.x, tip.y, tip.z};
  const double stop = holds() ? width(shape(held_)) : 0;
  truth_.opening = closes_ ? std::max(stop, truth_.opening - kFingers * seconds)
                           : std::min(kOpen, truth_.opening + kFingers * seconds);
  if (closes_ && !holds()) {
    take(tip);
  }
  if (holds()) {
    carry(tip);
  }
  if (!closes_ && holds()) {
    release();
  }
  truth_.stack = top_of_stack();
  sense(tip);
}

bool BenchWorld::is_between_fingers(std::size_t i, const Tip& tip) const {
  const BENCH::Item& item = items_[i];
  const double height = shape(i) == Shape::Piece ? BENCH::PIECE_HEIGHT : kHeight;
  const double apart = std::fabs(turned(tip.angle, item.angle));
  const bool straight = std::min(apart, 180 - apart) < kTurned || shape(i) == Shape::Washer;
  return (item.state == BENCH::LIES || item.state == BENCH::PUT) && straight && tip.tilt < kTilted &&
         std::hypot(item.x - tip.x, item.y - tip.y) < kAside && tip.z > item.z && tip.z < item.z + height &&
         truth_.opening <= width(shape(i));
}

// The fingers do not straighten what they close on: it is held as it lies.
void BenchWorld::take(const Tip& tip) {
  std::size_t found = 0;
  while (found < kItems && !is_between_fingers(found, tip)) {
    ++found;
  }
  if (found == kItems) {
    return;
  }
  BENCH::Item& item = items_[found];
  if (to_snatch_ > 0) {
    --to_snatch_;
    item = {};
    return;
  }
  held_ = found;
  truth_.opening = width(shape(found));
  const double cosine = std::cos(tip.angle * kRadians);
  const double sine = std::sin(tip.angle * kRadians);
  const double dx = item.x - tip.x;
  const double dy = item.y - tip.y;
  grip_ = {BENCH::HELD, dx * cosine + dy * sine, dy * cosine - dx * sine, item.z - tip.z,
           turned(tip.angle, item.angle)};
}

void BenchWorld::carry(const Tip& tip) {
  const double cosine = std::cos(tip.angle * kRadians);
  const double sine = std::sin(tip.angle * kRadians);
  items_[held_] = {BENCH::HELD, tip.x + grip_.x * cosine - grip_.y * sine, tip.y + grip_.x * sine + grip_.y * cosine,
                   tip.z + grip_.z, turned(0, tip.angle + grip_.angle)};
}

// It stays where the surface below it is near enough, and is lost anywhere else.
void BenchWorld::release() {
  BENCH::Item& item = items_[held_];
  const double surface = on_pallet(item) ? BENCH::PALLET_Z : BENCH::CAMERA_Z;
  const double above = item.z - surface;
  if (above > -kSinks && above < kDrops) {
    item.z = surface;
    item.state = BENCH::PUT;
    ++truth_.put;
  } else {
    item.state = BENCH::LOST;
    ++truth_.lost;
  }
  held_ = kItems;
}

double BenchWorld::top_of_stack() const {
  double top = table_;
  for (std::size_t i = kPieces; i < kItems; ++i) {
    if (items_[i].state == BENCH::LIES) {
      top = std::max(top, items_[i].z + BENCH::PIECE_HEIGHT);
    }
  }
  return top;
}

// It switches at a distance that differs a little from period to period.
void BenchWorld::sense(const Tip& tip) {
  const bool above = std::hypot(tip.x - BENCH::STACK_X, tip.y - BENCH::STACK_Y) < kPiece / 2;
  const double distance = tip.z - truth_.stack;
  sees_ = above && truth_.stack > table_ && distance < kRange + random(-kNoise, kNoise);
}
