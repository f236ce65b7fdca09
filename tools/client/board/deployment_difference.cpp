// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/deployment_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "core/base/text.h"
#include "deploy/transaction/package.h"
#include "tools/client/board/board_texts.h"

namespace indurop::tools {
namespace {

using base::Json;

constexpr std::uint64_t kMostBytes = 60'000;
constexpr std::size_t kMostLines = 2000;
constexpr std::size_t kAround = 3;
constexpr std::size_t kMostTexts = 20;  // maximum number of texts that are requested

class Packages {
 public:
  Packages(deploy::DeployLink& link, std::uint64_t self, const std::vector<std::uint64_t>& agents)
      : link_(link), self_(self), agents_(agents) {}

  std::optional<std::string> blob(const std::string& name) {
    const auto texts = fetch_texts(link_, self_, name, agents_);
    return texts.empty() ? std::nullopt : std::optional(texts.begin()->second);
  }
  Result<deploy::Package, base::Problem> package(const std::string& id) {
    const auto text = blob(id);
    return text ? deploy::read_package(*text)
                : base::Problem{fmt::format("no board that is heard has deployment {} any more", deploy::shown_id(id))};
  }

 private:
  deploy::DeployLink& link_;
  std::uint64_t self_;
  const std::vector<std::uint64_t>& agents_;
};

bool is_text(const std::string& bytes) {
  return bytes.find('\0') == std::string::npos;
}

// Marks the lines of `a` and `b` that belong to their longest common subsequence.
struct Common {
  std::vector<bool> of_a;
  std::vector<bool> of_b;
};
Common common_lines(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::vector<std::uint16_t>> length(a.size() + 1, std::vector<std::uint16_t>(b.size() + 1));
  for (std::size_t i = a.size(); i-- > 0;) {
    for (std::size_t j = b.size(); j-- > 0;) {
      length[i][j] = a[i] == b[j] ? static_cast<std::uint16_t>(length[i + 1][j + 1] + 1)
                                  : std::max(length[i + 1][j], length[i][j + 1]);
    }
  }
  Common common{std::vector<bool>(a.size()), std::vector<bool>(b.size())};
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) {
      common.of_a[i++] = common.of_b[j++] = true;
    } else {
      length[i + 1][j] >= length[i][j + 1] ? ++i : ++j;
    }
  }
  return common;
}

Json row(const char* change, const std::string& text) {
  return {{"change", change}, {"text", text}};
}

}  // namespace

Json lines_between(const std::string& before, const std::string& after) {
  const std::vector<std::string> a = base::lines_of(before);
  const std::vector<std::string> b = base::lines_of(after);
  Json rows = Json::array();
  if (a.size() > kMostLines || b.size() > kMostLines) {
    return rows;
  }
  const Common common = common_lines(a, b);
  std::vector<std::pair<const char*, std::string>> all;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (i < a.size() && !common.of_a[i]) {
      all.emplace_back("removed", a[i++]);
    } else if (j < b.size() && !common.of_b[j]) {
      all.emplace_back("added", b[j++]);
    } else {
      all.emplace_back("same", a[i++]);
      ++j;
    }
  }
  const auto changed = [](const auto& one) { return std::string_view(one.first) != "same"; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, kAround));
    const auto to = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), i + kAround + 1));
    if (std::any_of(from, to, changed)) {
      rows.push_back(row(all[i].first, all[i].second));
    }
  }
  return rows;
}

Result<Json, base::Problem> difference_of(deploy::DeployLink& link, std::uint64_t self,
                                          const std::vector<std::uint64_t>& agents, const std::string& before,
                                          const std::string& after) {
  Packages packages(link, self, agents);
  const auto one = packages.package(before);
  const auto other = packages.package(after);
  if (!one || !other) {
    return one ? other.error() : one.error();
  }
  std::map<std::string, std::pair<const deploy::PackageFile*, const deploy::PackageFile*>> files;
  for (const deploy::PackageFile& file : one->files) {
    files[file.path].first = &file;
  }
  for (const deploy::PackageFile& file : other->files) {
    files[file.path].second = &file;
  }
  Json list = Json::array();
  std::size_t texts = 0;
  for (const auto& [path, pair] : files) {
    const auto& [old, now] = pair;
    if (old != nullptr && now != nullptr && old->digest == now->digest) {
      continue;
    }
    Json file{{"path", path}, {"change", old == nullptr ? "added" : now == nullptr ? "removed" : "changed"}};
    file["size_before"] = old != nullptr ? Json(old->size) : Json();
    file["size_after"] = now != nullptr ? Json(now->size) : Json();
    file["lines"] = Json::array();
    if (old != nullptr && now != nullptr && std::max(old->size, now->size) <= kMostBytes && texts < kMostTexts) {
      const auto was = packages.blob(old->digest);
      const auto is = was && is_text(*was) ? packages.blob(now->digest) : std::nullopt;
      if (is && is_text(*is)) {
        ++texts;
        file["lines"] = lines_between(*was, *is);
      }
    }
    list.push_back(std::move(file));
  }
  Json out = Json::object();
  out["files"] = std::move(list);
  return out;
}

}  // namespace indurop::tools
