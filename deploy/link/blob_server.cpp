// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/blob_server.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/read_file.h"

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kStuck{5};  // after this the requester counts as gone
constexpr int kPiecesAtOnce = 16;          // for one requester before the others are served
constexpr std::size_t kMaxRequests = 64;

}  // namespace

void BlobServer::forget(Waiting& waiting) const {
  waiting.file = {};
  waiting.open_name.clear();
}

void BlobServer::find_blob(Waiting& waiting, const std::string& name) const {
  if (waiting.open_name == name) {
    return;
  }
  forget(waiting);
  waiting.open_name = name;
  waiting.blob = find_(name);
  if (waiting.blob && !waiting.blob->file.empty()) {
    auto opened = base::open_file(waiting.blob->file);
    if (opened) {
      waiting.file = std::move(opened->file);
    } else {
      waiting.blob.reset();
    }
  }
}

BlobChunk BlobServer::read(const Waiting& waiting, const BlobRequest& request) const {
  BlobChunk chunk{self_, request.blob, request.offset, !waiting.blob, {}};
  if (chunk.missing) {
    return chunk;
  }
  const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(request.length, DeployLink::kChunk));
  if (!waiting.file.is_open()) {
    const std::string& text = waiting.blob->text;
    const std::string part = chunk.offset < text.size() ? text.substr(chunk.offset, most) : std::string{};
    chunk.data.assign(part.begin(), part.end());
    return chunk;
  }
  chunk.data.resize(most);
  const ssize_t got = ::pread(waiting.file.get(), chunk.data.data(), most, static_cast<off_t>(chunk.offset));
  chunk.data.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  chunk.missing = got <= 0;
  return chunk;
}

bool BlobServer::serve(DeployLink& link, rt::MonoTime now) {
  for (const BlobRequest& request : link.take_requests()) {
    Waiting& waiting = waiting_[request.requester];
    if (request.restart) {
      waiting.requests.clear();
    }
    if (waiting.requests.size() < kMaxRequests) {
      waiting.requests.push_back(request);
    }
    waiting.stuck_since = now;
  }
  bool more = false;
  for (auto& [requester, waiting] : waiting_) {
    for (int piece = 0; piece < kPiecesAtOnce && !waiting.requests.empty(); ++piece) {
      BlobRequest& request = waiting.requests.front();
      find_blob(waiting, request.blob);
      const BlobChunk chunk = read(waiting, request);
      const DeployLink::Sent sent = link.send(requester, chunk);
      if (sent == DeployLink::Sent::Later && now - waiting.stuck_since < kStuck) {
        more = true;
        break;
      }
      if (sent != DeployLink::Sent::Yes) {
        waiting.requests.clear();
        break;
      }
      waiting.stuck_since = now;
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
    const bool idle = waiting.requests.empty() && now - waiting.stuck_since > kStuck;
    if (idle) {
      link.forget(entry.first);
    }
    return idle;
  });
  return more;
}

}  // namespace indurop::deploy
