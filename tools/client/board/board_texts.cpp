// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_texts.h"

#include <algorithm>

#include "core/rt/clock.h"
#include "deploy/link/text_pieces.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kTextPatienceNs = 2'000'000'000;
constexpr std::int64_t kAskAgainNs = 250'000'000;
constexpr std::int64_t kTextPollNs = 20'000'000;
constexpr std::uint64_t kLargest = 64U << 20U;

struct Text {
  deploy::TextPieces pieces{kLargest};
  std::int64_t ask_ns = 0;  // time of the next request, if nothing was received by then
};

}  // namespace

std::map<std::uint64_t, std::string> fetch_texts(deploy::DeployLink& link, std::uint64_t self, const std::string& name,
                                                 const std::vector<std::uint64_t>& agents) {
  std::map<std::uint64_t, Text> texts;
  for (const std::uint64_t agent : agents) {
    texts[agent] = {};
  }
  const auto all_done = [&] {
    return std::all_of(texts.begin(), texts.end(), [](const auto& entry) { return entry.second.pieces.done(); });
  };
  // A late answer to an earlier request would have an old text.
  (void)link.take_chunks();
  const std::int64_t end = rt::now_ns() + kTextPatienceNs;
  while (!all_done() && !interrupted() && rt::now_ns() < end) {
    for (auto& [agent, text] : texts) {
      if (!text.pieces.done() && rt::now_ns() >= text.ask_ns) {
        link.request({self, agent, name, 0, kLargest, true});
        text.ask_ns = rt::now_ns() + kAskAgainNs;
      }
    }
    link.wait(rt::mono_time(rt::now_ns() + kTextPollNs));
    for (const deploy::BlobChunk& chunk : link.take_chunks()) {
      const auto asked = texts.find(chunk.source);
      if (asked != texts.end() && chunk.blob == name && asked->second.pieces.take(chunk)) {
        asked->second.ask_ns = rt::now_ns() + kAskAgainNs;
      }
    }
  }
  std::map<std::uint64_t, std::string> answers;
  for (const auto& [agent, text] : texts) {
    if (text.pieces.whole()) {
      answers.emplace(agent, text.pieces.text());
    }
  }
  return answers;
}

}  // namespace indurop::tools
