// SPDX-License-Identifier: Apache-2.0
// Finds bright blobs in a grey image, and where each one is and how it is turned, by the moments of its area. Pure
// arithmetic of pixels: no variables, no lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

struct Blob {
  double area = 0;         // px
  double x = 0, y = 0;     // centre of area, px from the lower left corner of the image, y up
  double angle = 0;        // rad, of the long axis, towards its shorter and wider end
  bool at_border = false;  // a part of it may be outside of the image
};

class BlobFinder {
 public:
  BlobFinder(std::size_t width, std::size_t height);

  // The blobs of an image of rows from top to bottom; valid until the next call. An image without contrast has none.
  std::span<const Blob> find(std::span<const std::uint8_t> pixels);

 private:
  void fill(std::size_t seed);
  [[nodiscard]] Blob measure() const;

  std::size_t width_, height_;
  std::vector<bool> open_;            // bright, and in no blob yet
  std::vector<std::size_t> members_;  // pixels of the present blob
  std::vector<std::size_t> edge_;     // those whose neighbours were not visited yet
  std::vector<Blob> blobs_;
};
