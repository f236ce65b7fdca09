// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_roster.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/rt/clock.h"
#include "network/dds/log.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kRosterPollNs = 20'000'000;
constexpr std::int64_t kQuietNs = 300'000'000;
constexpr std::int64_t kSilentNs = 1'500'000'000;  // agents report twice a second

}  // namespace

std::unique_ptr<deploy::DeployLink> open_link(Messages& messages, deploy::LinkSettings& settings) {
  settings.self = deploy::new_session();
  auto opened = deploy::DeployLink::open(settings);
  if (!opened) {
    messages.error(opened.error().text);
    return nullptr;
  }
  if (!opened->note.empty()) {
    messages.note(opened->note);
  }
  return std::move(opened->link);
}

std::string keys_hint(const deploy::LinkSettings& settings) {
  if (!settings.network.security.on()) {
    return "; secured boards answer only clients with keys of their plant: --keys DIR";
  }
  // It is random which of the two sides refuses, and reports the reason.
  const std::string refusal = dds::last_refusal();
  return "; only boards with keys of the same plant are heard with --keys" + (refusal.empty() ? "" : ": " + refusal);
}

Failure with_keys_hint(Failure failure, const deploy::LinkSettings& settings) {
  if (failure.code == kUnreachable && !failure.text.empty()) {
    failure.text += keys_hint(settings);
  }
  return failure;
}

void BoardRoster::listen(deploy::DeployLink& link, std::int64_t now_ns, std::vector<Gone>* gone) {
  for (auto& news : link.take_boards()) {
    const auto key = std::pair(news.report.board, news.report.agent);
    if (news.gone) {
      boards_.erase(key);
      if (gone != nullptr) {
        gone->push_back({key.first, key.second});
      }
    } else {
      newest_ns_ = boards_.contains(key) ? newest_ns_ : now_ns;
      boards_[key] = {std::move(news.report), now_ns};
    }
  }
  others_ = link.other_agents();
  impostors_ = link.impostors();
}

void BoardRoster::gather_until(deploy::DeployLink& link, std::int64_t time_ns, bool (*enough)(void*), void* context) {
  const std::int64_t deadline = rt::now_ns() + time_ns + link.letting_in_ns();
  while (!interrupted() && rt::now_ns() < deadline) {
    link.wait(rt::mono_time(std::min(deadline, rt::now_ns() + kRosterPollNs)));
    listen(link, rt::now_ns());
    if (enough(context)) {
      return;
    }
  }
}

bool BoardRoster::complete() const {
  const bool none_missing = std::all_of(boards_.begin(), boards_.end(), [this](const auto& one) {
    const std::vector<std::string>& members = one.second.report.members;
    return std::all_of(members.begin(), members.end(), [this](const auto& name) { return find(name) != nullptr; });
  });
  return !boards_.empty() && none_missing && rt::now_ns() - newest_ns_ > kQuietNs;
}

const BoardRoster::Entry* BoardRoster::find(const std::string& board) const {
  const Entry* best = nullptr;
  for (auto at = boards_.lower_bound({board, 0}); at != boards_.end() && at->first.first == board; ++at) {
    if (best == nullptr || at->second.heard_ns >= best->heard_ns) {
      best = &at->second;
    }
  }
  return best;
}

std::vector<std::uint64_t> BoardRoster::agents() const {
  std::vector<std::uint64_t> all;
  for (const auto& [key, entry] : boards_) {
    all.push_back(key.second);
  }
  return all;
}

std::string BoardRoster::twins(const std::string& board, std::int64_t now_ns) const {
  std::string hosts;
  int count = 0;
  for (auto at = boards_.lower_bound({board, 0}); at != boards_.end() && at->first.first == board; ++at) {
    if (now_ns - at->second.heard_ns < kSilentNs) {
      hosts += (count++ > 0 ? " and " : "") + at->second.report.host;
    }
  }
  return count > 1 ? hosts : std::string{};
}

Result<std::string, Failure> choose_plant(const BoardRoster& roster, const std::string& wanted) {
  std::set<std::string> plants;
  for (const auto& [key, entry] : roster.all()) {
    if (!entry.report.current.empty()) {
      plants.insert(entry.report.plant);
    }
  }
  if (plants.size() > 1) {
    plants.erase("");  // of boards that have no plant, or do not know it yet, since their agents have just started
  }
  if (!wanted.empty() && plants.contains(wanted)) {
    return wanted;
  }
  if (plants.empty() || !wanted.empty()) {
    return Failure{kUnreachable, wanted.empty() ? "no board with a deployment was heard"
                                                : fmt::format("no board of plant {} was heard", wanted)};
  }
  if (plants.size() > 1) {
    return Failure{kUsage,
                   fmt::format("there are several plants: {}; say which with --plant", fmt::join(plants, ", "))};
  }
  return *plants.begin();
}

}  // namespace indurop::tools
