// SPDX-License-Identifier: Apache-2.0
// Finds the bright part in each image, where the camera has put it: no byte of an image is copied. A process of its
// own: if it crashes, the image in its hand is free again, and the node starts it again.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cmath>

using namespace cell::Vision;

namespace {

INDUROP_TYPEOF(part)::value_type find_part(const INDUROP_TYPEOF(camera)::value_type& image) {
  constexpr unsigned char kThreshold = 128;
  double count = 0;
  double sum_x = 0;
  double sum_y = 0;
  for (unsigned y = 0; y < HEIGHT; ++y) {
    for (unsigned x = 0; x < WIDTH; ++x) {
      if (image.pixels[y][x] >= kThreshold) {
        count += 1;
        sum_x += x;
        sum_y += y;
      }
    }
  }
  INDUROP_TYPEOF(part)::value_type result;
  result.found = count > 0;
  if (result.found) {
    result.x = sum_x / count;
    result.y = sum_y / count;
    result.error = std::hypot(result.x - image.part_x, result.y - image.part_y);
  }
  return result;
}

}  // namespace

int main() {
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    while (const auto image = camera.next()) {
      auto result = find_part(*image);
      result.image = image.number();
      part = result;
    }
  }
}
