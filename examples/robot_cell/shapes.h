// SPDX-License-Identifier: Apache-2.0
// Shapes of what lies on the bench, seen from above, in mm about their centre of area. The camera draws them; the
// fingers close on them. Programs that find them do not include this file.
#pragma once

#include <cmath>

enum class Shape { Part, Washer, Piece };

// The part is a bolt: a stem along -x, and a head at +x that is wider.
constexpr double kStem = 44, kStemWidth = 16, kHead = 16, kHeadWidth = 34;
constexpr double kCentre = (kStem * kStemWidth * kStem / 2 + kHead * kHeadWidth * (kStem + kHead / 2)) /
                           (kStem * kStemWidth + kHead * kHeadWidth);
constexpr double kWasher = 14, kHole = 6;  // radii
constexpr double kPiece = 36;              // side of a square

inline bool covers(Shape shape, double x, double y) {
  switch (shape) {
    case Shape::Part: {
      const double along = x + kCentre;
      return along >= 0 && along <= kStem + kHead && std::fabs(y) <= (along <= kStem ? kStemWidth : kHeadWidth) / 2;
    }
    case Shape::Washer:
      return std::hypot(x, y) <= kWasher && std::hypot(x, y) >= kHole;
    case Shape::Piece:
      return std::fabs(x) <= kPiece / 2 && std::fabs(y) <= kPiece / 2;
  }
  return false;
}

// How far the fingers are open when they hold it.
inline double width(Shape shape) {
  return shape == Shape::Piece ? kPiece : shape == Shape::Part ? kStemWidth : 2 * kWasher;
}
