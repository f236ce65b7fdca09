// SPDX-License-Identifier: Apache-2.0
// The simulated camera: draws what lies in its view, with noise, whenever a job asks for an image. The only thing that
// it tells others are pixels. A real one would let its driver write to image->pixels.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes.h"

namespace {

using Image = INDUROP_TYPEOF(CAMERA::image)::value_type;

constexpr double kRadians = std::numbers::pi / 180;
constexpr int kFine = 4;         // a pixel is kFine * kFine samples
constexpr double kLargest = 45;  // mm, no item reaches farther from its centre
constexpr double kDark = 38;     // grey level of the tray, which is brighter on the right
constexpr double kSlope = 0.08;  // levels per mm
constexpr double kBright = 185;  // of the items
constexpr double kNoise = 8;     // standard deviation

std::uint32_t taken = 0;

// Where an item is in the frame of the camera.
struct Place {
  double x, y, cosine, sine;
};

Place in_view(const BENCH::Item& item) {
  const double angle = BENCH::CAMERA_ANGLE * kRadians;
  const double dx = item.x - BENCH::CAMERA_X;
  const double dy = item.y - BENCH::CAMERA_Y;
  const double turned = item.angle * kRadians - angle;
  return {dx * std::cos(angle) + dy * std::sin(angle), dy * std::cos(angle) - dx * std::sin(angle), std::cos(turned),
          std::sin(turned)};
}

// Share of the pixel with its lower left corner at x, y that the item covers.
double share(Shape shape, const Place& place, double x, double y) {
  constexpr double kStep = CAMERA::MM_PER_PX / kFine;
  int covered = 0;
  for (int i = 0; i < kFine; ++i) {
    for (int j = 0; j < kFine; ++j) {
      const double dx = x + (i + 0.5) * kStep - place.x;
      const double dy = y + (j + 0.5) * kStep - place.y;
      covered += covers(shape, dx * place.cosine + dy * place.sine, dy * place.cosine - dx * place.sine) ? 1 : 0;
    }
  }
  return static_cast<double>(covered) / (kFine * kFine);
}

// First and last + 1 of `most` pixels that an item may cover.
std::pair<int, int> range(double centre, int most) {
  return {std::max(0, static_cast<int>((centre - kLargest) / CAMERA::MM_PER_PX)),
          std::min(most, static_cast<int>((centre + kLargest) / CAMERA::MM_PER_PX))};
}

void draw(Image& image, Shape shape, const Place& place) {
  const auto [left, right] = range(place.x, CAMERA::WIDTH);
  const auto [low, high] = range(place.y, CAMERA::HEIGHT);
  for (int row = low; row < high; ++row) {
    for (int column = left; column < right; ++column) {
      std::uint8_t& pixel = image.pixels[CAMERA::HEIGHT - 1 - row][column];
      const double part = share(shape, place, column * CAMERA::MM_PER_PX, row * CAMERA::MM_PER_PX);
      pixel = static_cast<std::uint8_t>(pixel + part * (kBright - pixel));
    }
  }
}

void expose(Image& image, std::uint32_t seed) {
  for (auto& row : image.pixels) {
    for (int column = 0; column < CAMERA::WIDTH; ++column) {
      row[column] = static_cast<std::uint8_t>(kDark + kSlope * column * CAMERA::MM_PER_PX);
    }
  }
  const auto items = BENCH::part.get();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].state == BENCH::LIES || items[i].state == BENCH::PUT) {
      draw(image, i < 6 ? Shape::Part : Shape::Washer, in_view(items[i]));
    }
  }
  std::uint32_t noise = (seed * 2654435761U) | 1U;
  for (auto& row : image.pixels) {
    for (std::uint8_t& pixel : row) {
      double sum = 0;  // of four uniform numbers, which is nearly normal
      noise ^= noise << 13U;
      noise ^= noise >> 17U;
      noise ^= noise << 5U;
      for (unsigned shift = 0; shift < 32; shift += 8) {
        sum += static_cast<double>((noise >> shift) & 255U);
      }
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + (sum - 510) / 147.8 * kNoise, 0.0, 255.0));
    }
  }
}

}  // namespace

void run() {
  const std::uint32_t wanted = CAMERA::shot;
  if (wanted == taken) {
    return;
  }
  if (auto image = CAMERA::image.take()) {
    image->shot = wanted;
    const auto scene = INDUROP_TYPEOF(BENCH::scene)(BENCH::scene);
    expose(*image, scene.seed * 1000 + wanted);
    image.publish();
    taken = wanted;
  }
}

INDUROP_STATE(taken)
INDUROP_MODULE(run = &::run, name = "camera", description = "simulated camera above the tray")
