// SPDX-License-Identifier: Apache-2.0
#include "tools/plant/board_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/json.h"
#include "deploy/transaction/blob_fetch.h"
#include "deploy/words/deployment_words.h"
#include "rt/clock.h"
#include "tools/command/interrupt.h"
#include "tools/plant/board_texts.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kSameMomentNs = 10'000'000'000;
constexpr std::int64_t kPatienceNs = 5'000'000'000;
constexpr std::int64_t kLookNs = 20'000'000;

std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return static_cast<std::uint64_t>(std::max(a, b)) - static_cast<std::uint64_t>(std::min(a, b));
}

}  // namespace

std::vector<BoardBox> fetch_box_lists(deploy::DeployLink& link, std::uint64_t self,
                                      const std::vector<deploy::BoardReport>& boards) {
  std::vector<std::uint64_t> agents;
  for (const deploy::BoardReport& board : boards) {
    agents.push_back(board.agent);
  }
  const auto texts = fetch_texts(link, self, deploy::kBoxesBlob, agents);
  std::vector<BoardBox> all;
  for (const deploy::BoardReport& board : boards) {
    const auto text = texts.find(board.agent);
    const base::Json whole = base::Json::parse(text == texts.end() ? "" : text->second).value_or(base::Json());
    for (const base::Json& entry : whole["boxes"].values()) {
      BoardBox box{board.board, board.agent, "", ""};
      if (read(entry, "name", box.name) && read(entry, "reason", box.reason) && read(entry, "bytes", box.bytes) &&
          read(entry, "end_ns", box.end_ns)) {
        all.push_back(std::move(box));
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const BoardBox& a, const BoardBox& b) { return a.name > b.name; });
  return all;
}

std::vector<BoardBox> boxes_of_moment(const std::vector<BoardBox>& all, std::int64_t moment_ns) {
  std::vector<BoardBox> chosen;
  for (const BoardBox& box : all) {
    const std::uint64_t away = distance(box.end_ns, moment_ns);
    if (away > kSameMomentNs) {
      continue;
    }
    const auto other =
        std::find_if(chosen.begin(), chosen.end(), [&](const BoardBox& o) { return o.board == box.board; });
    if (other == chosen.end()) {
      chosen.push_back(box);
    } else if (away < distance(other->end_ns, moment_ns)) {
      *other = box;
    }
  }
  return chosen;
}

Result<void, Failure> fetch_box(deploy::DeployLink& link, std::uint64_t self, const BoardBox& box,
                                const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  const std::string blob = std::string(deploy::kBoxBlob) + box.name;
  deploy::BlobFetch fetch(box.bytes, 0, link.room());
  std::int64_t moved = rt::now_ns();
  while (!fetch.complete() && out.good()) {
    if (interrupted()) {
      return Failure{interrupt_code(), "interrupted"};
    }
    if (rt::now_ns() - moved > kPatienceNs) {
      return Failure{kUnreachable, fmt::format("board {} does not answer any more", box.board)};
    }
    if (const auto range = fetch.ask(rt::MonoClock::now())) {
      link.request({self, box.agent, blob, range->offset, range->length, range->restart});
    }
    link.wait(rt::mono_time(rt::now_ns() + kLookNs));
    for (const deploy::BlobChunk& chunk : link.take_chunks()) {
      if (chunk.source != box.agent || chunk.blob != blob) {
        continue;
      }
      if (chunk.missing) {
        return Failure{kFailed, fmt::format("{} is not on board {} any more", box.name, box.board)};
      }
      if (fetch.take(chunk.offset, chunk.data.size(), rt::MonoClock::now())) {
        out.write(reinterpret_cast<const char*>(chunk.data.data()), static_cast<std::streamsize>(chunk.data.size()));
        moved = rt::now_ns();
      }
    }
  }
  out.close();
  return out.good() ? Result<void, Failure>() : Failure{kFailed, fmt::format("{} cannot be written", file.string())};
}

}  // namespace indurop::tools
