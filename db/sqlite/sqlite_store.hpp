// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "db/sqlite/keyed_mutex.hpp"
#include "db/sqlite/store_database.hpp"
#include "db/store.hpp"

namespace homeward::db {

/// What a file or folder is called that goes with a row: first it gets this end, then the row goes, then it does.
inline constexpr std::string_view kRemovedEnd = ".removed";
[[nodiscard]] std::filesystem::path removed_name(const std::filesystem::path& file);
/// Success or not: one that is left behind is seen to at the next start.
void forget_file(const std::filesystem::path& file);
/// The same for a file whose row was refused; where the disk failed nobody knows whether the row is on it after all,
/// and the file stays: the next start finds its row, or puts it into quarantine.
void forget_file_after(const Error& refused, const std::filesystem::path& file);

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
  Result<MapRecord> save_map_edit(const MapId& id, const map::TopologicalMap& edited,
                                  std::int64_t expected_revision) override;
  Result<StoredMap> load_map_contents(const MapId& id) override;
  Result<std::vector<std::uint8_t>> map_file_bytes(const MapId& id) override;
  Result<MapRecord> import_map(MapRecord map, std::string bytes) override;
  Result<std::int64_t> build_revision(const MapId& id) override;
  Result<std::string> build_report(const MapId& id) override;
  Result<BuildSimilarity> build_similarity(const MapId& id) override;
  Status remove_map(const MapId& id) override;

  // --- Drawn plans ---
  Result<wire::PlanView> add_plan(wire::PlanView plan, std::span<const std::uint8_t> file) override;
  Result<wire::PlanView> add_plan_version(const wire::PlanId& id, wire::PlanVersionView version,
                                          std::span<const std::uint8_t> file) override;
  Result<std::vector<wire::PlanView>> plans() override;
  Result<wire::PlanView> plan(const wire::PlanId& id) override;
  Result<std::vector<std::uint8_t>> plan_file(const wire::PlanId& id, std::int64_t version) override;
  Result<wire::PlanView> rename_plan(const wire::PlanId& id, const std::string& name) override;
  Status remove_plan(const wire::PlanId& id) override;
  Status tie_map(const MapPlanRecord& tie) override;
  Result<MapPlanRecord> map_plan(const MapId& map) override;
  Status untie_map(const MapId& map) override;

  // --- Drafts ---
  Result<DraftRecord> add_draft(DraftRecord draft) override;
  Result<std::vector<DraftRecord>> drafts(const MapId& map) override;
  Result<DraftRecord> draft(const MapId& map, const wire::DraftId& id) override;
  Result<DraftRecord> save_draft_edits(const wire::DraftId& id, const std::vector<map::Edit>& edits,
                                       std::int64_t expected_version) override;
  Status set_draft_check(const wire::DraftId& id, const wire::DraftCheck& check) override;
  Status keep_draft_findings(const wire::DraftId& id, const JobId& job, const std::string& findings) override;
  Result<std::optional<std::string>> draft_findings(const wire::DraftId& id) override;
  Status remove_draft(const wire::DraftId& id) override;

  // --- What drives saw ---
  Status add_drive(const Drive& drive) override;
  Result<std::vector<MissionId>> drives(const MapId& map) override;
  Result<Drive> drive(const MissionId& mission) override;
  Result<std::vector<MissionId>> kept_drives(const MapId& map) override;
  Status use_drives(const std::vector<MissionId>& missions) override;
  Status count_way_drives(const MapId& map, const std::vector<DrivenWay>& ways, bool driven, TimeUs t_us) override;
  Result<std::vector<WayDrives>> way_drives(const MapId& map) override;

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

  Status add_plan_poses(const MissionId& mission, const std::vector<wire::PlanPoseView>& poses) override;
  Result<std::vector<wire::PlanPoseView>> plan_poses(const MissionId& mission) override;

  // --- Its condition ---
  StoreCondition condition() override;

  // --- Repeated requests ---
  Result<std::optional<StoredAnswer>> answer(const RequestKey& key, TimeUs now_us) override;
  Status keep_answer(const RequestKey& key, const StoredAnswer& answer, TimeUs now_us) override;

 private:
  [[nodiscard]] std::filesystem::path image_file(const TourId& tour, std::int64_t number, ImageType type) const;
  [[nodiscard]] std::filesystem::path map_file(const MapId& map, std::int64_t revision) const;
  // The file of a map, and what people have edited since it was written (empty: nothing). With the map's lock:
  struct MapFile {
    MapRecord record;
    std::int64_t revision = 0;
    std::vector<std::uint8_t> edits;
  };
  Result<MapFile> file_of(const MapId& id);
  [[nodiscard]] Result<StoredMap> load(const MapFile& file) const;
  Status write_edits_into_file(const MapId& id, const MapFile& file);
  // What is there against what the rows name, at the start (store_contents.cpp):
  void sort_map_files();
  void sort_pictures();
  void put_aside(const std::filesystem::path& stray);
  void need_no_longer(const std::filesystem::path& file_or_folder);
  // Within a transaction:
  static void write_job(SQLite::Database& database, const wire::JobView& job);
  static void write_build(SQLite::Database& database, const MapId& id, std::int64_t revision, const MapBuild& build);
  static void mark_drives_used(SQLite::Database& database, const std::vector<MissionId>& missions);

  FolderLock lock_;
  std::filesystem::path folder_;
  StoreDatabase database_;
  // Taken before the database's, by the map and by the tour and picture:
  KeyedMutex map_file_locks_;
  KeyedMutex picture_locks_;
  struct Contents {
    std::vector<std::filesystem::path> missing;
    std::vector<std::string> quarantined;
  };
  std::mutex contents_mutex_;
  Contents contents_;
  struct Epochs {
    std::int64_t last = 0;
    std::int64_t set_apart = 0;  // up to this one, on the disk
  };
  std::mutex epochs_mutex_;  // taken before the database's
  std::map<RobotId, Epochs> epochs_;
};

}  // namespace homeward::db
