// SPDX-License-Identifier: Apache-2.0
// A board as `indurop serve` describes it, and frames of it, for tests.

#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "doors/mqtt/model/board.h"

namespace indurop::mqtt {

// gain (f64, mm) at 40, mode (enum) at 48, name (text, 8) at 52, joints (2 structs of x f32, on bool) at 60, count
// (i64) at 80; qualities at 88.
inline constexpr std::size_t kRecordSize = 93;

inline base::Json described(const std::string& board = "cell", std::uint32_t stream = 7) {
  return *base::Json::parse(R"({"type":"subscribed","id":1,"stream":)" + std::to_string(stream) + R"(,"board":")" +
                            board +
                            R"(","record_size":93,"quality_offset":88,"variables":[
    {"name":"knu::gain","offset":40,"unit":"mm","form":{"kind":"f64","size":8}},
    {"name":"knu::mode","offset":48,"unit":"","form":{"kind":"enum","name":"knu::mode_t","size":4,"enumerators":{"OFF":0,"AUTO":1}}},
    {"name":"station::name","offset":52,"unit":"","form":{"kind":"text","size":8}},
    {"name":"knu::joints","offset":60,"unit":"","form":{"kind":"struct","name":"knu::joints_t","size":8,"dims":[2],"fields":[
      {"name":"x","offset":0,"type":{"kind":"f32","size":4},"unit":"deg"},{"name":"on","offset":4,"type":{"kind":"bool","size":1}}]}},
    {"name":"knu::count","offset":80,"unit":"","form":{"kind":"i64","size":8}}],"missing":[]})");
}

// The bytes of a frame, all values 0.
class FrameBytes {
 public:
  explicit FrameBytes(std::uint32_t stream = 7) : bytes_(kRecordSize, '\0') {
    bytes_[0] = bytes_[1] = bytes_[2] = 1;  // version, kind, alive
    put(4, stream);
    put(16, std::int64_t{5'000'000});
    wall(1'700'000'000'123'000'000);
  }
  template <class T>
  FrameBytes& put(std::size_t at, T value) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  FrameBytes& wall(std::int64_t ns) { return put(24, ns); }
  FrameBytes& gain(double value) { return put(40, value); }
  FrameBytes& alive(bool value) { return put(2, static_cast<std::uint8_t>(value ? 1 : 0)); }
  [[nodiscard]] Frame frame() const { return *read_frame(bytes_); }

 private:
  std::string bytes_;
};

inline Board make_board(const std::string& name = "cell", std::vector<Deadband> deadbands = {}) {
  return Board::from(described(name), deadbands).value();
}

}  // namespace indurop::mqtt
