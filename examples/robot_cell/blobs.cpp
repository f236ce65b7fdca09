// SPDX-License-Identifier: Apache-2.0
#include "blobs.h"

#include <array>
#include <cmath>
#include <numbers>

namespace {

constexpr std::size_t kGreys = 256;
constexpr double kContrast = 60;       // grey levels between blobs and background, at least
constexpr std::size_t kSmallest = 40;  // px; what is smaller is noise

// The threshold that separates two classes of grey levels best (Otsu: largest variance between their means); above all
// levels if the means are too near to each other.
unsigned threshold(std::span<const std::uint8_t> pixels) {
  std::array<double, kGreys> count{};
  for (const std::uint8_t grey : pixels) {
    count[grey] += 1;
  }
  const auto total = static_cast<double>(pixels.size());
  double sum = 0;
  for (std::size_t grey = 0; grey < kGreys; ++grey) {
    sum += static_cast<double>(grey) * count[grey];
  }
  double dark = 0;
  double dark_sum = 0;
  double best = 0;
  unsigned found = kGreys;
  for (std::size_t grey = 0; grey + 1 < kGreys; ++grey) {
    dark += count[grey];
    dark_sum += static_cast<double>(grey) * count[grey];
    if (dark == 0 || dark == total) {
      continue;
    }
    const double distance = (sum - dark_sum) / (total - dark) - dark_sum / dark;
    const double between = dark * (total - dark) * distance * distance;
    if (between > best) {
      best = between;
      found = distance < kContrast ? kGreys : static_cast<unsigned>(grey + 1);
    }
  }
  return found;
}

}  // namespace

BlobFinder::BlobFinder(std::size_t width, std::size_t height) : width_(width), height_(height), open_(width * height) {
  members_.reserve(width * height);
}

std::span<const Blob> BlobFinder::find(std::span<const std::uint8_t> pixels) {
  blobs_.clear();
  const unsigned bright = threshold(pixels);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    open_[i] = pixels[i] >= bright;
  }
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (open_[i]) {
      fill(i);
      if (members_.size() >= kSmallest) {
        blobs_.push_back(measure());
      }
    }
  }
  return blobs_;
}

// Pixels belong together if they have a side in common.
void BlobFinder::fill(std::size_t seed) {
  members_.clear();
  edge_.assign(1, seed);
  open_[seed] = false;
  const auto add = [this](bool inside, std::size_t pixel) {
    if (inside && open_[pixel]) {
      open_[pixel] = false;
      edge_.push_back(pixel);
    }
  };
  while (!edge_.empty()) {
    const std::size_t pixel = edge_.back();
    edge_.pop_back();
    members_.push_back(pixel);
    const std::size_t column = pixel % width_;
    add(column > 0, pixel - 1);
    add(column + 1 < width_, pixel + 1);
    add(pixel >= width_, pixel - width_);
    add(pixel + width_ < open_.size(), pixel + width_);
  }
}

// The first moments are the centre, the second ones the axis; of its two directions, the third moment along it selects
// the one of the wider end, which is nearer to the centre.
Blob BlobFinder::measure() const {
  Blob blob;
  blob.area = static_cast<double>(members_.size());
  const auto x = [this](std::size_t pixel) { return static_cast<double>(pixel % width_) + 0.5; };
  const auto y = [this](std::size_t pixel) {
    const std::size_t row = pixel / width_;
    return static_cast<double>(height_ - row) - 0.5;
  };
  for (const std::size_t pixel : members_) {
    blob.x += x(pixel) / blob.area;
    blob.y += y(pixel) / blob.area;
    const std::size_t column = pixel % width_;
    const std::size_t row = pixel / width_;
    blob.at_border = blob.at_border || column == 0 || row == 0 || column + 1 == width_ || row + 1 == height_;
  }
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (const std::size_t pixel : members_) {
    const double dx = x(pixel) - blob.x;
    const double dy = y(pixel) - blob.y;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  blob.angle = std::atan2(2 * xy, xx - yy) / 2;
  double skew = 0;
  for (const std::size_t pixel : members_) {
    const double along = (x(pixel) - blob.x) * std::cos(blob.angle) + (y(pixel) - blob.y) * std::sin(blob.angle);
    skew += along * along * along;
  }
  if (skew > 0) {
    blob.angle += blob.angle > 0 ? -std::numbers::pi : std::numbers::pi;
  }
  return blob;
}
