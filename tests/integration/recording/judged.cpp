// SPDX-License-Identifier: Apache-2.0
// judged write FOLDER SEED: recordings of random types and values, and these values as JSON, for readers of others.
// judged read FILE: what our reader finds in a recording of others.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/idl_word.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/mcap_writer.h"
#include "history/recording/omg_idl.h"
#include "tests/unit/history/recording/random_value.h"

namespace {

using namespace indurop;
using namespace indurop::recording;
using schema::Base;
using schema::Type;

void demand(bool good, std::string_view what) {
  if (!good) {
    fmt::print(stderr, "{}\n", what);
    std::exit(1);
  }
}
template <class Returned>
auto must(Returned result) {
  demand(result.ok(), result.ok() ? "" : result.error().text);
  if constexpr (requires { *result; }) {
    return std::move(*result);
  }
}

template <class T>
T number(const std::uint8_t* at) {
  T out;
  std::memcpy(&out, at, sizeof out);
  return out;
}

std::string json(const Type& type, const std::uint8_t* at);

// As others read it: 64-bit integers as text, an enum by its number without a sign.
std::string one_as_json(const Type& type, const std::uint8_t* at) {
  switch (type.base) {
    case Base::Bool:
      return *at != 0 ? "true" : "false";
    case Base::Int8:
      return fmt::to_string(static_cast<int>(number<std::int8_t>(at)));
    case Base::Char:
    case Base::UInt8:
      return fmt::to_string(static_cast<int>(*at));
    case Base::Int16:
      return fmt::to_string(number<std::int16_t>(at));
    case Base::UInt16:
      return fmt::to_string(number<std::uint16_t>(at));
    case Base::Int32:
      return fmt::to_string(number<std::int32_t>(at));
    case Base::UInt32:
    case Base::Enum:
      return fmt::to_string(number<std::uint32_t>(at));
    case Base::Int64:
      return fmt::format("\"{}\"", number<std::int64_t>(at));
    case Base::UInt64:
      return fmt::format("\"{}\"", number<std::uint64_t>(at));
    case Base::Float:
      return fmt::format("{}", static_cast<double>(number<float>(at)));
    case Base::Double:
      return fmt::format("{}", number<double>(at));
    case Base::Text:
      return fmt::format("\"{}\"", reinterpret_cast<const char*>(at));
    case Base::Struct:
      break;
  }
  std::string out;
  for (const schema::Field& field : type.fields) {
    const std::string name = field.name == "byte" ? "_byte" : schema::idl_name(field.name);
    out += fmt::format("{}\"{}\":{}", out.empty() ? "" : ",", name, json(field.type, at + field.offset));
  }
  return "{" + out + "}";
}

std::string json(const Type& type, const std::uint8_t* at) {
  if (type.dims.empty()) {
    return one_as_json(type, at);
  }
  Type inner = type;
  inner.dims.erase(inner.dims.begin());
  std::string out;
  for (std::uint32_t i = 0; i < type.dims[0]; ++i) {
    out += (out.empty() ? "" : ",") + json(inner, at + i * inner.size());
  }
  return "[" + out + "]";
}

struct Value {
  std::uint16_t channel = 0;
  std::uint64_t log_ns = 0;
  Bytes cdr;
};

void write_all(McapWriter& to, const std::vector<Type>& types, const std::vector<Value>& values) {
  for (std::size_t i = 0; i < types.size(); ++i) {
    const OmgIdl idl = omg_idl(types[i]);
    const std::uint16_t schema = must(to.add_schema(idl.name, "omgidl", idl.text));
    must(to.add_channel(schema, fmt::format("v{}", i + 1), "cdr", {}));
  }
  const std::string_view text = "<module/>";
  must(to.attach({1, 2, "module.xml", "application/xml"}, Bytes(text.begin(), text.end())));
  std::uint32_t sequence = 0;
  for (const Value& each : values) {
    must(to.write(each.channel, each.log_ns, each.log_ns - 1, ++sequence, each.cdr));
  }
  must(to.metadata("board", {{"name", "left"}, {"release", "1.0"}}));
}

void write_files(const std::filesystem::path& folder, std::uint32_t seed) {
  RandomValue random(seed);
  std::vector<Type> types;
  for (int i = 0; i < 40; ++i) {
    types.push_back(random.type());
  }
  std::vector<Value> values;
  std::ofstream expected(folder / "expected.jsonl");
  for (std::uint32_t n = 1; n <= 400; ++n) {
    const auto channel = static_cast<std::uint16_t>(1 + random.below(static_cast<std::uint32_t>(types.size())));
    const Type& type = types[channel - 1U];
    const std::vector<std::uint8_t> bytes = random.value(type);
    Value value{channel, 1'000'000'000'000'000'000U + n * 1000 + random.below(3000), {}};
    demand(to_cdr(type, bytes, value.cdr).ok(), "to_cdr");
    const std::string inside = json(type, bytes.data());
    const bool is_struct = type.base == Base::Struct && type.dims.empty();
    expected << fmt::format(R"({{"topic":"v{}","sequence":{},"log":"{}","publish":"{}","value":{}}})", channel, n,
                            value.log_ns, value.log_ns - 1, is_struct ? inside : "{\"value\":" + inside + "}")
             << '\n';
    values.push_back(std::move(value));
  }
  for (const bool compress : {true, false}) {
    auto to = must(McapWriter::create(folder / (compress ? "zstd.mcap" : "plain.mcap"),
                                      {2000, std::chrono::seconds(1), compress}));
    write_all(to, types, values);
    must(to.close());
  }
  // All but the last value are in whole chunks; the end is missing, as after a kill.
  auto killed = must(McapWriter::create(folder / "killed.mcap", {2000, std::chrono::seconds(1), true}));
  const Value last = values.back();
  values.pop_back();
  write_all(killed, types, values);
  must(killed.flush());
  must(killed.write(last.channel, last.log_ns, last.log_ns, 0, last.cdr));
}

std::string hex(View bytes) {
  std::string out;
  for (const std::uint8_t byte : bytes) {
    out += fmt::format("{:02x}", byte);
  }
  return out;
}

void read_file(const char* path) {
  auto reader = must(McapReader::open(path));
  for (const auto& damage : reader.contents().damages) {
    demand(false, damage.text);
  }
  while (const auto message = must(reader.next())) {
    fmt::print("{} {} {} {} {}\n", reader.contents().channels.at(message->channel).topic, message->sequence,
               message->log_time_ns, message->publish_time_ns, hex(message->data.view));
  }
  for (const McapAttachmentIndex& each : reader.contents().attachments) {
    fmt::print("{} {}\n", each.name, hex(must(reader.attachment(each))));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view verb = argc > 2 ? argv[1] : "";
  if (verb == "write" && argc == 4) {
    write_files(argv[2], static_cast<std::uint32_t>(std::atoi(argv[3])));
  } else if (verb == "read") {
    read_file(argv[2]);
  } else {
    demand(false, "judged write FOLDER SEED | read FILE");
  }
  return 0;
}
