// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/foxglove_words.h"

#include <bit>
#include <cstring>

#include "history/recording/omg_idl.h"

namespace indurop::serve {
namespace {

std::optional<std::uint32_t> number_of(const base::Json& json) {
  const auto number = json.natural();
  return number && *number <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(*number)) : std::nullopt;
}

template <class Number>
void append(std::string& to, Number number) {
  static_assert(std::endian::native == std::endian::little);
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  to.append(bytes, sizeof number);
}

base::Json word(const char* op) {
  base::Json out = base::Json::object();
  out["op"] = op;
  return out;
}

}  // namespace

std::optional<FoxgloveWord> read_foxglove_word(std::string_view text) {
  const auto json = base::Json::parse(text);
  FoxgloveWord out;
  if (!json || !json->is_object() || !base::read(*json, "op", out.op)) {
    return std::nullopt;
  }
  if (out.op == "subscribe") {
    for (const base::Json& one : (*json)["subscriptions"].values()) {
      const auto id = number_of(one["id"]);
      const auto channel = number_of(one["channelId"]);
      if (id && channel) {
        out.subscribe.emplace_back(*id, *channel);
      }
    }
  }
  if (out.op == "unsubscribe") {
    for (const base::Json& one : (*json)["subscriptionIds"].values()) {
      if (const auto id = number_of(one)) {
        out.unsubscribe.push_back(*id);
      }
    }
  }
  return out;
}

namespace foxglove {

std::string server_info(const std::string& version, std::int64_t started_ns) {
  base::Json out = word("serverInfo");
  out["name"] = "InduRoP " + version;
  out["capabilities"] = base::Json::array();
  out["sessionId"] = std::to_string(started_ns);
  return out.dump();
}

base::Json channel(std::uint32_t id, const std::string& topic, const schema::Type& type) {
  recording::OmgIdl idl = recording::omg_idl(type);
  base::Json out = base::Json::object();
  out["id"] = id;
  out["topic"] = topic;
  out["encoding"] = "cdr";
  out["schemaName"] = std::move(idl.name);
  out["schema"] = std::move(idl.text);
  out["schemaEncoding"] = "omgidl";
  return out;
}

std::string advertise(base::Json channels) {
  base::Json out = word("advertise");
  out["channels"] = std::move(channels);
  return out.dump();
}

std::string unadvertise(const std::vector<std::uint32_t>& channels) {
  base::Json ids = base::Json::array();
  for (const std::uint32_t id : channels) {
    ids.push_back(id);
  }
  base::Json out = word("unadvertise");
  out["channelIds"] = std::move(ids);
  return out.dump();
}

std::string warning(const std::string& text) {
  constexpr int kWarning = 1;
  base::Json out = word("status");
  out["level"] = kWarning;
  out["message"] = text;
  return out.dump();
}

std::string message(std::uint32_t subscription, std::int64_t wall_ns, std::span<const std::uint8_t> cdr) {
  constexpr char kMessageData = 1;
  std::string out(1, kMessageData);
  append(out, subscription);
  append(out, wall_ns);
  out.append(reinterpret_cast<const char*>(cdr.data()), cdr.size());
  return out;
}

}  // namespace foxglove
}  // namespace indurop::serve
