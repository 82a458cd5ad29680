// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <mutex>

#include "db/sqlite/store_database.hpp"
#include "db/store.hpp"

namespace homeward::db {

/// The store in SQLite: rows in homeward.db, pictures in tours/, map files in maps/.
class SqliteStore final : public Store {
 public:
  /// Throws.
  explicit SqliteStore(const std::filesystem::path& folder);

  // --- People ---
  Result<User> add_user(User user) override;
  Result<std::vector<User>> users() override;
  Result<std::optional<User>> user_by_name(const std::string& name) override;
  Result<std::optional<User>> user(const UserId& id) override;
  Status set_password_hash(const UserId& id, const std::string& password_hash) override;
  Status set_role(const UserId& id, wire::Role role) override;
  Status remove_user(const UserId& id) override;

  // --- Secrets ---
  Result<Session> add_session(Session session) override;
  Result<std::vector<Session>> sessions() override;
  Status remove_session(const std::string& hash) override;
  Result<Token> add_token(Token token) override;
  Result<std::vector<Token>> tokens() override;
  Status revoke_token(const std::string& id) override;
  Status set_setup_hash(const std::string& hash) override;
  Result<std::optional<std::string>> setup_hash() override;
  Result<User> finish_setup(const std::string& hash, User admin) override;

  // --- Tours ---
  Result<Tour> add_tour(Tour tour) override;
  Result<std::vector<Tour>> tours() override;
  Result<Tour> tour(const TourId& id) override;
  Result<PutImage> put_image(const TourId& tour, TourImage image, std::span<const std::uint8_t> bytes) override;
  Result<std::vector<TourImage>> tour_images(const TourId& tour) override;
  Result<std::vector<std::uint8_t>> image_bytes(const TourId& tour, std::int64_t number) override;
  Result<PutImage> put_sweep(const TourId& tour, const TourSweep& sweep) override;
  Result<std::map<std::int64_t, RangeSweep>> sweeps(const TourId& tour) override;
  Status set_marks(const TourId& tour, const std::vector<wire::TourMark>& marks) override;
  Result<std::vector<wire::TourMark>> marks(const TourId& tour) override;
  Status complete_tour(const TourId& id) override;
  Status remove_tour(const TourId& id) override;

  // --- Maps ---
  Result<MapRecord> add_map(MapRecord map) override;
  Result<std::vector<MapRecord>> maps() override;
  Result<MapRecord> map(const MapId& id) override;
  Status set_map_state(const MapId& id, wire::MapState state) override;
  Status set_map_refine(const MapId& id, wire::RefineMode mode) override;
  Result<MapRecord> save_map_contents(const MapId& id, const map::TopologicalMap& contents,
                                      const Thumbnails& thumbnails, std::int64_t expected_revision,
                                      const AlongWithContents& along) override;
  Result<StoredMap> load_map_contents(const MapId& id) override;
  Result<std::vector<std::uint8_t>> map_file_bytes(const MapId& id) override;
  Result<MapRecord> import_map(MapRecord map, std::span<const std::uint8_t> file) override;
  Status remove_map(const MapId& id) override;

  // --- What drives saw ---
  Status add_drive(const Drive& drive) override;
  Result<std::vector<MissionId>> drives(const MapId& map) override;
  Result<Drive> drive(const MissionId& mission) override;
  Status remove_drives(const std::vector<MissionId>& missions) override;

  // --- Jobs ---
  Result<wire::JobView> add_job(wire::JobView job) override;
  Status update_job(const wire::JobView& job) override;
  Result<std::vector<wire::JobView>> jobs() override;
  Result<std::vector<wire::JobView>> unfinished_jobs() override;
  Result<wire::JobView> job(const JobId& id) override;

  // --- Robots and missions ---
  Result<RobotRecord> add_robot(RobotRecord robot) override;
  Result<std::vector<RobotRecord>> robots() override;
  Result<RobotRecord> robot(const RobotId& id) override;
  Status set_robot_map(const RobotId& id, const std::optional<MapId>& map) override;
  Result<std::int64_t> next_epoch(const RobotId& id) override;
  Status remove_robot(const RobotId& id) override;
  Result<wire::MissionView> add_mission(wire::MissionView mission) override;
  Status update_mission(const wire::MissionView& mission) override;
  Result<std::vector<wire::MissionView>> missions(const RobotId& robot, int limit) override;
  Result<wire::MissionView> mission(const MissionId& id) override;

  // --- Repeated requests ---
  Result<std::optional<StoredAnswer>> answer(const RequestKey& key, TimeUs now_us) override;
  Status keep_answer(const RequestKey& key, const StoredAnswer& answer, TimeUs now_us) override;

 private:
  [[nodiscard]] std::filesystem::path image_file(const TourId& tour, std::int64_t number, ImageType type) const;
  [[nodiscard]] std::filesystem::path map_file(const MapId& map, std::int64_t revision) const;
  void remove_stray_map_files();
  // Within a transaction:
  static void write_job(SQLite::Database& database, const wire::JobView& job);
  static void forget_drives(SQLite::Database& database, const std::vector<MissionId>& missions);

  FolderLock lock_;
  std::filesystem::path folder_;
  StoreDatabase database_;
  std::mutex map_files_mutex_;  // taken before the database's
};

}  // namespace homeward::db
