// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/recorded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <tuple>
#include <utility>

#include "history/recorder/boxes.h"
#include "history/recording/mcap_reader.h"
#include "tools/client/recordings/recorded_numbers.h"

namespace indurop::tools {
namespace {

using base::Problem;
namespace fs = std::filesystem;

std::int64_t written_ns(const fs::path& file) {
  std::error_code ignored;
  const auto time = std::chrono::file_clock::to_sys(fs::last_write_time(file, ignored));
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

RecordingFile file_of(const recorder::Box& box, bool black_box) {
  const std::string file = box.file.filename().string();
  return {black_box ? box.node + "~" + file : file,
          box.file,
          box.node,
          box.reason,
          black_box,
          box.bytes,
          written_ns(box.file)};
}

// Samples the values of the lines at evenly spaced times.
class Grid {
 public:
  Grid(std::pair<std::int64_t, std::int64_t> whole, const ValuesRequest& request)
      : held(request.names.size(), std::nan("")), points_(std::max<std::size_t>(request.points, 2)) {
    out.begin_ns = std::max(whole.first, request.from_ns);
    out.end_ns = std::max(request.to_ns == 0 ? whole.second : std::min(whole.second, request.to_ns), out.begin_ns);
    out.lines.assign(request.names.size(), std::vector<double>(points_, std::nan("")));
  }

  // Fills all points before this time.
  void fill(std::int64_t before_ns) {
    for (; point_ < points_ && time_of(point_) < before_ns; ++point_) {
      for (std::size_t line = 0; line < held.size(); ++line) {
        out.lines[line][point_] = held[line];
      }
    }
  }

  RecordedValues out;
  std::vector<double> held;

 private:
  [[nodiscard]] std::int64_t time_of(std::size_t point) const {
    const auto part = static_cast<double>(point) / static_cast<double>(points_ - 1);
    return out.begin_ns + static_cast<std::int64_t>(part * static_cast<double>(out.end_ns - out.begin_ns));
  }

  std::size_t points_;
  std::size_t point_ = 0;
};

}  // namespace

std::vector<RecordingFile> list_recordings(const fs::path& folder) {
  std::vector<RecordingFile> all;
  for (const recorder::Box& box : recorder::boxes_here()) {
    all.push_back(file_of(box, true));
  }
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".mcap" && entry.is_regular_file(ignored)) {
      all.push_back(file_of(recorder::read_box(entry.path(), ""), false));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const RecordingFile& a, const RecordingFile& b) { return a.wall_ns > b.wall_ns; });
  return all;
}

Result<RecordedContents, Problem> read_contents_of(const fs::path& path) {
  const auto reader = recording::McapReader::open(path);
  if (!reader) {
    return reader.error();
  }
  RecordedContents out;
  std::tie(out.begin_ns, out.end_ns) = reader->contents().span_ns();
  out.complete = reader->contents().has_summary;
  for (const auto& [id, layout] : layouts_of(reader->contents())) {
    const recording::McapChannel& channel = reader->contents().channels.at(id);
    RecordedChannel one;
    one.name = channel.topic;
    const auto unit = channel.metadata.find("unit");
    one.unit = unit == channel.metadata.end() ? "" : unit->second;
    for (const recording::IdlLeaf& leaf : layout) {
      if (leaf.kind != recording::IdlLeaf::Kind::Text) {
        one.numbers.push_back(channel.topic + leaf.name);
      }
    }
    if (!one.numbers.empty()) {
      out.channels.push_back(std::move(one));
    }
  }
  return out;
}

Result<RecordedValues, Problem> read_values_of(const fs::path& path, const ValuesRequest& request) {
  auto reader = recording::McapReader::open(path);
  if (!reader) {
    return reader.error();
  }
  const Layouts layouts = layouts_of(reader->contents());
  auto wanted = find_numbers(reader->contents(), layouts, request.names);
  if (!wanted) {
    return std::move(wanted).error();
  }
  Grid grid(reader->contents().span_ns(), request);
  std::vector<double> values;
  const auto take = [&](const recording::McapMessage& message) {
    const auto lines = wanted->find(message.channel);
    if (lines == wanted->end() || !recording::read_leaves(layouts.at(lines->first), message.data.view, values)) {
      return;
    }
    grid.fill(static_cast<std::int64_t>(message.log_time_ns));
    for (const auto& [leaf, line] : lines->second) {
      grid.held[line] = values[leaf];
    }
  };
  (void)reader->each(take, static_cast<std::uint64_t>(grid.out.end_ns));
  grid.fill(INT64_MAX);
  return std::move(grid.out);
}

}  // namespace indurop::tools
