// SPDX-License-Identifier: Apache-2.0
#include "node/replay/output.h"

#include <algorithm>
#include <utility>

#include "history/recorder/sources.h"
#include "history/recording/omg_idl.h"

namespace indurop::node {

using base::Problem;

Result<ReplayOutput, Problem> ReplayOutput::create(const std::filesystem::path& path, const std::string& of) {
  auto writer = recording::McapWriter::create(path, {});
  if (!writer) {
    return std::move(writer).error();
  }
  if (auto written = writer->metadata("indurop.replayed", {{"of", of}}); !written) {
    return std::move(written).error();
  }
  return ReplayOutput(std::move(writer).value());
}

Result<std::uint16_t, Problem> ReplayOutput::channel_for(const schema::Variable& variable) {
  const recording::OmgIdl idl = recording::omg_idl(variable.type);
  std::uint16_t& schema = schemas_[idl.text];
  if (schema == 0) {
    auto added = writer_.add_schema(idl.name, "omgidl", idl.text);
    if (!added) {
      return added;
    }
    schema = *added;
  }
  return writer_.add_channel(
      schema, variable.name, "cdr",
      variable.unit.empty() ? recording::TextMap{} : recording::TextMap{{"unit", variable.unit}});
}

Result<void, Problem> ReplayOutput::close(const std::map<std::string, std::uint64_t>& differing) {
  recording::TextMap counts;
  for (const auto& [name, runs] : differing) {
    counts[name] = std::to_string(runs);
  }
  auto written = writer_.metadata(recorder::kDifferingMetadata, counts);
  return written ? writer_.close() : written;
}

Result<void, Problem> ReplayOutput::take(std::uint32_t index, const schema::Variable& variable,
                                         const std::vector<std::uint8_t>& cdr, std::int64_t time_ns) {
  Signal& signal = signals_[index];
  if (signal.channel == 0) {
    auto channel = channel_for(variable);
    if (!channel) {
      return std::move(channel).error();
    }
    signal.channel = *channel;
  } else if (signal.last == cdr) {
    return {};
  }
  signal.last = cdr;
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
  return writer_.write(signal.channel, time, time, signal.count++, cdr);
}

}  // namespace indurop::node
