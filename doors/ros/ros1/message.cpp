// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/message.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/schema/ros_name.h"

namespace indurop::ros {
namespace {

struct RosWord {
  Base base;
  const char* field;    // of a message
  const char* message;  // of std_msgs
};
constexpr std::array<RosWord, 14> kRosWords{{{Base::Bool, "bool", "Bool"},
                                             {Base::Char, "uint8", "UInt8"},
                                             {Base::I8, "int8", "Int8"},
                                             {Base::U8, "uint8", "UInt8"},
                                             {Base::I16, "int16", "Int16"},
                                             {Base::U16, "uint16", "UInt16"},
                                             {Base::I32, "int32", "Int32"},
                                             {Base::U32, "uint32", "UInt32"},
                                             {Base::I64, "int64", "Int64"},
                                             {Base::U64, "uint64", "UInt64"},
                                             {Base::F32, "float32", "Float32"},
                                             {Base::F64, "float64", "Float64"},
                                             {Base::Enum, "int32", "Int32"},
                                             {Base::Text, "string", "String"}}};

const RosWord* word_of(Base base) {
  const auto* const found =
      std::find_if(kRosWords.begin(), kRosWords.end(), [base](const RosWord& word) { return word.base == base; });
  return found == kRosWords.end() ? nullptr : found;
}

std::string md5_of(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_md5(), nullptr);
  std::string hex;
  for (unsigned i = 0; i < size; ++i) {
    hex += fmt::format("{:02x}", digest[i]);
  }
  return hex;
}

// One message: its lines, and those for its checksum, in which other messages stand as their checksums.
struct RosMessage {
  std::string name;
  std::string text;
  std::string summed;
};

// Writes a message after those that are in it.
class MessageWriter {
 public:
  explicit MessageWriter(std::string package) : package_(std::move(package)) {}

  // Returns the checksum.
  std::string write(const std::string& name, const std::vector<Field>& fields) {
    RosMessage message{package_ + "/" + name, {}, {}};
    for (const Field& field : fields) {
      add_field(message, name, field);
    }
    return add(std::move(message));
  }
  std::string add(RosMessage message) {
    message.summed.resize(message.summed.size() - (message.summed.empty() ? 0 : 1));  // without the last line end
    messages_.push_back(std::move(message));
    return md5_of(messages_.back().summed);
  }
  // The last one, with all others behind it.
  [[nodiscard]] std::string definition() const {
    std::string text = messages_.back().text;
    for (std::size_t i = 0; i + 1 < messages_.size(); ++i) {
      text += std::string(80, '=') + "\nMSG: " + messages_[i].name + "\n" + messages_[i].text;
    }
    return text;
  }
  [[nodiscard]] const std::string& name() const { return messages_.back().name; }

 private:
  void add_field(RosMessage& message, const std::string& owner, const Field& field) {
    const std::string name = schema::ros_field(field.name);
    const std::string array = field.type.dims.empty() ? "" : fmt::format("[{}]", field.type.count());
    if (const RosWord* const word = word_of(field.type.base)) {
      const std::string line = fmt::format("{}{} {}\n", word->field, array, name);
      message.text += line;
      message.summed += line;
      return;
    }
    const std::string inner = owner + schema::ros_message(field.name);
    const std::string sum = write(inner, field.type.fields);
    message.text += fmt::format("{}/{}{} {}\n", package_, inner, array, name);
    message.summed += fmt::format("{} {}\n", sum, name);
  }

  std::string package_;
  std::vector<RosMessage> messages_;
};

// Float64MultiArray and the like.
MessageType multi_array(const RosWord& word) {
  MessageWriter writer("std_msgs");
  const std::string dimension =
      writer.add({"std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride\n",
                  "string label\nuint32 size\nuint32 stride\n"});
  const std::string layout =
      writer.add({"std_msgs/MultiArrayLayout", "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset\n",
                  dimension + " dim\nuint32 data_offset\n"});
  const std::string sum = writer.add({fmt::format("std_msgs/{}MultiArray", word.message),
                                      fmt::format("std_msgs/MultiArrayLayout layout\n{}[] data\n", word.field),
                                      fmt::format("{} layout\n{}[] data\n", layout, word.field)});
  return {writer.name(), writer.definition(), sum};
}

// Arrays of numbers are messages of std_msgs; there is none for texts and bools.
Base base_in_array(Base base) noexcept {
  return base == Base::Bool ? Base::U8 : base;
}

void put_u32(std::size_t number, std::vector<std::uint8_t>& to) {
  const auto value = static_cast<std::uint32_t>(number);
  const auto at = to.size();
  to.resize(at + sizeof(value));
  std::memcpy(to.data() + at, &value, sizeof(value));
}

void write_element(const Layout& layout, std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& to);

// Elements one after the other, without their number.
void write_elements(const Layout& layout, std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& to) {
  for (std::size_t i = 0; i < layout.count(); ++i) {
    write_element(layout, bytes.subspan(i * layout.element, layout.element), to);
  }
}

void write_element(const Layout& layout, std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& to) {
  if (layout.base == Base::Struct) {
    for (const Field& field : layout.fields) {
      write_elements(field.type, bytes.subspan(field.offset, field.type.size()), to);
    }
    return;
  }
  const auto end = layout.base == Base::Text ? std::find(bytes.begin(), bytes.end(), std::uint8_t{0}) : bytes.end();
  if (layout.base == Base::Text) {
    put_u32(static_cast<std::size_t>(end - bytes.begin()), to);
  }
  to.insert(to.end(), bytes.begin(), end);
}

bool is_multi_array(const Layout& layout) noexcept {
  return !layout.dims.empty() && layout.base != Base::Struct && layout.base != Base::Text;
}

}  // namespace

MessageType message_type(const std::string& variable, const Layout& layout) {
  if (is_multi_array(layout)) {
    return multi_array(*word_of(base_in_array(layout.base)));
  }
  if (layout.dims.empty() && layout.base != Base::Struct) {
    const RosWord& word = *word_of(layout.base);
    MessageWriter writer("std_msgs");
    const std::string line = fmt::format("{} data\n", word.field);
    const std::string sum = writer.add({fmt::format("std_msgs/{}", word.message), line, line});
    return {writer.name(), writer.definition(), sum};
  }
  const auto end = variable.rfind("::");
  const std::string own = end == std::string::npos ? variable : variable.substr(end + 2);
  MessageWriter writer(schema::ros_package(end == std::string::npos ? "" : variable.substr(0, end)));
  const std::string sum = layout.dims.empty() ? writer.write(schema::ros_message(own), layout.fields)
                                              : writer.write(schema::ros_message(own), {{"value", 0, layout}});
  return {writer.name(), writer.definition(), sum};
}

void write_message(const Layout& layout, std::span<const std::uint8_t> value, std::vector<std::uint8_t>& to) {
  if (is_multi_array(layout)) {
    put_u32(layout.dims.size(), to);
    std::size_t stride = layout.count();
    for (const std::size_t dim : layout.dims) {
      put_u32(0, to);  // no label
      put_u32(dim, to);
      put_u32(stride, to);
      stride /= dim;
    }
    put_u32(0, to);  // offset
    put_u32(layout.count(), to);
  }
  write_elements(layout, value, to);
}

}  // namespace indurop::ros
