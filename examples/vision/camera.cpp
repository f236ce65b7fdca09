// SPDX-License-Identifier: Apache-2.0
// A camera over a belt, simulated: a bright part of 20 x 12 pixels passes over a dark, noisy belt. A real one would let
// its driver write to frame->pixels.

#include <indurop/generated.h>
#include <indurop/indurop.h>

using namespace cell::Vision;

namespace {

constexpr unsigned kPartWidth = 20;
constexpr unsigned kPartHeight = 12;
constexpr unsigned char kBright = 220;

void draw(INDUROP_TYPEOF(camera)::value_type& frame, std::uint64_t number) {
  std::uint32_t noise = static_cast<std::uint32_t>(number);
  for (auto& row : frame.pixels) {
    for (unsigned char& pixel : row) {
      noise = noise * 1664525U + 1013904223U;
      pixel = static_cast<unsigned char>(noise >> 26U);  // 0 to 63
    }
  }
  const auto left = static_cast<unsigned>(number * 4 % (WIDTH - kPartWidth));
  const auto top = static_cast<unsigned>(100 + number % 200);
  for (unsigned y = top; y < top + kPartHeight; ++y) {
    for (unsigned x = left; x < left + kPartWidth; ++x) {
      frame.pixels[y][x] = kBright;
    }
  }
  frame.part_x = left + (kPartWidth - 1) / 2.0;
  frame.part_y = top + (kPartHeight - 1) / 2.0;
}

void onRun() {
  if (auto frame = camera.take()) {
    draw(*frame, images);
    frame.publish();
    images += 1;
  } else {
    dropped += 1;
  }
}

}  // namespace

INDUROP_MODULE(run = &onRun)
