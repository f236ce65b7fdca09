// SPDX-License-Identifier: Apache-2.0
// Sends pieces of files on request: from a deployer to the boards, from a board to one that missed a deployment.

#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/base/descriptor.h"
#include "core/rt/clock.h"
#include "deploy/link/deploy_link.h"

namespace indurop::deploy {

class BlobServer {
 public:
  // Content of a blob: a file, or a text.
  struct Blob {
    std::filesystem::path file;  // empty: `text`
    std::string text;
  };
  // Returns nothing if there is no such blob.
  using Find = std::function<std::optional<Blob>(const std::string& name)>;

  BlobServer(std::uint64_t self, Find find) : self_(self), find_(std::move(find)) {}
  BlobServer(const BlobServer&) = delete;
  BlobServer& operator=(const BlobServer&) = delete;

  // Takes new requests and sends some pieces, to all waiting clients alternately. Returns true if there is more to send
  // now.
  bool serve(DeployLink& link, rt::MonoTime now);

 private:
  struct Waiting {
    std::deque<deploy::BlobRequest> requests;
    rt::MonoTime stuck_since;
    std::string open_name;     // name of the blob below
    std::optional<Blob> blob;  // nothing: there is no such blob
    base::Descriptor file;
  };
  void forget(Waiting& waiting) const;
  void find_blob(Waiting& waiting, const std::string& name) const;
  // Returns what to send of the open blob: at most `length` bytes from the offset, or that it is missing.
  [[nodiscard]] BlobChunk read(const Waiting& waiting, const BlobRequest& request) const;

  std::uint64_t self_;
  Find find_;
  std::map<std::uint64_t, Waiting> waiting_;  // by requester
};

}  // namespace indurop::deploy
