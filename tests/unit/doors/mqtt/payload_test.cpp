// SPDX-License-Identifier: Apache-2.0
// Payloads as bytes: written out by hand from the field numbers of the specification and the wire format of protocol
// buffers. tests/integration/mqtt has foreign readers.

#include "doors/mqtt/sparkplug/payload.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "described_board.h"
#include "doors/mqtt/sparkplug/metrics.h"

namespace indurop::mqtt {
namespace {

using std::string_literals::operator""s;  // NOLINT(misc-unused-using-decls): it is used

TEST(SparkplugPayload, Has_the_bytes_of_the_specification) {
  Payload payload;
  payload.timestamp_ms = 300;
  payload.seq = 5;
  Metric metric;
  metric.name = "a/b";
  metric.alias = 1;
  metric.timestamp_ms = 2;
  metric.datatype = 3;
  metric.is_historical = true;
  metric.value = static_cast<std::uint32_t>(-1);
  metric.unit = "mm";
  metric.quality = 192;
  payload.metrics = {metric};
  const std::string properties =
      "\x0a\x07"
      "engUnit\x0a\x07Quality\x12\x06\x08\x0c\x42\x02mm\x12\x05\x08\x03\x18\xc0\x01";
  const std::string body =
      "\x0a\x03"
      "a/b\x10\x01\x18\x02\x20\x03\x28\x01\x4a"s +
      static_cast<char>(properties.size()) + properties + "\x50\xff\xff\xff\xff\x0f";
  EXPECT_EQ(encode(payload), "\x08\xac\x02\x12"s + static_cast<char>(body.size()) + body + "\x18\x05");
}

TEST(SparkplugPayload, Has_a_field_for_each_kind_of_value) {
  const auto bytes_of = [](WireValue value) {
    Payload payload;
    payload.metrics.emplace_back().value = std::move(value);
    return encode(payload).substr(2);
  };
  EXPECT_EQ(bytes_of({}), "\x38\x01");
  EXPECT_EQ(bytes_of(std::uint64_t{1} << 63U), "\x58\x80\x80\x80\x80\x80\x80\x80\x80\x80\x01");
  EXPECT_EQ(bytes_of(1.0F), "\x65\x00\x00\x80\x3f"s);
  EXPECT_EQ(bytes_of(-2.0), "\x69\x00\x00\x00\x00\x00\x00\x00\xc0"s);
  EXPECT_EQ(bytes_of(false), "\x70\x00"s);
  EXPECT_EQ(bytes_of("x"s), "\x7a\x01x");
}

TEST(SparkplugPayload, Is_read_as_it_was_written) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 500; ++round) {
    Payload payload;
    payload.timestamp_ms = random();
    payload.seq = random() % 256;
    for (std::size_t i = random() % 5; i > 0; --i) {
      Metric& metric = payload.metrics.emplace_back();
      metric.name = std::string(random() % 3, 'n');
      metric.alias = random() >> (random() % 64);
      metric.is_historical = random() % 2 == 0;
      const std::array<WireValue, 7> values{
          std::monostate(), true, static_cast<std::uint32_t>(random()), random(), 1.5F, -2.5, "text"s};
      metric.value = values.at(random() % values.size());
    }
    const auto read = decode(encode(payload));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->timestamp_ms, payload.timestamp_ms);
    EXPECT_EQ(read->seq, payload.seq);
    ASSERT_EQ(read->metrics.size(), payload.metrics.size());
    for (std::size_t i = 0; i < read->metrics.size(); ++i) {
      EXPECT_EQ(read->metrics[i].name, payload.metrics[i].name);
      EXPECT_EQ(read->metrics[i].alias, payload.metrics[i].alias);
      EXPECT_EQ(read->metrics[i].is_historical, payload.metrics[i].is_historical);
      EXPECT_EQ(read->metrics[i].value, payload.metrics[i].value);
    }
  }
}

TEST(SparkplugPayload, Random_and_shortened_bytes_do_no_harm) {
  std::mt19937 random(5);
  for (int i = 0; i < 5000; ++i) {
    std::string bytes(random() % 40, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(random());
    }
    const auto read = decode(bytes);
    EXPECT_TRUE(!read || read->metrics.size() <= bytes.size());
  }
  EXPECT_FALSE(decode("\x12\x7f"));
  EXPECT_FALSE(decode("\x08"));
  EXPECT_FALSE(decode(std::string(11, '\xff')));
  EXPECT_TRUE(decode(""));
}

TEST(SparkplugMetrics, Carry_each_type_both_ways) {
  using schema::Base;
  const auto there_and_back = [](Base base, auto value) {
    std::vector<std::uint8_t> bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    const Leaf leaf{"x", 0, static_cast<std::uint32_t>(bytes.size()), base, ""};
    return json_for(base, wire_value_of(leaf, bytes))->dump();
  };
  EXPECT_EQ(there_and_back(Base::Bool, true), "true");
  EXPECT_EQ(there_and_back(Base::Int8, std::int8_t{-128}), "-128");
  EXPECT_EQ(there_and_back(Base::UInt8, std::uint8_t{255}), "255");
  EXPECT_EQ(there_and_back(Base::Int16, std::int16_t{-32768}), "-32768");
  EXPECT_EQ(there_and_back(Base::Int32, INT32_MIN), "-2147483648");
  EXPECT_EQ(there_and_back(Base::Enum, std::int32_t{-7}), "-7");
  EXPECT_EQ(there_and_back(Base::UInt32, UINT32_MAX), "4294967295");
  EXPECT_EQ(there_and_back(Base::Int64, INT64_MIN), "-9223372036854775808");
  EXPECT_EQ(there_and_back(Base::UInt64, UINT64_MAX), "18446744073709551615");
  EXPECT_EQ(there_and_back(Base::Float, 0.5F), "0.5");
  EXPECT_EQ(there_and_back(Base::Double, -1e300), "-1e+300");
  EXPECT_EQ(there_and_back(Base::Text, std::array<char, 4>{'a', 'b', 0, 'c'}), "\"ab\"");
}

TEST(SparkplugMetrics, Take_numbers_of_hosts_as_what_the_variable_is) {
  using schema::Base;
  EXPECT_EQ(json_for(Base::Int16, 3.0)->dump(), "3");
  EXPECT_EQ(json_for(Base::Double, std::uint32_t{3})->dump(), "3");
  EXPECT_EQ(json_for(Base::Int64, static_cast<std::uint32_t>(-1))->dump(), "-1");
  EXPECT_FALSE(json_for(Base::Double, "3"s));
  EXPECT_FALSE(json_for(Base::Text, 3.0));
  EXPECT_FALSE(json_for(Base::Bool, std::uint32_t{1}));
  EXPECT_FALSE(json_for(Base::Double, true));
  EXPECT_FALSE(json_for(Base::Double, std::monostate()));
}

TEST(SparkplugMetrics, Are_found_by_name_and_alias) {
  const Board board = make_board();
  const AliasTable sut(board, 100);
  EXPECT_EQ(sut.end(), 108U);
  const auto found = [&sut](std::string name, std::optional<std::uint64_t> alias) {
    Metric metric;
    metric.name = std::move(name);
    metric.alias = alias;
    const auto place = sut.find(metric);
    return place ? std::to_string(place->variable) + "." + std::to_string(place->leaf) : "none";
  };
  EXPECT_EQ(found("knu/joints[1]/x", {}), "3.2");
  EXPECT_EQ(found("", sut.alias(3, 2)), "3.2");
  EXPECT_EQ(found("", 100), "0.0");
  EXPECT_EQ(found("", 107), "4.0");
  EXPECT_EQ(found("", 108), "none");
  EXPECT_EQ(found("", 99), "none");
  EXPECT_EQ(found("knu/joint", {}), "none");
  EXPECT_EQ(found("", {}), "none");
}

}  // namespace
}  // namespace indurop::mqtt
