// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_opcua_reader.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr std::array kSecurities{IoOpcua::Security::Encrypt, IoOpcua::Security::Sign, IoOpcua::Security::None};

// OPC 10000-6, 5.3.1.10: an optional namespace, by number or by URI, then a kind and an identifier.
bool is_node_id(std::string_view text) {
  constexpr std::int64_t kMaxNamespace = std::numeric_limits<std::uint16_t>::max();
  constexpr std::int64_t kMaxNumber = std::numeric_limits<std::uint32_t>::max();
  const bool by_uri = text.starts_with("nsu=");
  if (by_uri || text.starts_with("ns=")) {
    const std::size_t begin = text.find('=') + 1;
    const std::size_t end = text.find(';');
    if (end == std::string_view::npos || end == begin ||
        (!by_uri && !read_integer(std::string(text.substr(begin, end - begin)), 0, kMaxNamespace))) {
      return false;
    }
    text.remove_prefix(end + 1);
  }
  constexpr std::size_t kKind = 2;  // "i="
  if (text.size() <= kKind || text[1] != '=') {
    return false;
  }
  return text[0] == 'i' ? read_integer(std::string(text.substr(kKind)), 0, kMaxNumber).has_value()
                        : std::string_view("sgb").find(text[0]) != std::string_view::npos;
}

bool is_server(const std::string& url) {
  constexpr std::string_view kScheme = "opc.tcp://";
  return url.starts_with(kScheme) && url.size() > kScheme.size() && url[kScheme.size()] != '/' &&
         url.find_first_of(" \t\n") == std::string::npos;
}

}  // namespace

const char* name_of(IoOpcua::Security security) noexcept {
  switch (security) {
    case IoOpcua::Security::Encrypt:
      return "encrypt";
    case IoOpcua::Security::Sign:
      return "sign";
    case IoOpcua::Security::None:
      return "none";
  }
  return "";
}

void read_io_server(Attributes& attributes, IoDevice& device, base::Diagnostics& report) {
  base::SourcePlace place;
  const auto address = attributes.need("address", "address=\"opc.tcp://192.168.1.10:4840\"", &place);
  device.address = address.value_or("");
  if (address && !is_server(*address)) {
    report.error(place, fmt::format("address: {} is not the address of an OPC UA server; write "
                                    "opc.tcp://192.168.1.10:4840",
                                    base::in_quotes(*address)));
  }
  std::vector<std::string> words;
  for (const IoOpcua::Security security : kSecurities) {
    words.emplace_back(name_of(security));
  }
  device.opcua.security = kSecurities.at(attributes.choose("security", words).value_or(0));
  device.opcua.user = attributes.text("user").value_or("");
  device.opcua.socket = attributes.text("socket").value_or("");
}

void read_io_node(Attributes& attributes, IoPoint& point, base::Diagnostics& report) {
  point.type = WireType::Float64;  // the server knows the type
  const auto at = attributes.need("at", "at=\"ns=2;s=Temperature\"", &point.at_place);
  point.at = at.value_or("");
  if (at && !is_node_id(*at)) {
    report.error(point.at_place, fmt::format("at: {} is not a NodeId; write ns=2;s=Temperature, "
                                             "nsu=urn:maker:press;s=Temperature or i=2258",
                                             base::in_quotes(*at)));
  }
}

}  // namespace indurop::config
