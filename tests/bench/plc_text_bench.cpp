// SPDX-License-Identifier: Apache-2.0
// Functions of texts and timers as generated code calls them, against the same by hand: results are cut to the room
// they go to, and what is behind them is zero. Interleave: --benchmark_enable_random_interleaving=true.

#include <indurop/plc/text.h>
#include <indurop/plc/timers.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace {

using namespace indurop;  // NOLINT(google-build-using-namespace)
using Text = iec::String<80>;
constexpr std::size_t kRoom = 80;

struct Texts {
  Text first{"temperature of the third motor: "};
  Text second{"87.5 degrees"};
  Text out;
  std::int16_t found = 0;
};

std::size_t length(const Text& text) noexcept {
  return ::strnlen(text.data, kRoom + 1);
}

// `out` becomes the parts one behind the other.
void put(Text& out, const char* a, std::size_t a_size, const char* b, std::size_t b_size) {
  a_size = std::min(a_size, kRoom);
  b_size = std::min(b_size, kRoom - a_size);
  std::memcpy(out.data, a, a_size);
  std::memcpy(out.data + a_size, b, b_size);
  std::memset(out.data + a_size + b_size, 0, kRoom + 1 - a_size - b_size);
}

void put(Text& out, const char* a, std::size_t a_size, const char* b, std::size_t b_size, const char* c,
         std::size_t c_size) {
  b_size = std::min(b_size, kRoom - a_size);
  c_size = std::min(c_size, kRoom - a_size - b_size);
  std::memcpy(out.data, a, a_size);
  std::memcpy(out.data + a_size, b, b_size);
  std::memcpy(out.data + a_size + b_size, c, c_size);
  std::memset(out.data + a_size + b_size + c_size, 0, kRoom + 1 - a_size - b_size - c_size);
}

std::size_t within(std::int16_t n, std::size_t size) noexcept {
  return n < 0 ? 0 : std::min(static_cast<std::size_t>(n), size);
}

template <void (*step)(Texts&, std::int16_t)>
void texts(benchmark::State& state) {
  Texts all;
  std::int16_t number = 5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(all);
    benchmark::DoNotOptimize(number);
    step(all, number);
    benchmark::DoNotOptimize(all);
  }
}

void concat_in_st(Texts& t, std::int16_t) {
  t.out = iec::concat_as<Text>(t.first, t.second);
}
void concat_by_hand(Texts& t, std::int16_t) {
  put(t.out, t.first.data, length(t.first), t.second.data, length(t.second));
}

void insert_in_st(Texts& t, std::int16_t n) {
  t.out = iec::insert_as<Text>(t.first, t.second, n);
}
void insert_by_hand(Texts& t, std::int16_t n) {
  const std::size_t size = length(t.first);
  const std::size_t at = within(n, size);
  put(t.out, t.first.data, at, t.second.data, length(t.second), t.first.data + at, size - at);
}

void delete_in_st(Texts& t, std::int16_t n) {
  t.out = Text(iec::erase(t.first, n, n));
}
void delete_by_hand(Texts& t, std::int16_t n) {
  const std::size_t size = length(t.first);
  const std::size_t at = within(static_cast<std::int16_t>(n - 1), size);
  const std::size_t end = at + within(n, size - at);
  put(t.out, t.first.data, at, t.first.data + end, size - end);
}

void replace_in_st(Texts& t, std::int16_t n) {
  t.out = iec::replace_as<Text>(t.first, t.second, n, n);
}
void replace_by_hand(Texts& t, std::int16_t n) {
  const std::size_t size = length(t.first);
  const std::size_t at = within(static_cast<std::int16_t>(n - 1), size);
  const std::size_t end = at + within(n, size - at);
  put(t.out, t.first.data, at, t.second.data, length(t.second), t.first.data + end, size - end);
}

void left_in_st(Texts& t, std::int16_t n) {
  t.out = Text(iec::left(t.first, n));
}
void left_by_hand(Texts& t, std::int16_t n) {
  put(t.out, t.first.data, within(n, length(t.first)), "", 0);
}

void right_in_st(Texts& t, std::int16_t n) {
  t.out = Text(iec::right(t.first, n));
}
void right_by_hand(Texts& t, std::int16_t n) {
  const std::size_t size = length(t.first);
  const std::size_t wanted = within(n, size);
  put(t.out, t.first.data + size - wanted, wanted, "", 0);
}

void mid_in_st(Texts& t, std::int16_t n) {
  t.out = Text(iec::mid(t.first, n, n));
}
void mid_by_hand(Texts& t, std::int16_t n) {
  const std::size_t size = length(t.first);
  const std::size_t at = within(static_cast<std::int16_t>(n - 1), size);
  put(t.out, t.first.data + at, within(n, size - at), "", 0);
}

void find_in_st(Texts& t, std::int16_t) {
  t.found = iec::find(t.first, iec::String<5>("motor"));
}
void find_by_hand(Texts& t, std::int16_t) {
  const std::string_view text(t.first.data, length(t.first));
  const void* const at = ::memmem(text.data(), text.size(), "motor", 5);
  t.found = at == nullptr ? std::int16_t{0} : static_cast<std::int16_t>(static_cast<const char*>(at) - text.data() + 1);
}

void len_in_st(Texts& t, std::int16_t) {
  t.found = iec::len(t.first);
}
void len_by_hand(Texts& t, std::int16_t) {
  t.found = static_cast<std::int16_t>(length(t.first));
}

#define PAIR(name)                                      \
  BENCHMARK(texts<name##_in_st>)->Name(#name "_in_st"); \
  BENCHMARK(texts<name##_by_hand>)->Name(#name "_by_hand")
PAIR(concat);
PAIR(insert);
PAIR(delete);
PAIR(replace);
PAIR(left);
PAIR(right);
PAIR(mid);
PAIR(find);
PAIR(len);

// A timer that runs for a second of scans of a millisecond, and begins again.
void ton_in_st(benchmark::State& state) {
  iec::Ton timer;
  iec::Scan scan;
  timer.pt = {iec::kSecond};
  for (auto _ : state) {
    benchmark::DoNotOptimize(timer);
    scan.time_ns += iec::kMillisecond;
    timer.in = !timer.q;
    timer(scan);
    benchmark::DoNotOptimize(timer);
  }
}
struct Timer {
  bool in = false;
  std::int64_t pt_ns = iec::kSecond;
  bool q = false;
  std::int64_t et_ns = 0;
  std::int64_t start_ns = 0;
  bool runs = false;
};
void ton_by_hand(benchmark::State& state) {
  Timer timer;
  std::int64_t now_ns = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(timer);
    now_ns += iec::kMillisecond;
    timer.in = !timer.q;
    if (!timer.in) {
      timer.q = timer.runs = false;
      timer.et_ns = 0;
    } else {
      timer.start_ns = timer.runs ? timer.start_ns : now_ns;
      timer.runs = true;
      timer.et_ns = std::min(now_ns - timer.start_ns, timer.pt_ns);
      timer.q = timer.et_ns == timer.pt_ns;
    }
    benchmark::DoNotOptimize(timer);
  }
}
BENCHMARK(ton_in_st);
BENCHMARK(ton_by_hand);

}  // namespace

BENCHMARK_MAIN();
