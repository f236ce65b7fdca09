// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_boxes.h"

#include <algorithm>

#include "core/base/json.h"
#include "deploy/words/deployment_words.h"
#include "tools/client/board/board_texts.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kSameMomentNs = 10'000'000'000;

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

}  // namespace indurop::tools
