// SPDX-License-Identifier: Apache-2.0
// Recordings through the C interface: files that the test wrote, with known values.

#include <gmock/gmock.h>
#include <indurop/c.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "history/recording/cdr.h"
#include "history/recording/mcap_writer.h"
#include "history/recording/omg_idl.h"
#include "tests/unit/core/schema/types.h"

namespace indurop::c {
namespace {

using schema::Base;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const schema::Type kPlace =
    schema::structure("cell::place_t", {{"on", schema::number(Base::Bool)}, {"x", schema::number(Base::Double)}}, {2});

struct Place {
  bool on;
  double x;
};
using Places = std::array<Place, 2>;

class CRecording : public ::testing::Test {
 protected:
  CRecording() { std::filesystem::create_directories(folder_); }
  ~CRecording() override {
    irp_recording_close(handle_);
    std::filesystem::remove_all(folder_);
  }

  std::uint16_t channel(recording::McapWriter& to, const std::string& topic, const schema::Type& type) {
    const recording::OmgIdl idl = recording::omg_idl(type);
    const auto schema = to.add_schema(idl.name, "omgidl", idl.text);
    const auto added = to.add_channel(*schema, topic, "cdr", {{"unit", "mm"}, {"declared", "cell.glb:3"}});
    EXPECT_TRUE(added.ok());
    return *added;
  }
  template <class T>
  static void put(recording::McapWriter& to, std::uint16_t channel, const schema::Type& type, std::uint64_t time,
                  const T& value) {
    std::vector<std::uint8_t> bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    std::vector<std::uint8_t> cdr;
    ASSERT_TRUE(recording::to_cdr(type, bytes, cdr).ok());
    ASSERT_TRUE(to.write(channel, time, time, 0, cdr).ok());
  }
  void write() {
    auto to = recording::McapWriter::create(path_, {});
    ASSERT_TRUE(to.ok());
    const schema::Type number = schema::number(Base::Double);
    const std::uint16_t gain = channel(*to, "cell::gain", number);
    const std::uint16_t places = channel(*to, "cell::places", kPlace);
    const std::uint16_t other = channel(*to, "press/cell::gain", number);
    put(*to, gain, number, 100, 1.0);
    put(*to, places, kPlace, 150, Places{{{true, 2.5}, {false, 0}}});
    put(*to, gain, number, 200, 1.0);  // another module that began with it
    put(*to, other, number, 250, 9.0);
    put(*to, gain, number, 300, 2.0);
    put(*to, places, kPlace, 300, Places{{{true, 2.5}, {true, -1}}});
    ASSERT_TRUE(to->close().ok());
  }
  void open() { ASSERT_EQ(irp_recording_open(path_.c_str(), &handle_), IRP_OK) << irp_error(); }
  std::uint32_t id_of(const char* name) {
    std::uint32_t id = 0;
    EXPECT_EQ(irp_recording_find(handle_, name, &id), IRP_OK) << irp_error();
    return id;
  }
  // Time, place among the names, value.
  using Samples = std::vector<std::tuple<std::int64_t, std::uint32_t, double>>;
  Samples numbers(const std::vector<const char*>& names, std::int64_t from, std::int64_t to, int repeats) {
    std::vector<std::uint32_t> ids;
    for (const char* name : names) {
      ids.push_back(id_of(name));
    }
    EXPECT_EQ(irp_recording_select(handle_, ids.data(), ids.size(), from, to, repeats), IRP_OK) << irp_error();
    Samples found;
    for (std::size_t taken = 2; taken == 2;) {
      std::array<std::int64_t, 2> times{};
      std::array<std::uint32_t, 2> which{};
      std::array<double, 2> values{};
      EXPECT_EQ(irp_recording_read(handle_, times.data(), which.data(), values.data(), sizeof(double), 2, &taken),
                IRP_OK);
      for (std::size_t i = 0; i < taken; ++i) {
        found.emplace_back(times[i], which[i], values[i]);
      }
    }
    return found;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("c_recording_" + std::to_string(::getpid()));
  const std::filesystem::path path_ = folder_ / "run.mcap";
  irp_recording* handle_ = nullptr;
};

TEST_F(CRecording, Names_and_describes_its_variables) {
  write();
  open();
  ASSERT_EQ(irp_recording_count(handle_), 3U);
  EXPECT_STREQ(irp_recording_name(handle_, 0), "cell::gain");
  EXPECT_STREQ(irp_recording_name(handle_, 2), "press/cell::gain");
  EXPECT_EQ(irp_recording_name(handle_, 3), nullptr);
  irp_variable about = IRP_VARIABLE_INIT;
  ASSERT_EQ(irp_recording_describe(handle_, id_of("places[1]"), &about), IRP_OK) << irp_error();
  EXPECT_STREQ(about.name, "cell::places[1]");
  EXPECT_STREQ(about.layout, "struct(16,8){on@0:bool,x@8:f64}");
  EXPECT_STREQ(about.type, "cell::place_t");
  EXPECT_STREQ(about.unit, "mm");
  EXPECT_STREQ(about.source, "cell.glb:3");
  EXPECT_EQ(about.size, 16U);
  std::int64_t begin = 0;
  std::int64_t end = 0;
  ASSERT_EQ(irp_recording_span(handle_, &begin, &end), IRP_OK);
  EXPECT_EQ(begin, 100);
  EXPECT_EQ(end, 300);
  EXPECT_EQ(irp_recording_damage(handle_, 0), nullptr);
}

TEST_F(CRecording, Samples_come_in_the_order_of_time) {
  write();
  open();
  EXPECT_THAT(
      numbers({"gain", "places[0].x", "press/gain"}, 0, INT64_MAX, 0),
      ElementsAre(std::tuple(100, 0, 1.0), std::tuple(150, 1, 2.5), std::tuple(250, 2, 9.0), std::tuple(300, 0, 2.0)));
  EXPECT_THAT(numbers({"gain"}, 0, INT64_MAX, 1),
              ElementsAre(std::tuple(100, 0, 1.0), std::tuple(200, 0, 1.0), std::tuple(300, 0, 2.0)));
  EXPECT_THAT(numbers({"places[1].x", "gain"}, 150, 299, 1),
              ElementsAre(std::tuple(150, 0, 0.0), std::tuple(200, 1, 1.0)));
  EXPECT_THAT(numbers({"gain", "cell::gain"}, 300, 300, 0),
              ElementsAre(std::tuple(300, 0, 2.0), std::tuple(300, 1, 2.0)));
}

TEST_F(CRecording, Says_what_is_wrong) {
  write();
  open();
  std::uint32_t id = 0;
  EXPECT_EQ(irp_recording_find(handle_, "gian", &id), IRP_NOT_FOUND);
  EXPECT_THAT(irp_error(), HasSubstr("cell::gain"));
  EXPECT_EQ(irp_recording_find(handle_, "pres/gain", &id), IRP_NOT_FOUND);
  id = 77;
  irp_variable about = IRP_VARIABLE_INIT;
  EXPECT_EQ(irp_recording_describe(handle_, id, &about), IRP_NOT_FOUND);
  EXPECT_EQ(irp_recording_select(handle_, &id, 1, 0, 1, 0), IRP_NOT_FOUND);
  id = id_of("places");
  ASSERT_EQ(irp_recording_select(handle_, &id, 1, 0, INT64_MAX, 0), IRP_OK);
  std::int64_t time = 0;
  double small = 0;
  std::size_t taken = 1;
  EXPECT_EQ(irp_recording_read(handle_, &time, &id, &small, sizeof small, 1, &taken), IRP_SIZE);
  EXPECT_EQ(taken, 0U);
  irp_recording* none = nullptr;
  EXPECT_EQ(irp_recording_open("/dev/null", &none), IRP_CORRUPT);
  EXPECT_EQ(irp_recording_open((folder_ / "none.mcap").c_str(), &none), IRP_NOT_FOUND);
}

TEST_F(CRecording, A_file_that_was_cut_off_is_read_as_far_as_it_goes) {
  write();
  const auto size = std::filesystem::file_size(path_);
  bool some = false;
  for (std::uintmax_t length = size - 1; length > 8; length -= 5) {
    std::filesystem::resize_file(path_, length);
    irp_recording_close(handle_);
    handle_ = nullptr;
    if (irp_recording_open(path_.c_str(), &handle_) != IRP_OK || irp_recording_count(handle_) == 0) {
      continue;
    }
    EXPECT_NE(irp_recording_damage(handle_, 0), nullptr) << length;
    const Samples found = numbers({"gain"}, 0, INT64_MAX, 0);
    some = some || found.size() == 2;
    EXPECT_LE(found.size(), 2U);
  }
  EXPECT_TRUE(some);
}

}  // namespace
}  // namespace indurop::c
