// SPDX-License-Identifier: Apache-2.0
// The messages between boards of a simulated plant, as bytes between their programs, all on one machine.

#pragma once

#include <indurop/idl/wire.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "network/mirror/frames/frame_layout.h"

namespace indurop::mirror {

struct Message {
  enum class Kind : std::uint32_t {
    Prompt,  // a frame of this stream
    BestEffort,
    Bulk,
    Catalogue,
    Beacon,
    Subscribe,  // to the network: requests frames of `board` and stream `part` from now on
    Gone,       // from the network: nothing was received of `board` for a lease, or it has left
  };
  Kind kind = Kind::Prompt;
  std::uint32_t board = 0;   // sender, by its index in the manifest
  std::uint32_t part = 0;    // of a frame
  std::int64_t time_ns = 0;  // time of sending; at the receiver: of arrival
  std::vector<std::uint8_t> body;

  [[nodiscard]] bool is_frame() const noexcept { return kind <= Kind::Bulk; }
};

// Writes numbers and texts one after the other, in the machine's native format.
class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  // Writes numbers one after the other; ByteReader::get_all() reads the same.
  template <class... T>
  void put_all(const std::tuple<T&...>& numbers) {
    std::apply([&](const auto&... each) { (put(each), ...); }, numbers);
  }
  void put_bytes(std::span<const std::uint8_t> bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put_text(std::string_view text) { put_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }
  void put_message(const Message& message);
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

// Reads what ByteWriter wrote. If bytes are missing, the missing values are zero and ok() returns false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) noexcept : bytes_(bytes) {}
  template <class T>
  T get() noexcept {
    T value{};
    if (const auto from = next(sizeof value); !from.empty()) {
      std::memcpy(&value, from.data(), sizeof value);
    }
    return value;
  }
  template <class... T>
  void get_all(const std::tuple<T&...>& numbers) noexcept {
    std::apply([&](auto&... each) { ((each = get<std::remove_cvref_t<decltype(each)>>()), ...); }, numbers);
  }
  std::span<const std::uint8_t> get_bytes() noexcept { return next(get<std::uint32_t>()); }
  std::string get_text() {
    const auto bytes = get_bytes();
    return {bytes.begin(), bytes.end()};
  }
  Message get_message();
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  std::span<const std::uint8_t> next(std::size_t count) noexcept;
  std::span<const std::uint8_t> bytes_;
  bool ok_ = true;
};

std::vector<std::uint8_t> to_bytes(const indurop_wire_Frame& frame);
std::vector<std::uint8_t> to_bytes(const indurop_wire_Catalogue& catalogue);
std::vector<std::uint8_t> to_bytes(const indurop_wire_Beacon& beacon);
// The sample exists only during the call. Returns false, without a call, if the bytes are no valid sample.
bool with_frame(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Frame&)>& use);
bool with_catalogue(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Catalogue&)>& use);
bool with_beacon(std::span<const std::uint8_t> bytes, const std::function<void(const indurop_wire_Beacon&)>& use);

}  // namespace indurop::mirror
