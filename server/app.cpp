// SPDX-License-Identifier: Apache-2.0
#include "server/app.hpp"

#include <spdlog/spdlog.h>

#include <fstream>
#include <thread>

#include "core/version.hpp"
#include "db/secrets.hpp"
#include "server/auth/passwords.hpp"
#include "server/front/app_front.hpp"
#include "server/http/http_server.hpp"
#include "server/routes/account_routes.hpp"
#include "server/routes/draft_routes.hpp"
#include "server/routes/evidence_routes.hpp"
#include "server/routes/exploration_routes.hpp"
#include "server/routes/inspection_routes.hpp"
#include "server/routes/job_routes.hpp"
#include "server/routes/map_routes.hpp"
#include "server/routes/operation_routes.hpp"
#include "server/routes/plan_routes.hpp"
#include "server/routes/robot_routes.hpp"
#include "server/routes/socket_routes.hpp"
#include "server/routes/tour_routes.hpp"
#include "server/routes/user_routes.hpp"
#include "server/work/build_jobs.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::server {
namespace {

constexpr int kRequestWorkers = 4;
constexpr std::size_t kRequestQueue = 256;
constexpr int kRequestNiceness = 5;  // behind the pictures of those who drive
constexpr std::size_t kHeavyQueue = 64;
constexpr std::size_t kSlowQueue = 64;
constexpr int kSlowNiceness = 7;  // behind requests
constexpr std::size_t kPlanQueue = 64;
constexpr int kPlanNiceness = 7;  // behind beliefs and requests: nobody drives by it
constexpr std::size_t kBulkQueue = 4;
constexpr int kBulkNiceness = 10;  // as builds
constexpr std::size_t kJournalQueue = 100'000;

int threads_of(const AppConfig& config) {
  if (config.threads > 0) return config.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// A secret file is made readable by its owner alone before anything is in it.
Status write_private_file(const std::filesystem::path& file, const std::string& text) {
  std::error_code error;
  std::filesystem::remove(file, error);
  {
    const std::ofstream empty(file);
    if (!empty) return fail(ErrorCode::kIo, "Cannot write " + file.string() + ".", file.string());
  }
  using std::filesystem::perms;
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write, error);
  std::ofstream stream(file);
  stream << text << '\n';
  stream.close();
  if (error || !stream) return fail(ErrorCode::kIo, "Cannot write " + file.string() + ".", file.string());
  return {};
}

}  // namespace

std::vector<std::string> problems(const AppConfig& config) {
  std::vector<std::string> list;
  if (config.data.empty()) list.emplace_back("--data names no folder.");
  if (!is_loopback(config.address) && !config.allow_plain_http) {
    list.push_back("--listen " + config.address +
                   " can be reached from other machines, and plain HTTP would show passwords to the network. Put a "
                   "TLS proxy in front and listen on 127.0.0.1, or say --allow-plain-http.");
  }
  if (!config.web.empty() && !std::filesystem::is_regular_file(config.web / "index.html")) {
    list.push_back("--web " + config.web.string() + " has no index.html; build the dashboard first.");
  }
  for (const std::string& proxy : config.trusted_proxies) {
    if (!is_ip_address(proxy)) list.push_back("--trust-proxy " + proxy + " is not an IP address.");
  }
  if (config.longest_mission_s < 0) list.emplace_back("--longest-mission-s must not be negative.");
  if (config.threads < 0 || config.threads > 256) list.emplace_back("--threads must be between 0 and 256.");
  return list;
}

struct App::Parts {
  Parts(const AppConfig& config, std::unique_ptr<db::Store> opened, const Clock& clock_in)
      : clock(clock_in),
        store(std::move(opened)),
        workers(kRequestWorkers, kRequestQueue, kRequestNiceness),
        heavy(threads_of(config), kHeavyQueue),
        slow(1, kSlowQueue, kSlowNiceness),
        on_plans(1, kPlanQueue, kPlanNiceness),
        bulk(1, kBulkQueue, kBulkNiceness),
        journal(1, kJournalQueue),
        access(config.allowed_hosts, config.trusted_proxies),
        files(config.web),
        authenticator(*store, clock),
        idempotency(*store, clock),
        tours(*store, clock),
        maps(*store, events, clock),
        plans(*store, maps, events, clock),
        plan_follower(*store, maps, plans, events, on_plans, journal, clock),
        driving(*store, maps, plan_follower, events, heavy, journal, clock, config.longest_mission_s),
        drafts(*store, maps, events, clock),
        inspection(*store, maps),
        jobs(*store, maps, drafts, events, clock, threads_of(config)),
        front({router, access, files, authenticator, idempotency, metrics, workers, heavy, slow, bulk, passwords,
               clock}) {
    // A draft that no dashboard is told of now is asked for by whoever opens its map.
    maps.when_changed([this](const MapId& map) {
      if (!slow.try_run([this, map] { drafts.map_changed(map); }))
        spdlog::warn("drafts of map {} are not told", map.str());
    });
    driving.when_arrived([this](const db::Drive& drive) { jobs.add_drive(drive); });
    add_account_routes(router, authenticator, *store);
    add_user_routes(router, authenticator, *store, clock);
    add_tour_routes(router, tours, *store);
    add_map_routes(router, maps, jobs, *store);
    add_draft_routes(router, drafts, jobs, *store);
    add_evidence_routes(router, maps);
    add_inspection_routes(router, inspection);
    add_plan_routes(router, plans, *store);
    add_job_routes(router, jobs);
    add_robot_routes(router, driving, authenticator, *store);
    add_exploration_routes(router, driving);
    add_socket_routes(router, driving, events, [this] { return snapshot(); });
    add_operation_routes(router, metrics, *store);
    metrics.gauge("homeward_robots_online", "Robots with a link", [this] { return double(driving.online()); });
    metrics.gauge("homeward_dashboards", "Open event sockets", [this] { return double(events.subscribers()); });
    metrics.gauge("homeward_heavy_queue", "Pictures that wait", [this] { return double(heavy.waiting()); });
    metrics.gauge("homeward_password_queue", "Passwords that wait", [this] { return double(passwords.waiting()); });
  }

  // Sockets first, so that nothing new comes in; the journal is written to its end.
  ~Parts() {
    if (http) http->stop();
    passwords.stop();
    workers.stop();
    heavy.stop();
    slow.stop();
    on_plans.stop();
    bulk.stop();
    plan_follower.keep_what_is_left();
    driving.keep_what_is_left();
    journal.finish();
  }

  wire::Snapshot snapshot() {
    wire::Snapshot snapshot;
    snapshot.build = name_with_version("homeward-server");
    snapshot.robots = driving.list();
    if (const auto all = store->jobs()) {
      // Finished ones from long ago are history, and drives that taught nothing are no news.
      std::vector<wire::JobView> shown;
      for (const wire::JobView& job : *all) {
        // ... nor are checks of drafts, which say themselves what was found.
        const bool learnt_nothing =
            job.kind == wire::JobKind::kRefine && job.state == wire::JobState::kDone && job.notes.empty();
        const bool under_way = job.state == wire::JobState::kQueued || job.state == wire::JobState::kRunning;
        const bool no_news = learnt_nothing || (job.kind == wire::JobKind::kCheck && !under_way);
        if (!no_news) shown.push_back(job);
      }
      const std::size_t first = shown.size() > 50 ? shown.size() - 50 : 0;
      for (std::size_t i = first; i < shown.size(); ++i) {
        const auto now = jobs.get(shown[i].id);
        snapshot.jobs.push_back(now ? *now : shown[i]);
      }
    }
    if (const auto all = store->maps()) {
      for (const db::MapRecord& map : *all) snapshot.maps.push_back(view_of(map));
    }
    return snapshot;
  }

  // The secret of the one-time link; empty where there is an administrator already. Before the first request, so that
  // nobody who asks is told otherwise.
  Result<std::string> setup_secret() {
    const auto users = store->users();
    if (!users) return pass_on(users);
    if (!users->empty()) return std::string();
    std::string secret = db::random_secret();
    if (const Status status = store->set_setup_hash(db::secret_hash(secret)); !status) return pass_on(status);
    return secret;
  }

  Status offer_setup(const AppConfig& config, const std::string& secret) {
    if (secret.empty()) return {};
    const bool any = config.address == "0.0.0.0" || config.address == "::";
    const std::string host = any ? "localhost" : (config.address == "::1" ? "[::1]" : config.address);
    setup_link = "http://" + host + ":" + std::to_string(http->port()) + "/setup?token=" + secret;
    return config.setup_file.empty() ? Status() : write_private_file(config.setup_file, setup_link);
  }

  // For the operator: readyz, which anybody may ask, tells no names.
  void tell_condition() {
    const db::StoreCondition condition = store->condition();
    for (const std::string& file : condition.missing) spdlog::error("{} is missing from the data folder", file);
    if (condition.missing_files > std::int64_t(condition.missing.size())) {
      spdlog::error("{} files are missing in all", condition.missing_files);
    }
    for (const std::string& file : condition.quarantined) {
      spdlog::warn("nothing in the database names {}; it was put there", file);
    }
  }

  void tick() {
    const SteadyTime now = clock.steady();
    driving.tick(now);
    events.beat(now);
  }

  void work_off() {
    passwords.work_off();
    workers.work_off();
    heavy.work_off();
    slow.work_off();
    on_plans.work_off();  // what beliefs have given it
    bulk.work_off();
    journal.work_off();  // what the others have given it
    jobs.work_off();     // and what that has given them
  }

  const Clock& clock;
  std::unique_ptr<db::Store> store;
  EventHub events;
  Metrics metrics;
  WorkPool workers;
  WorkPool heavy;
  WorkPool slow;
  WorkPool on_plans;
  WorkPool bulk;
  WorkPool journal;
  PasswordQueue passwords;
  AccessPolicy access;
  StaticFiles files;
  Authenticator authenticator;
  Idempotency idempotency;
  TourService tours;
  MapService maps;
  PlanService plans;
  PlanFollower plan_follower;
  Driving driving;
  DraftService drafts;
  InspectionService inspection;
  BuildJobs jobs;
  Router router;
  AppFront front;
  std::unique_ptr<HttpServer> http;
  std::string setup_link;
};

App::App() = default;
App::~App() = default;

Result<std::unique_ptr<App>> App::start(const AppConfig& config, const Clock& clock) {
  auto store = db::open_sqlite_store(config.data);
  if (!store) return pass_on(store);
  hash_of_nobody();  // the first login must not take longer than others
  std::unique_ptr<App> app(new App());
  app->parts_ = std::make_unique<Parts>(config, std::move(*store), clock);
  Parts& parts = *app->parts_;
  parts.tell_condition();
  if (const Status status = parts.authenticator.load(); !status) return pass_on(status);
  if (const Status status = parts.driving.load(); !status) return pass_on(status);
  const auto secret = parts.setup_secret();
  if (!secret) return pass_on(secret);
  auto http = HttpServer::start(config.address, config.port, parts.front);
  if (!http) return pass_on(http);
  parts.http = std::move(*http);
  if (const Status status = parts.offer_setup(config, *secret); !status) return pass_on(status);
  parts.http->every(static_cast<int>(wire::kPermitEvery_ms), [&parts] { parts.tick(); });
  return app;
}

std::uint16_t App::port() const { return parts_->http->port(); }

const std::string& App::setup_link() const { return parts_->setup_link; }

const Router& App::router() const { return parts_->router; }

void App::tick() { parts_->tick(); }

void App::work_off() { parts_->work_off(); }

}  // namespace homeward::server
