// SPDX-License-Identifier: Apache-2.0
#include "server/ws/event_hub.hpp"

#include <deque>
#include <map>
#include <nlohmann/json.hpp>

namespace homeward::server {
namespace {

std::string key_of(const wire::Event& event) {
  struct Key {
    std::string operator()(const wire::Snapshot&) const { return "snapshot"; }
    std::string operator()(const wire::RobotView& robot) const { return "robot/" + robot.id.str(); }
    std::string operator()(const wire::JobView& job) const { return "job/" + job.id.str(); }
    std::string operator()(const wire::MapInfoView& map) const { return "map/" + map.id.str(); }
    std::string operator()(const wire::MissionView& mission) const { return "mission/" + mission.id.str(); }
    // One key, so that a draft that goes is told last.
    std::string operator()(const wire::DraftView& draft) const { return "draft/" + draft.id.str(); }
    std::string operator()(const wire::DraftGone& gone) const { return "draft/" + gone.draft.str(); }
    std::string operator()(const wire::ExplorationView& view) const { return "exploration/" + view.robot.str(); }
    std::string operator()(const wire::PlanPoseTold& told) const { return "plan_pose/" + told.pose->robot.str(); }
    std::string operator()(const wire::Heartbeat&) const { return "heartbeat"; }
  };
  return std::visit(Key{}, event);
}

constexpr std::size_t kMaxMessageBytes = 4096;  // dashboards only listen
constexpr std::size_t kMaxObjects = 4096;

}  // namespace

/// One dashboard. Messages are numbered as they are sent, so that leaving out old states leaves no gap.
class EventSubscriber : public SocketHandler {
 public:
  void add(const std::string& key, const wire::Event& event) {
    std::shared_ptr<Socket> socket;
    bool too_slow = false;
    {
      const std::scoped_lock lock(mutex_);
      if (!waiting_.contains(key)) order_.push_back(key);
      waiting_.insert_or_assign(key, event);
      too_slow = order_.size() > kMaxObjects;
      socket = socket_;
    }
    if (!socket) return;
    if (too_slow) {
      socket->close(kCloseTryLater, "too slow");
    } else {
      socket->wake();
    }
  }

  void on_open(const std::shared_ptr<Socket>& socket) override {
    const std::scoped_lock lock(mutex_);
    socket_ = socket;
  }
  void on_message(std::span<const std::uint8_t>, bool) override {}
  void on_closed() override {
    const std::scoped_lock lock(mutex_);
    socket_.reset();
    waiting_.clear();
    order_.clear();
  }
  [[nodiscard]] std::size_t max_message_bytes() const override { return kMaxMessageBytes; }

  std::optional<Outgoing> next_message() override {
    wire::Event event;
    std::int64_t seq = 0;
    {
      const std::scoped_lock lock(mutex_);
      if (!ready_ || order_.empty()) return std::nullopt;
      const auto found = waiting_.find(order_.front());
      event = std::move(found->second);
      waiting_.erase(found);
      order_.pop_front();
      seq = ++seq_;
    }
    const std::string text =
        wire::event_to_json(event, seq).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return Outgoing{std::make_shared<const std::string>(text), true};
  }

  void begin(const wire::Snapshot& snapshot) {
    const std::scoped_lock lock(mutex_);
    // Changes from before the snapshot are older than it or the same; they may follow it without harm.
    order_.push_front("snapshot");
    waiting_.insert_or_assign("snapshot", wire::Event(snapshot));
    ready_ = true;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<Socket> socket_;
  std::map<std::string, wire::Event> waiting_;
  std::deque<std::string> order_;
  std::int64_t seq_ = 0;
  bool ready_ = false;
};

void EventHub::publish(const wire::Event& event) {
  std::vector<std::shared_ptr<EventSubscriber>> targets;
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(subscribers_, [&](const auto& weak) {
      auto target = weak.lock();
      if (!target) return true;
      targets.push_back(std::move(target));
      return false;
    });
  }
  const std::string key = key_of(event);
  for (const auto& target : targets) target->add(key, event);
}

void EventHub::beat(std::chrono::steady_clock::time_point now) {
  {
    const std::scoped_lock lock(mutex_);
    if (beat_at_ && now - *beat_at_ < kHeartbeatEvery) return;
    beat_at_ = now;
  }
  publish(wire::Heartbeat{});
}

std::shared_ptr<SocketHandler> EventHub::subscribe(const MakeSnapshot& snapshot) {
  auto subscriber = std::make_shared<EventSubscriber>();
  {
    const std::scoped_lock lock(mutex_);
    subscribers_.push_back(subscriber);
  }
  // Subscribed first, so that nothing that changes while the snapshot is made is missed.
  subscriber->begin(snapshot());
  return subscriber;
}

std::size_t EventHub::subscribers() {
  const std::scoped_lock lock(mutex_);
  std::erase_if(subscribers_, [](const auto& weak) { return weak.expired(); });
  return subscribers_.size();
}

}  // namespace homeward::server
