// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <fstream>
#include <functional>
#include <sstream>
#include <type_traits>

#include "db/map_file.hpp"
#include "support/server_fixture.hpp"
#include "wire/link_messages.hpp"

namespace homeward::testing {

/// An agent that says what the test tells it to.
class FakeAgent {
 public:
  int connect(std::uint16_t port, const std::string& robot, const std::string& token) {
    return socket.open(port, "/api/v1/robots/" + robot + "/link", {{"Authorization", "Bearer " + token}});
  }
  void say(const wire::AgentMessage& message) {
    const auto bytes = wire::encode(message);
    socket.send({bytes.begin(), bytes.end()}, false);
  }
  void hello(const std::string& session = "s1") {
    wire::Hello hello;
    hello.agent = "homeward-agent/test";
    hello.robot_name = "chair";
    hello.session = session;
    hello.camera = small_panorama_camera();
    hello.explores = explores;
    hello.repeats = repeats;
    say(hello);
    latest = idle();
  }
  void status(wire::DriveState state, const std::optional<wire::MissionOrder>& order = {}, std::int64_t index = 0,
              const std::optional<wire::Reason>& reason = {}) {
    wire::AgentStatus status;
    status.seq = ++status_seq;
    status.t_us = 1;
    status.state = state;
    status.path_index = index;
    status.reason = reason;
    status.arrival_probability = arrival_probability;
    status.estimate = estimate;
    status.possible_places = possible_places;
    status.question = question;
    status.displaced = displaced;
    status.astray = astray;
    if (order) {
      status.mission = order->mission;
      status.epoch = order->order.epoch;
    }
    say(status);
    latest = status;
  }
  /// The next message of one kind within `patience`; others are passed over, but orders are kept: which message comes
  /// first, an order or the belief that it follows from, is for the server to choose.
  template <class T>
  std::optional<T> await(std::chrono::milliseconds patience = std::chrono::milliseconds(60'000)) {
    if (auto kept = take_kept<T>()) return kept;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end && !socket.closed()) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      // Like a real one it goes on telling how it is while it waits, or it would be taken for dead.
      constexpr std::chrono::milliseconds kTells{500};
      const auto bytes = socket.receive(std::clamp(left, std::chrono::milliseconds(1), kTells));
      // By the clock: answers that come before half a second is over, each of them, must not silence it.
      if (std::chrono::steady_clock::now() - told_at >= kTells) {
        told_at = std::chrono::steady_clock::now();
        repeat();
        if (while_waiting) while_waiting();
      }
      if (!bytes) continue;
      if (auto heard = as<T>(*bytes)) return heard;
    }
    return std::nullopt;
  }
  /// The same of what the server has sent by now.
  template <class T>
  std::optional<T> heard_by_now() {
    if (auto kept = take_kept<T>()) return kept;
    socket.take_in_all();
    while (const auto bytes = socket.receive(std::chrono::milliseconds(0))) {
      if (auto heard = as<T>(*bytes)) return heard;
    }
    return std::nullopt;
  }
  void look(unsigned room) {
    const std::string picture = room_picture(room, static_cast<unsigned>(++frame_seq) + 1000U);
    say(wire::Frame{frame_seq, frame_seq, {picture.begin(), picture.end()}});
  }

  /// A server that has closed the connection hears nothing more.
  void repeat() {
    if (!latest || socket.closed()) return;
    try {
      say(*latest);
    } catch (const std::exception&) {
      latest.reset();
    }
  }

  /// What has come, if it is of that kind; an order that is not asked for is kept.
  template <class T>
  std::optional<T> as(const std::string& bytes) {
    const auto message = decoded(bytes);
    if (!message) return std::nullopt;
    if (const auto* asked_for = std::get_if<T>(&*message)) return *asked_for;
    if (const auto* order = std::get_if<wire::MissionOrder>(&*message)) kept_orders.push_back(*order);
    return std::nullopt;
  }
  template <class T>
  std::optional<T> take_kept() {
    if constexpr (std::is_same_v<T, wire::MissionOrder>) {
      if (!kept_orders.empty()) {
        auto first = std::move(kept_orders.front());
        kept_orders.pop_front();
        return first;
      }
    }
    return std::nullopt;
  }

  static std::optional<wire::ServerMessage> decoded(const std::string& bytes) {
    const auto message =
        wire::decode_server_message({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    EXPECT_TRUE(message) << message.error().message;
    return message ? std::optional(*message) : std::nullopt;
  }

  static wire::AgentStatus idle() {
    wire::AgentStatus status;
    status.t_us = 1;
    status.state = wire::DriveState::kIdle;
    return status;
  }

  SocketClient socket;
  std::optional<wire::AgentStatus> latest;  // told again while it waits
  bool explores = false;                    // as its hello says
  bool repeats = false;                     // the same
  // What it states in each status from now on.
  std::optional<double> arrival_probability;
  std::optional<wire::EstimateReport> estimate;
  std::vector<wire::EstimateReport> possible_places;
  std::optional<wire::QuestionReport> question;
  std::int64_t displaced = 0;
  bool astray = false;
  std::deque<wire::MissionOrder> kept_orders;  // heard while something else was awaited
  std::function<void()> while_waiting;
  std::chrono::steady_clock::time_point told_at = std::chrono::steady_clock::now();
  std::int64_t status_seq = 0;
  std::int64_t frame_seq = 0;
};

class DrivingTest : public ServerTest {
 protected:
  void add_robot() {
    const nlohmann::json made = admin->post("/api/v1/robots", {{"name", "chair"}}).json();
    robot = made.at("id");
    token = made.at("token");
    root = "/api/v1/robots/" + robot;
  }
  /// A map of three rooms, which is built once for all tests and imported by those after the first.
  std::string taught_map() {
    static std::string exported;
    if (!exported.empty()) return imported_map(exported);
    std::string built = built_map(3);
    exported = admin->get("/api/v1/maps/" + built + "/export").body;
    return built;
  }
  /// Puts the robot on such a map. From then on the server's time stands but for what the test lets pass: no lease runs
  /// out while a machine is slow.
  void put_on_map() {
    map = taught_map();
    ASSERT_EQ(admin->put(root + "/map", {{"map", map}}).status, 200);
    destination = admin->get("/api/v1/maps/" + map + "/graph").json().at("destinations")[0].at("id");
    clock.stand();
  }
  std::string imported_map(const std::string& bytes) {
    const Answer imported =
        admin->send("POST", "/api/v1/maps/import", bytes, {{"Content-Type", "application/vnd.sqlite3"}});
    EXPECT_EQ(imported.status, 201) << imported.body;
    return imported.json().at("map").at("id");
  }
  /// A map like the robot's with a weak way straight from the first place to the destination, and the robot on it.
  void add_second_way() {
    const auto file = config.data / "second_way.hwmap";
    const std::string bytes = admin->get("/api/v1/maps/" + map + "/export").body;
    std::ofstream(file, std::ios::binary) << bytes;
    auto stored = db::load_map(file);
    ASSERT_TRUE(stored) << stored.error().message;
    const PlaceId goal = stored->map.destinations.at(0).place;
    for (const bool back : {false, true}) {
      map::Edge edge;
      edge.from = back ? goal : stored->map.places.front().id;
      edge.to = back ? stored->map.places.front().id : goal;
      edge.weak = true;
      stored->map.edges.push_back(edge);
    }
    ASSERT_TRUE(db::save_map(file, stored->map, stored->thumbnails));
    std::stringstream edited;
    edited << std::ifstream(file, std::ios::binary).rdbuf();
    map = imported_map(edited.str());
    ASSERT_EQ(admin->put(root + "/map", {{"map", map}}).status, 200);
  }
  std::string take_lease(HttpClient& client) {
    const std::string lease = client.post(root + "/lease", {{"take_over", true}}).json().at("lease").at("id");
    if (&client == &*admin) admins_lease = lease;
    return lease;
  }
  /// As an open dashboard does.
  void keep_lease() {
    if (!admins_lease.empty()) admin->put(root + "/lease", {{"lease_id", admins_lease}});
  }
  Answer send_home(const std::string& lease) {
    return admin->post(root + "/missions", {{"lease_id", lease}, {"destination", destination}});
  }
  void find_itself(FakeAgent& agent) {
    agent.while_waiting = [this] { keep_lease(); };
    agent.hello();
    ASSERT_TRUE(agent.await<wire::Welcome>());
    for (int i = 0; i < 20; ++i) {
      agent.look(1);
      const auto belief = agent.await<wire::BeliefReport>(std::chrono::milliseconds(60'000));
      ASSERT_TRUE(belief) << admin->get(root).body;
      if (!belief->lost) return;
    }
    FAIL() << "the fake agent never learnt where it is";
  }
  /// Returns once the server has worked off all that it was told by now.
  void let_work_off(FakeAgent& agent) {
    agent.socket.take_in_all();  // then the server has all that the agent has said
    app->work_off();
  }
  /// The first message of one kind that the server sends when it has worked off all that it was told by now; others are
  /// passed over.
  template <class T>
  std::optional<T> comes_at_once(FakeAgent& agent) {
    let_work_off(agent);
    app->tick();
    app->work_off();  // what the tick has given to others
    return agent.heard_by_now<T>();
  }
  /// Lets time pass for the server, in which the agent goes on telling how it is and its driver keeps the lease; gives
  /// the first message of one kind that the server sends in it.
  template <class T>
  std::optional<T> comes_within(FakeAgent& agent, std::chrono::milliseconds time) {
    constexpr std::chrono::milliseconds kTells{500};
    let_work_off(agent);  // what it was told, it was told before
    for (std::chrono::milliseconds left = time; left.count() > 0; left -= kTells) {
      clock.pass(std::min(left, kTells));
      agent.repeat();
      keep_lease();
      if (auto message = comes_at_once<T>(agent)) return message;
    }
    return std::nullopt;
  }
  nlohmann::json mission_now(const nlohmann::json& mission) {
    return admin->get(root + "/missions/" + mission.at("id").get<std::string>()).json();
  }
  nlohmann::json wait_for_state(const nlohmann::json& mission, const std::string& state) {
    for (int i = 0; i < 12'000 && mission_now(mission).at("state") != state; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return mission_now(mission);
  }

  std::string robot, token, root, map, destination, admins_lease;
};

}  // namespace homeward::testing
