// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/history_page.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace indurop::tools {
namespace {

// Gaps that touch are one.
void join_gaps(std::vector<HistoryGap>& gaps) {
  std::sort(gaps.begin(), gaps.end(), [](const HistoryGap& a, const HistoryGap& b) {
    return std::tuple(a.item, a.span.begin_ns) < std::tuple(b.item, b.span.begin_ns);
  });
  std::vector<HistoryGap> joined;
  for (const HistoryGap& gap : gaps) {
    if (!joined.empty() && joined.back().item == gap.item && gap.span.begin_ns <= joined.back().span.end_ns) {
      joined.back().span.end_ns = std::max(joined.back().span.end_ns, gap.span.end_ns);
    } else {
      joined.push_back(gap);
    }
  }
  gaps = std::move(joined);
}

}  // namespace

PageBuilder::PageBuilder(HistoryPosition start, std::int64_t from_ns, const PageLimits& limits)
    : position_(std::move(start)), from_ns_(from_ns), limits_(limits) {
  page_.before.resize(position_.seen.size());
}

void PageBuilder::take_gap(const HistoryGap& gap) {
  position_.seen[gap.item] = 0;
  page_.before[gap.item] = gap.span.begin_ns < from_ns_ ? std::nullopt : page_.before[gap.item];
  const TimeSpan shown = gap.span.cut_to({from_ns_, gap.span.end_ns});
  if (!shown.empty()) {
    page_.gaps.push_back({gap.item, shown});
  }
}

bool PageBuilder::changes(const HistoryValue& value) const noexcept {
  return position_.seen[value.item] != digest_of(value.bytes);
}

void PageBuilder::take_value(HistoryValue& value) {
  const std::uint64_t digest = digest_of(value.bytes);
  if (std::exchange(position_.seen[value.item], digest) == digest) {
    return;
  }
  if (value.time_ns < from_ns_) {
    page_.before[value.item] = std::move(value);
    return;
  }
  bytes_ += value.bytes.size();
  page_.values.push_back(std::move(value));
}

void PageBuilder::set_before(HistoryValue value) {
  position_.seen[value.item] = digest_of(value.bytes);
  const std::uint32_t item = value.item;
  page_.before[item] = std::move(value);
}

bool PageBuilder::end_at(std::int64_t time_ns) {
  position_.at_ns = time_ns;
  return false;
}

bool PageBuilder::add(HistoryFindings findings) {
  std::sort(findings.gaps.begin(), findings.gaps.end(),
            [](const HistoryGap& a, const HistoryGap& b) { return a.span.begin_ns < b.span.begin_ns; });
  auto gap = findings.gaps.cbegin();
  for (auto group = findings.values.begin(); group != findings.values.end();) {
    const std::int64_t time = group->time_ns;
    const auto end =
        std::find_if(group, findings.values.end(), [time](const HistoryValue& one) { return one.time_ns != time; });
    for (; gap != findings.gaps.cend() && gap->span.begin_ns <= time; ++gap) {
      take_gap(*gap);
    }
    const auto more = static_cast<std::size_t>(
        std::count_if(group, end, [this](const HistoryValue& value) { return changes(value); }));
    const bool full = page_.values.size() + more > limits_.values || bytes_ >= limits_.bytes;
    if (full && more > 0 && !page_.values.empty()) {
      return end_at(time);
    }
    for (; group != end; ++group) {
      take_value(*group);
    }
  }
  for (; gap != findings.gaps.cend(); ++gap) {
    take_gap(*gap);
  }
  position_.at_ns = findings.complete_ns;
  return true;
}

HistoryPage PageBuilder::finish(bool more) {
  page_.end_ns = position_.at_ns;
  for (HistoryGap& gap : page_.gaps) {
    gap.span.end_ns = std::min(gap.span.end_ns, page_.end_ns);
  }
  std::erase_if(page_.gaps, [](const HistoryGap& gap) { return gap.span.empty(); });
  join_gaps(page_.gaps);
  if (more) {
    page_.next = std::move(position_);
  }
  return std::move(page_);
}

}  // namespace indurop::tools
