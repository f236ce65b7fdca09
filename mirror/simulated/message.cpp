// SPDX-License-Identifier: Apache-2.0
#include "mirror/simulated/message.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "dds/lent.h"

namespace indurop::mirror {
namespace {

constexpr std::uint32_t kMostItems = 1'000'000;  // of a sane list

}  // namespace

void ByteWriter::put_message(const Message& message) {
  put(message.kind);
  put(message.board);
  put(message.part);
  put(message.time_ns);
  put_bytes(message.body);
}

std::span<const std::uint8_t> ByteReader::next(std::size_t count) noexcept {
  if (count > bytes_.size()) {
    ok_ = false;
    bytes_ = {};
    return {};
  }
  const auto out = bytes_.first(count);
  bytes_ = bytes_.subspan(count);
  return out;
}

Message ByteReader::get_message() {
  Message message;
  message.kind = get<Message::Kind>();
  message.board = get<std::uint32_t>();
  message.part = get<std::uint32_t>();
  message.time_ns = get<std::int64_t>();
  const auto body = get_bytes();
  message.body.assign(body.begin(), body.end());
  return message;
}

std::vector<std::uint8_t> to_bytes(const indurop_wire_Frame& frame) {
  ByteWriter out;
  out.put(frame.part);
  out.put(frame.layout);
  out.put(frame.session);
  out.put(frame.update);
  out.put(frame.update_sum);
  out.put(frame.tick);
  out.put(frame.source_time_ns);
  out.put_bytes({frame.data._buffer, frame.data._length});
  return out.take();
}

bool with_frame(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Frame&)>& use) {
  ByteReader in(bytes);
  indurop_wire_Frame frame{};
  frame.part = in.get<std::uint32_t>();
  frame.layout = in.get<std::uint32_t>();
  frame.session = in.get<std::uint64_t>();
  frame.update = in.get<std::uint64_t>();
  frame.update_sum = in.get<std::uint64_t>();
  frame.tick = in.get<std::uint64_t>();
  frame.source_time_ns = in.get<std::int64_t>();
  const auto data = in.get_bytes();
  frame.data._length = frame.data._maximum = static_cast<std::uint32_t>(data.size());
  frame.data._buffer = dds::lent(data.data());
  if (in.ok()) {
    use(frame);
  }
  return in.ok();
}

std::vector<std::uint8_t> to_bytes(const indurop_wire_Catalogue& catalogue) {
  ByteWriter out;
  out.put_text(catalogue.board);
  out.put_text(catalogue.release);
  out.put(catalogue.session);
  out.put(catalogue.layout);
  out.put(catalogue.entries._length);
  for (std::uint32_t i = 0; i < catalogue.entries._length; ++i) {
    const indurop_wire_CatalogueEntry& entry = catalogue.entries._buffer[i];
    out.put_text(entry.name);
    out.put(entry.type_hash);
    out.put(entry.part);
    out.put(entry.offset);
    out.put(entry.size);
  }
  out.put_text(catalogue.schema);
  return out.take();
}

bool with_catalogue(std::span<const std::uint8_t> bytes,
                    const std::function<void(const indurop_wire_Catalogue&)>& use) {
  ByteReader in(bytes);
  std::deque<std::string> texts;
  const auto text = [&] { return texts.emplace_back(in.get_text()).data(); };
  indurop_wire_Catalogue catalogue{};
  catalogue.board = text();
  catalogue.release = text();
  catalogue.session = in.get<std::uint64_t>();
  catalogue.layout = in.get<std::uint64_t>();
  const auto count = in.get<std::uint32_t>();
  std::vector<indurop_wire_CatalogueEntry> entries;
  for (std::uint32_t i = 0; i < std::min(count, kMostItems) && in.ok(); ++i) {
    indurop_wire_CatalogueEntry entry{};
    entry.name = text();
    entry.type_hash = in.get<std::uint64_t>();
    entry.part = in.get<std::uint32_t>();
    entry.offset = in.get<std::uint32_t>();
    entry.size = in.get<std::uint32_t>();
    entries.push_back(entry);
  }
  catalogue.entries._length = catalogue.entries._maximum = static_cast<std::uint32_t>(entries.size());
  catalogue.entries._buffer = entries.data();
  catalogue.schema = text();
  if (in.ok()) {
    use(catalogue);
  }
  return in.ok();
}

std::vector<std::uint8_t> to_bytes(const indurop_wire_Beacon& beacon) {
  ByteWriter out;
  out.put_text(beacon.board);
  out.put(beacon.session);
  out.put(beacon.source_time_ns);
  out.put(beacon.epoch_ns);
  out.put(beacon.basic_period_ns);
  out.put(beacon.macro_period_ns);
  out.put(beacon.synchronised);
  out.put(beacon.heard._length);
  for (std::uint32_t i = 0; i < beacon.heard._length; ++i) {
    out.put_text(beacon.heard._buffer[i].board);
    out.put(beacon.heard._buffer[i].delay_ns);
  }
  return out.take();
}

bool with_beacon(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Beacon&)>& use) {
  ByteReader in(bytes);
  std::deque<std::string> texts;
  const auto text = [&] { return texts.emplace_back(in.get_text()).data(); };
  indurop_wire_Beacon beacon{};
  beacon.board = text();
  beacon.session = in.get<std::uint64_t>();
  beacon.source_time_ns = in.get<std::int64_t>();
  beacon.epoch_ns = in.get<std::int64_t>();
  beacon.basic_period_ns = in.get<std::int64_t>();
  beacon.macro_period_ns = in.get<std::int64_t>();
  beacon.synchronised = in.get<bool>();
  const auto count = in.get<std::uint32_t>();
  std::vector<indurop_wire_Heard> heard;
  for (std::uint32_t i = 0; i < std::min(count, kMostItems) && in.ok(); ++i) {
    char* const board = text();
    heard.push_back({board, in.get<std::int64_t>()});
  }
  beacon.heard._length = beacon.heard._maximum = static_cast<std::uint32_t>(heard.size());
  beacon.heard._buffer = heard.data();
  if (in.ok()) {
    use(beacon);
  }
  return in.ok();
}

}  // namespace indurop::mirror
