// SPDX-License-Identifier: Apache-2.0
// Two boards whose routes change while they run, on a transport that loses frames. What the reading board has is
// compared with the list of values that the other one has ever written.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "network/mirror/frames/exchange.h"
#include "network/mirror/simulated/message.h"
#include "store/vars/together.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kRoutesMs = 1'000'000;

schema::Variable routes_variable(const std::string& name) {
  schema::Variable v;
  v.name = name;
  v.type.base = schema::Base::UInt64;
  v.type.element_size = v.type.align = 8;
  if (name.starts_with("wide")) {
    v.type.dims = {400};  // too large for a packet
    v.kind = abi::Kind::Ring;
  } else {
    v.kind = abi::Kind::Scalar;
  }
  v.type_hash = schema::hash_of(v.type);
  return v;
}

// What a board sends comes to the other one when that is pumped.
class LossyPlane final : public Plane {
 public:
  Opened offer_frames(Stream stream) override {
    offered.insert(stream);
    return {};
  }
  Opened offer_catalogue() override {
    ++catalogue_writers;
    return {};
  }
  Opened exchange_beacons(BeaconListener& /*listener*/) override { return {}; }
  Result<std::unique_ptr<Subscription>, base::Problem> subscribe(const std::string& /*board*/, Stream stream,
                                                                 FrameListener& listener) override {
    listeners[stream] = &listener;
    for (const auto& [key, bytes] : other->last) {  // a late joiner gets the last frame of each part
      if (key.first == stream) {
        other->frames.emplace_back(stream, bytes);
      }
    }
    return std::make_unique<Subscription>();
  }
  void close() noexcept override {}
  bool send(const indurop_wire_Frame& frame, Stream stream) noexcept override {
    EXPECT_TRUE(offered.contains(stream));
    last[{stream, frame.part}] = to_bytes(frame);
    frames.emplace_back(stream, to_bytes(frame));
    return true;
  }
  bool send(const indurop_wire_Catalogue& catalogue) noexcept override {
    catalogues.push_back(to_bytes(catalogue));
    return true;
  }
  bool send(const indurop_wire_Beacon& /*beacon*/) noexcept override { return true; }

  // `keep`: returns whether the next frame is not lost.
  template <class Keep>
  void pump(Exchange& to, Keep keep) {
    for (const auto& bytes : std::exchange(catalogues, {})) {
      (void)with_catalogue(bytes, [&](const indurop_wire_Catalogue& catalogue) { to.announced(catalogue); });
    }
    for (const auto& [stream, bytes] : std::exchange(frames, {})) {
      if (FrameListener* const listener = other->listeners[stream]; listener != nullptr && keep()) {
        (void)with_frame(bytes, [&, from = stream](const auto& frame) { listener->frame_came(frame, from); });
      }
    }
  }

  LossyPlane* other = nullptr;
  std::set<Stream> offered;
  int catalogue_writers = 0;
  std::map<Stream, FrameListener*> listeners;
  std::map<std::pair<Stream, std::uint32_t>, std::vector<std::uint8_t>> last;
  std::deque<std::pair<Stream, std::vector<std::uint8_t>>> frames;
  std::vector<std::vector<std::uint8_t>> catalogues;
};

struct RoutedBoard {
  RoutedBoard(const std::string& name, const std::string& other)
      : node(name + std::to_string(::getpid())), board(name) {
    schema::Schema schema;
    schema.variables.push_back(routes_variable("base"));
    auto made = vars::Store::create(node, schema);
    EXPECT_TRUE(made.ok());
    store = std::make_unique<vars::Store>(std::move(made).value());
    settings.network.board = name;
    settings.network.lease_ns = 500 * kRoutesMs;
    settings.boards = {other};
  }
  ~RoutedBoard() {
    exchange.reset();
    store.reset();
    (void)vars::remove_node(node);
  }
  void open() {
    now.routes = settings.routes;
    auto made = Exchange::make(settings, node, *store, tick);
    ASSERT_TRUE(made.ok());
    exchange = std::move(made).value();
    ASSERT_TRUE(exchange->open(plane).ok());
  }
  void grow(const std::string& name) {
    const std::vector<schema::Variable> all{routes_variable(name)};
    if (store->find(all[0].name_hash()) == nullptr) {
      ASSERT_TRUE(store->reserve(all).ok());
      auto next = store->prepare(all);
      ASSERT_TRUE(next.ok());
      store->announce(std::move(next).value());
    }
  }
  [[nodiscard]] const vars::DirectoryEntry& entry(const std::string& name) const {
    return *store->find(routes_variable(name).name_hash());
  }
  void write(const std::string& name, std::uint64_t value) const {
    const vars::DirectoryEntry& to = entry(name);
    std::vector<std::uint8_t> bytes(to.value_size);
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
      std::memcpy(&bytes[i], &value, 8);
    }
    EXPECT_TRUE(store->write(to, 0, bytes).ok());
  }
  // All of its elements must be equal.
  [[nodiscard]] std::uint64_t read(const std::string& name) const {
    const vars::DirectoryEntry& from = entry(name);
    std::vector<std::uint8_t> bytes(from.value_size);
    EXPECT_TRUE(store->read(from, 0, bytes).ok());
    EXPECT_EQ(std::memcmp(bytes.data(), bytes.data() + bytes.size() - 8, 8), 0);
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data(), 8);
    return value;
  }
  [[nodiscard]] std::int64_t confirmed(const std::string& name) const {
    return abi::confirmed_of(store->entry(entry(name).name_hash, 0), entry(name).kind).load();
  }
  [[nodiscard]] const PeerRecord& peer() const { return exchange->block().peers()[0]; }

  std::string node;
  std::string board;
  std::unique_ptr<vars::Store> store;
  std::atomic<std::uint64_t> tick{1};
  Settings settings;
  struct {
    Routes routes;
  } now;
  LossyPlane plane;
  std::unique_ptr<Exchange> exchange;
};

class RoutesOf : public ::testing::Test {
 protected:
  void SetUp() override {
    a_.plane.other = &b_.plane;
    b_.plane.other = &a_.plane;
    a_.settings.routes.outgoing = {{"base"}};
    b_.settings.routes.incoming = {{"base", "ra"}};
    set_time();
    a_.open();
    b_.open();
    run();
  }
  void set_time() {
    a_.store->virtual_time().store(time_);
    b_.store->virtual_time().store(time_);
  }
  // For some time; lost: how many of a hundred frames.
  void run(int milliseconds = 400, unsigned lost = 0) {
    for (int i = 0; i < milliseconds; ++i) {
      time_ += kRoutesMs;
      set_time();
      (void)a_.exchange->send(time_, false);
      (void)a_.exchange->send(time_, true);
      a_.plane.pump(*b_.exchange, [&] { return random_() % 100 >= lost; });
    }
  }
  void send_too(const std::string& name) {
    a_.grow(name);
    a_.now.routes.outgoing.push_back({name});
    a_.exchange->follow(a_.now.routes);
  }
  void read_too(const std::string& name) {
    b_.grow(name);
    b_.now.routes.incoming.push_back({name, "ra"});
    b_.exchange->follow(b_.now.routes);
  }
  void leave(const std::string& name) {
    std::erase_if(b_.now.routes.incoming, [&name](const Incoming& in) { return in.variable == name; });
    b_.exchange->follow(b_.now.routes);
  }
  void write(const std::string& name) {
    a_.write(name, ++written_);
    ever_[name].push_back(written_);
  }

  RoutedBoard a_{"ra", "rb"};
  RoutedBoard b_{"rb", "ra"};
  std::int64_t time_ = 1'000'000 * kRoutesMs;
  std::uint64_t written_ = 0;
  std::map<std::string, std::vector<std::uint64_t>> ever_;
  std::mt19937 random_{7};  // NOLINT(cert-msc32-c, cert-msc51-cpp): the same in each run
};

TEST_F(RoutesOf, What_is_added_arrives_and_what_was_there_goes_on) {
  for (const char* name : {"late", "wide"}) {
    send_too(name);
    read_too(name);
    a_.write("base", ++written_);
    run(5);
    EXPECT_EQ(b_.read("base"), written_) << "nothing is waited for";
    write(name);
    run();
    EXPECT_EQ(b_.read(name), ever_[name].back());
    EXPECT_GT(b_.confirmed(name), 0);
  }
  EXPECT_EQ(b_.peer().refused.load(), 0U);
  EXPECT_EQ(b_.peer().state.load(), PeerState::Alive);
  EXPECT_EQ(b_.peer().wanted.load(), 3U);
  EXPECT_EQ(a_.plane.catalogue_writers, 1) << "a board that withdraws its catalogue seems to be gone";
}

TEST_F(RoutesOf, The_order_in_which_boards_get_them_does_not_matter) {
  read_too("late");
  run();
  EXPECT_EQ(b_.peer().state.load(), PeerState::Alive) << "the other board may get it later";
  EXPECT_EQ(b_.confirmed("late"), abi::kNeverConfirmed);
  EXPECT_NE(b_.peer().problem.get(), "");
  send_too("late");
  write("late");
  run();
  EXPECT_EQ(b_.read("late"), written_);
  EXPECT_EQ(b_.peer().problem.get(), "");
}

TEST_F(RoutesOf, A_variable_that_was_sent_already_can_be_read_later) {
  send_too("late");
  write("late");
  run();
  read_too("late");
  run();
  EXPECT_EQ(b_.read("late"), written_);
  EXPECT_EQ(b_.peer().refused.load(), 0U);
}

TEST_F(RoutesOf, Added_variables_belong_to_the_same_updates) {
  send_too("late");
  read_too("late");
  run();
  std::uint64_t values[2] = {};
  std::vector<abi::Piece> pieces;
  for (const char* name : {"base", "late"}) {
    pieces.push_back(
        {b_.store->entry(b_.entry(name).name_hash, 0), &values[pieces.size()], abi::Kind::Scalar, 8, 0, 0, 0});
  }
  for (std::uint64_t i = 1; i < 50; ++i) {
    a_.write("base", i);
    a_.write("late", 2 * i);
    run(1);
    ASSERT_TRUE(vars::read_together(pieces)) << i;
    EXPECT_EQ(values[0], i);
    EXPECT_EQ(values[1], 2 * i);
  }
}

TEST_F(RoutesOf, A_variable_that_is_left_is_one_of_the_board_and_can_be_read_again) {
  send_too("late");
  read_too("late");
  write("late");
  run();
  leave("late");
  EXPECT_EQ(b_.confirmed("late"), 0);
  EXPECT_EQ(b_.read("late"), written_) << "its value stays";
  b_.write("late", 77);
  write("late");
  run();
  EXPECT_EQ(b_.read("late"), 77U) << "frames do not change it";
  read_too("late");
  run();
  EXPECT_EQ(b_.read("late"), written_);
  leave("base");
  EXPECT_EQ(b_.confirmed("base"), 0) << "also of the start";
}

TEST_F(RoutesOf, Random_changes_show_no_value_that_was_not_written) {
  const std::vector<std::string> names{"base", "x1", "x2", "x3", "wide1", "wide2"};
  std::set<std::string> sent{"base"};
  std::set<std::string> wanted{"base"};
  for (int i = 0; i < 600; ++i) {
    const std::string& name = names[random_() % names.size()];
    switch (random_() % 8) {
      case 0:
        if (sent.insert(name).second) {
          send_too(name);
        }
        break;
      case 1:
        if (wanted.insert(name).second) {
          read_too(name);
        }
        break;
      case 2:
        if (wanted.erase(name) > 0) {
          leave(name);
        }
        break;
      default:
        if (sent.contains(name)) {
          write(name);
        }
        run(static_cast<int>(random_() % 20), 30);
    }
    for (const std::string& each : wanted) {
      const std::uint64_t value = b_.read(each);
      const auto& all = ever_[each];
      ASSERT_TRUE(value == 0 || std::find(all.begin(), all.end(), value) != all.end()) << each << " is " << value;
    }
    if (i % 50 == 49) {
      run(500);
      for (const std::string& each : wanted) {
        if (sent.contains(each)) {
          ASSERT_EQ(b_.read(each), ever_[each].empty() ? 0 : ever_[each].back()) << each << " after " << i;
        }
      }
    }
  }
  EXPECT_EQ(b_.peer().state.load(), PeerState::Alive);
}

}  // namespace
}  // namespace indurop::mirror
