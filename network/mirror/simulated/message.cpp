// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/simulated/message.h"

#include <algorithm>
#include <deque>
#include <tuple>
#include <utility>

#include "network/dds/lent.h"

namespace indurop::mirror {
namespace {

constexpr std::uint32_t kMaxItems = 1'000'000;  // maximum of a valid list

// The numbers of a message, in the order in which they are sent.
template <class OneMessage>
auto numbers_of_message(OneMessage& message) {
  return std::tie(message.kind, message.board, message.part, message.time_ns);
}
template <class Frame>
auto numbers_of_frame(Frame& frame) {
  return std::tie(frame.part, frame.layout, frame.session, frame.update, frame.update_sum, frame.tick,
                  frame.source_time_ns);
}
template <class Entry>
auto numbers_of_entry(Entry& entry) {
  return std::tie(entry.type_hash, entry.part, entry.offset, entry.size, entry.stream);
}
template <class Beacon>
auto numbers_of_beacon(Beacon& beacon) {
  return std::tie(beacon.session, beacon.source_time_ns, beacon.epoch_ns, beacon.basic_period_ns,
                  beacon.macro_period_ns, beacon.synchronised);
}

}  // namespace

void ByteWriter::put_message(const Message& message) {
  put_all(numbers_of_message(message));
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
  get_all(numbers_of_message(message));
  const auto body = get_bytes();
  message.body.assign(body.begin(), body.end());
  return message;
}

std::vector<std::uint8_t> to_bytes(const indurop_wire_Frame& frame) {
  ByteWriter out;
  out.put_all(numbers_of_frame(frame));
  out.put_bytes({frame.data._buffer, frame.data._length});
  return out.take();
}

bool with_frame(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Frame&)>& use) {
  ByteReader in(bytes);
  indurop_wire_Frame frame{};
  in.get_all(numbers_of_frame(frame));
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
    out.put_all(numbers_of_entry(entry));
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
  for (std::uint32_t i = 0; i < std::min(count, kMaxItems) && in.ok(); ++i) {
    indurop_wire_CatalogueEntry entry{};
    entry.name = text();
    in.get_all(numbers_of_entry(entry));
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
  out.put_all(numbers_of_beacon(beacon));
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
  in.get_all(numbers_of_beacon(beacon));
  const auto count = in.get<std::uint32_t>();
  std::vector<indurop_wire_Heard> received;
  for (std::uint32_t i = 0; i < std::min(count, kMaxItems) && in.ok(); ++i) {
    char* const board = text();
    received.push_back({board, in.get<std::int64_t>()});
  }
  beacon.heard._length = beacon.heard._maximum = static_cast<std::uint32_t>(received.size());
  beacon.heard._buffer = received.data();
  if (in.ok()) {
    use(beacon);
  }
  return in.ok();
}

}  // namespace indurop::mirror
