// SPDX-License-Identifier: Apache-2.0
#include "mirror/blob_server.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kStuckNs = 5'000'000'000;  // then the requester has gone
constexpr int kPiecesAtOnce = 16;                 // for one requester before others have their turn
constexpr std::size_t kMostRequests = 64;

}  // namespace

BlobServer::~BlobServer() {
  for (auto& [requester, waiting] : waiting_) {
    forget(waiting);
  }
}

void BlobServer::forget(Waiting& waiting) const {
  if (waiting.file >= 0) {
    ::close(waiting.file);
  }
  waiting.file = -1;
  waiting.open_name.clear();
}

void BlobServer::look_up(Waiting& waiting, const std::string& name) const {
  if (waiting.open_name == name) {
    return;
  }
  forget(waiting);
  waiting.open_name = name;
  waiting.blob = {};
  waiting.found = find_(name, waiting.blob);
  if (waiting.found && !waiting.blob.file.empty()) {
    waiting.file = ::open(waiting.blob.file.c_str(), O_RDONLY | O_CLOEXEC);
    waiting.found = waiting.file >= 0;
  }
}

bool BlobServer::read(const Waiting& waiting, deploy::BlobChunk& chunk, std::uint64_t length) const {
  const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(length, DeployLink::kChunk));
  if (waiting.file < 0) {
    const std::string part =
        chunk.offset < waiting.blob.text.size() ? waiting.blob.text.substr(chunk.offset, most) : std::string{};
    chunk.data.assign(part.begin(), part.end());
    return true;
  }
  chunk.data.resize(most);
  const ssize_t got = ::pread(waiting.file, chunk.data.data(), most, static_cast<off_t>(chunk.offset));
  chunk.data.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return got > 0;
}

bool BlobServer::serve(DeployLink& link, std::int64_t now_ns) {
  for (const deploy::BlobRequest& request : link.take_requests()) {
    Waiting& waiting = waiting_[request.requester];
    if (request.restart) {
      waiting.requests.clear();
    }
    if (waiting.requests.size() < kMostRequests) {
      waiting.requests.push_back(request);
    }
    waiting.stuck_since_ns = now_ns;
  }
  bool more = false;
  for (auto& [requester, waiting] : waiting_) {
    for (int piece = 0; piece < kPiecesAtOnce && !waiting.requests.empty(); ++piece) {
      deploy::BlobRequest& request = waiting.requests.front();
      look_up(waiting, request.blob);
      deploy::BlobChunk chunk{self_, request.blob, request.offset, !waiting.found, {}};
      chunk.missing = !waiting.found || !read(waiting, chunk, request.length);
      const DeployLink::Sent sent = link.send(requester, chunk);
      if (sent == DeployLink::Sent::Later && now_ns - waiting.stuck_since_ns < kStuckNs) {
        more = true;
        break;
      }
      if (sent != DeployLink::Sent::Yes) {
        waiting.requests.clear();
        break;
      }
      waiting.stuck_since_ns = now_ns;
      request.offset += chunk.data.size();
      request.length -= std::min<std::uint64_t>(request.length, chunk.data.size());
      if (request.length == 0 || chunk.data.empty()) {
        waiting.requests.pop_front();
      }
    }
    more = more || !waiting.requests.empty();
    if (waiting.requests.empty()) {
      forget(waiting);
    }
  }
  std::erase_if(waiting_, [&](const auto& entry) {
    const Waiting& waiting = entry.second;
    const bool idle = waiting.requests.empty() && now_ns - waiting.stuck_since_ns > kStuckNs;
    if (idle) {
      link.forget(entry.first);
    }
    return idle;
  });
  return more;
}

}  // namespace indurop::mirror
