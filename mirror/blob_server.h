// SPDX-License-Identifier: Apache-2.0
// Sends pieces of files to whoever asks: a deployer to the boards, a board to one that missed a deployment.

#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "mirror/deploy_link.h"

namespace indurop::mirror {

class BlobServer {
 public:
  // Content of a blob: a file, or a text.
  struct Blob {
    std::filesystem::path file;  // empty: `text`
    std::string text;
  };
  // False: it is not here.
  using Find = std::function<bool(const std::string& name, Blob& blob)>;

  BlobServer(std::uint64_t self, Find find) : self_(self), find_(std::move(find)) {}
  ~BlobServer();
  BlobServer(const BlobServer&) = delete;
  BlobServer& operator=(const BlobServer&) = delete;

  // Takes new requests and sends some pieces, to all that wait in turn. True: there is more to send now.
  bool serve(DeployLink& link, std::int64_t now_ns);

 private:
  struct Waiting {
    std::deque<deploy::BlobRequest> requests;
    std::int64_t stuck_since_ns = 0;
    std::string open_name;  // of the blob below
    Blob blob;
    int file = -1;
    bool found = false;
  };
  void forget(Waiting& waiting) const;
  void look_up(Waiting& waiting, const std::string& name) const;
  bool read(const Waiting& waiting, deploy::BlobChunk& chunk, std::uint64_t length) const;

  std::uint64_t self_;
  Find find_;
  std::map<std::uint64_t, Waiting> waiting_;  // by requester
};

}  // namespace indurop::mirror
