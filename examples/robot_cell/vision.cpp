// SPDX-License-Identifier: Apache-2.0
// Finds the parts in each image of the camera, from its pixels only. A process of its own: a crash in it does not
// disturb the robot.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <numbers>
#include <span>

#include "blobs.h"

namespace {

// Area of a part in mm^2, within what its border may gain or lose by noise.
constexpr double kSmallest = 1150;
constexpr double kLargest = 1350;

INDUROP_TYPEOF(CAMERA::seen)::value_type look(std::uint32_t shot, std::span<const Blob> blobs) {
  INDUROP_TYPEOF(CAMERA::seen)::value_type seen;
  seen.shot = shot;
  for (const Blob& blob : blobs) {
    const double area = blob.area * CAMERA::MM_PER_PX * CAMERA::MM_PER_PX;
    if (blob.at_border || area < kSmallest || area > kLargest) {
      ++seen.others;
      continue;
    }
    const double x = blob.x * CAMERA::MM_PER_PX;
    if (seen.parts == 0 || x < seen.x) {
      seen.x = x;
      seen.y = blob.y * CAMERA::MM_PER_PX;
      seen.angle = blob.angle * 180 / std::numbers::pi;
    }
    ++seen.parts;
  }
  return seen;
}

}  // namespace

int main() {
  BlobFinder finder(CAMERA::WIDTH, CAMERA::HEIGHT);
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    if (const auto image = CAMERA::image.next()) {
      const std::span<const std::uint8_t> pixels(&image->pixels[0][0], std::size_t{CAMERA::WIDTH} * CAMERA::HEIGHT);
      CAMERA::seen = look(image->shot, finder.find(pixels));
    }
  }
}

INDUROP_STATE()
