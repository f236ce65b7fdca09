// SPDX-License-Identifier: Apache-2.0
// Puts together a text that an agent sends in pieces, on request. No network.

#pragma once

#include <cstddef>
#include <string>

#include "deploy/link/deploy_link.h"

namespace indurop::deploy {

class TextPieces {
 public:
  // Pieces beyond `most` bytes are not taken.
  explicit TextPieces(std::size_t most) : most_(most) {}

  // Takes the next piece. They come in order, and the last one is not full. The text may have changed since an earlier
  // request: a piece from its beginning starts again. Returns false if it is not the next one.
  bool take(const BlobChunk& piece) {
    if (done()) {
      return false;
    }
    if (piece.offset == 0) {
      text_.clear();
    }
    if (piece.offset != text_.size() || text_.size() + piece.data.size() > most_) {
      return false;
    }
    missing_ = piece.missing;
    text_.append(piece.data.begin(), piece.data.end());
    whole_ = !missing_ && piece.data.size() < DeployLink::kChunk;
    return true;
  }

  [[nodiscard]] bool whole() const noexcept { return whole_; }
  [[nodiscard]] bool done() const noexcept { return whole_ || missing_; }  // missing: the agent has no such text
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::size_t most_;
  std::string text_;
  bool whole_ = false;
  bool missing_ = false;
};

}  // namespace indurop::deploy
