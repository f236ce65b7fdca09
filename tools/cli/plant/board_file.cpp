// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_file.h"

#include <fmt/format.h>

#include "core/base/new_file.h"
#include "core/rt/clock.h"
#include "deploy/transaction/blob_fetch.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kPatienceNs = 5'000'000'000;
constexpr std::int64_t kFilePollNs = 20'000'000;

}  // namespace

Result<void, Failure> fetch_file(deploy::DeployLink& link, std::uint64_t self, const BoardFile& file,
                                 const std::filesystem::path& to) {
  base::NewFile out(to);
  deploy::BlobFetch fetch(file.bytes, 0, link.room());
  std::int64_t moved = rt::now_ns();
  while (!fetch.complete() && out.good()) {
    if (interrupted()) {
      return Failure{interrupt_code(), "interrupted"};
    }
    if (rt::now_ns() - moved > kPatienceNs) {
      return Failure{kUnreachable, fmt::format("board {} does not answer any more", file.board)};
    }
    if (const auto range = fetch.ask(rt::MonoClock::now())) {
      link.request({self, file.agent, file.blob, range->offset, range->length, range->restart});
    }
    link.wait(rt::mono_time(rt::now_ns() + kFilePollNs));
    for (const deploy::BlobChunk& chunk : link.take_chunks()) {
      if (chunk.source != file.agent || chunk.blob != file.blob) {
        continue;
      }
      if (chunk.missing) {
        return Failure{kFailed, fmt::format("{} is not on board {} any more", file.blob, file.board)};
      }
      if (fetch.take(chunk.offset, chunk.data.size(), rt::MonoClock::now())) {
        out.write({reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size()});
        moved = rt::now_ns();
      }
    }
  }
  const auto written = out.close();
  return written ? Result<void, Failure>() : Failure{kFailed, base::cannot_write(to, written.error())};
}

}  // namespace indurop::tools
