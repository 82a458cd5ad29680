// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "db/map_file.hpp"
#include "db/store_records.hpp"

namespace homeward::db {

/// Everything that the server must not forget. What a function has answered with success survives a killed process and
/// a power cut. Every function may be called from any thread. Records without an id are given a random one.
/// Errors of all: kIo (disk trouble), kDiskFull, kCorruptFile (the database does not hold together); others are named.
class Store {
 public:
  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  virtual ~Store() = default;

  // --- People -----------------------------------------------------------------------------------------------------
  /// Errors: kConflict (the name is taken; upper and lower case are the same).
  virtual Result<User> add_user(User user) = 0;
  virtual Result<std::vector<User>> users() = 0;  // by name
  virtual Result<std::optional<User>> user_by_name(const std::string& name) = 0;
  virtual Result<std::optional<User>> user(const UserId& id) = 0;
  /// A new password also ends the sessions of the person. Errors: kNotFound.
  virtual Status set_password_hash(const UserId& id, const std::string& password_hash) = 0;
  /// Errors: kNotFound.
  virtual Status set_role(const UserId& id, wire::Role role) = 0;
  /// With all sessions. Errors: kNotFound, kConflict (the last admin).
  virtual Status remove_user(const UserId& id) = 0;

  // --- Secrets; see secrets.hpp for the hashes --------------------------------------------------------------------
  /// Also clears sessions that ended before `created_us`. Errors: kNotFound (the person).
  virtual Result<Session> add_session(Session session) = 0;
  virtual Result<std::vector<Session>> sessions() = 0;  // those that have ended may be among them
  /// Success also when there is none.
  virtual Status remove_session(const std::string& hash) = 0;
  virtual Result<Token> add_token(Token token) = 0;
  virtual Result<std::vector<Token>> tokens() = 0;  // oldest first; those that have ended may be among them
  /// Errors: kNotFound.
  virtual Status revoke_token(const std::string& id) = 0;
  /// Of the one-time set-up link; a new one replaces it.
  virtual Status set_setup_hash(const std::string& hash) = 0;
  virtual Result<std::optional<std::string>> setup_hash() = 0;
  /// The first admin against the set-up secret, which is used up by it, in one step.
  /// Errors: kForbidden (another secret or none left), kConflict (the name is taken).
  virtual Result<User> finish_setup(const std::string& hash, User admin) = 0;

  // --- Tours ------------------------------------------------------------------------------------------------------
  virtual Result<Tour> add_tour(Tour tour) = 0;
  virtual Result<std::vector<Tour>> tours() = 0;  // oldest first
  /// Errors: kNotFound.
  virtual Result<Tour> tour(const TourId& id) = 0;
  /// The same bytes under the same number again are kSame, other bytes kConflict; neither changes anything. An image
  /// without a file name is called after its number ("000012.jpg", by its `type`); `sha256` and `size` are filled in
  /// here. Errors: kNotFound (tour), kConflict (the tour is complete, or another image has the file name).
  virtual Result<PutImage> put_image(const TourId& tour, TourImage image, std::span<const std::uint8_t> bytes) = 0;
  virtual Result<std::vector<TourImage>> tour_images(const TourId& tour) = 0;  // by number
  /// Errors: kNotFound.
  virtual Result<std::vector<std::uint8_t>> image_bytes(const TourId& tour, std::int64_t number) = 0;
  /// What a range sensor saw with an image, kept in whole millimetres. The same sweep again is kSame, another one
  /// kConflict. Errors: kNotFound (tour, image), kConflict (the tour is complete, or the image has another file name).
  virtual Result<PutImage> put_sweep(const TourId& tour, const TourSweep& sweep) = 0;
  /// By number. Errors: kNotFound, kCorruptFile (a kept sweep that cannot be read).
  virtual Result<std::map<std::int64_t, RangeSweep>> sweeps(const TourId& tour) = 0;
  /// Replaces all marks. Errors: kNotFound.
  virtual Status set_marks(const TourId& tour, const std::vector<wire::TourMark>& marks) = 0;
  virtual Result<std::vector<wire::TourMark>> marks(const TourId& tour) = 0;
  /// Success also when it was complete already. Whether enough pictures are there is the caller's to judge.
  /// Errors: kNotFound.
  virtual Status complete_tour(const TourId& id) = 0;
  /// With its pictures. Errors: kNotFound, kConflict (a map was built from it).
  virtual Status remove_tour(const TourId& id) = 0;

  // --- Maps -------------------------------------------------------------------------------------------------------
  /// A map without contents yet (revision 0, kBuilding unless stated). Errors: kNotFound (a tour).
  virtual Result<MapRecord> add_map(MapRecord map) = 0;
  virtual Result<std::vector<MapRecord>> maps() = 0;  // oldest first
  /// Errors: kNotFound.
  virtual Result<MapRecord> map(const MapId& id) = 0;
  /// Errors: kNotFound.
  virtual Status set_map_state(const MapId& id, wire::MapState state) = 0;
  /// kOff: what drives saw is kept no longer. Errors: kNotFound.
  virtual Status set_map_refine(const MapId& id, wire::RefineMode mode) = 0;
  /// Keeps new contents as revision `contents.revision` and makes the map ready, together with what is to change
  /// `along` with it. The older file goes once the row has been switched. Errors: kNotFound, kStaleRevision
  /// (`expected_revision` is not the present one).
  virtual Result<MapRecord> save_map_contents(const MapId& id, const map::TopologicalMap& contents,
                                              const Thumbnails& thumbnails, std::int64_t expected_revision,
                                              const AlongWithContents& along = {}) = 0;
  /// Keeps the next revision of a map that people have edited. Images, places, appearances and thumbnails have to be
  /// those of the present one, and so has the state without edits, or, where it has none, the present one is that
  /// state; so no more is written than what edits change. Errors: kNotFound, kStaleRevision.
  virtual Result<MapRecord> save_map_edit(const MapId& id, const map::TopologicalMap& edited,
                                          std::int64_t expected_revision) = 0;
  /// Errors: kNotFound (also before the first build), those of load_map.
  virtual Result<StoredMap> load_map_contents(const MapId& id) = 0;
  /// The bytes of the map file, for export. Errors: kNotFound.
  virtual Result<std::vector<std::uint8_t>> map_file_bytes(const MapId& id) = 0;
  /// A map from the bytes of a map file, as it is; they are freed once they are on the disk, before the map is read
  /// from there. Errors: those of load_map.
  virtual Result<MapRecord> import_map(MapRecord map, std::string file) = 0;
  // Of the latest build of a map here. Errors: kNotFound (the map, or it was not built here).
  virtual Result<std::int64_t> build_revision(const MapId& id) = 0;
  virtual Result<std::string> build_report(const MapId& id) = 0;
  virtual Result<BuildSimilarity> build_similarity(const MapId& id) = 0;
  /// With its jobs; robots on it are left without a map. Errors: kNotFound.
  virtual Status remove_map(const MapId& id) = 0;

  // --- Drawn plans -------------------------------------------------------------------------------------------------
  /// Of its versions the first one counts, whose file this is. Errors: none besides those of all.
  virtual Result<wire::PlanView> add_plan(wire::PlanView plan, std::span<const std::uint8_t> file) = 0;
  /// The next version. Errors: kNotFound, kConflict (wire::kMaxPlanVersions).
  virtual Result<wire::PlanView> add_plan_version(const wire::PlanId& id, wire::PlanVersionView version,
                                                  std::span<const std::uint8_t> file) = 0;
  virtual Result<std::vector<wire::PlanView>> plans() = 0;  // oldest first
  /// Errors: kNotFound.
  virtual Result<wire::PlanView> plan(const wire::PlanId& id) = 0;
  /// As it was uploaded. Errors: kNotFound (plan or version).
  virtual Result<std::vector<std::uint8_t>> plan_file(const wire::PlanId& id, std::int64_t version) = 0;
  /// Errors: kNotFound.
  virtual Result<wire::PlanView> rename_plan(const wire::PlanId& id, const std::string& name) = 0;
  /// With its versions. Errors: kNotFound, kConflict (a map is tied to it).
  virtual Status remove_plan(const wire::PlanId& id) = 0;
  /// In place of what the map was tied to. Errors: kNotFound (the map, or this version of the plan).
  virtual Status tie_map(const MapPlanRecord& tie) = 0;
  /// Errors: kNotFound (the map, or it is tied to no plan).
  virtual Result<MapPlanRecord> map_plan(const MapId& map) = 0;
  /// Success also where it is tied to none. Errors: kNotFound (the map).
  virtual Status untie_map(const MapId& map) = 0;

  // --- Drafts ------------------------------------------------------------------------------------------------------
  /// Errors: kNotFound (the map).
  virtual Result<DraftRecord> add_draft(DraftRecord draft) = 0;
  virtual Result<std::vector<DraftRecord>> drafts(const MapId& map) = 0;  // oldest first
  /// Errors: kNotFound (also of another map).
  virtual Result<DraftRecord> draft(const MapId& map, const wire::DraftId& id) = 0;
  /// Its edits, as the next version. Errors: kNotFound, kStaleRevision (`expected_version` is not the present one).
  virtual Result<DraftRecord> save_draft_edits(const wire::DraftId& id, const std::vector<map::Edit>& edits,
                                               std::int64_t expected_version) = 0;
  /// The check that was asked for last; what an earlier one found stays until this one has ended. Errors: kNotFound.
  virtual Status set_draft_check(const wire::DraftId& id, const wire::DraftCheck& check) = 0;
  /// What a check found, as JSON, unless another was asked for meanwhile. Success also when the draft is gone.
  virtual Status keep_draft_findings(const wire::DraftId& id, const JobId& job, const std::string& findings) = 0;
  /// Nothing before a check has ended. Errors: kNotFound (the draft).
  virtual Result<std::optional<std::string>> draft_findings(const wire::DraftId& id) = 0;
  /// Errors: kNotFound.
  virtual Status remove_draft(const wire::DraftId& id) = 0;

  // --- What drives saw ---------------------------------------------------------------------------------------------
  /// The eight newest of each map are kept, none of one that is not to learn. Errors: kNotFound (the map).
  virtual Status add_drive(const Drive& drive) = 0;
  /// Those that the map has not learnt from, oldest first.
  virtual Result<std::vector<MissionId>> drives(const MapId& map) = 0;
  /// All, oldest first.
  virtual Result<std::vector<MissionId>> kept_drives(const MapId& map) = 0;
  /// Errors: kNotFound.
  virtual Result<Drive> drive(const MissionId& mission) = 0;
  /// The map has learnt from these, or is not to. Success also when there are none.
  virtual Status use_drives(const std::vector<MissionId>& missions) = 0;

  /// Counts one drive on each of these ways, which was `driven` to its end or failed there. Errors: kNotFound (the
  /// map).
  virtual Status count_way_drives(const MapId& map, const std::vector<DrivenWay>& ways, bool driven, TimeUs t_us) = 0;
  /// Of ways that missions came to, by their places.
  virtual Result<std::vector<WayDrives>> way_drives(const MapId& map) = 0;

  // --- Jobs -------------------------------------------------------------------------------------------------------
  /// Errors: kNotFound (the map).
  virtual Result<wire::JobView> add_job(wire::JobView job) = 0;
  /// All but kind, map, tours and time. Errors: kNotFound.
  virtual Status update_job(const wire::JobView& job) = 0;
  virtual Result<std::vector<wire::JobView>> jobs() = 0;  // oldest first
  /// Queued or running, oldest first: what to take up again after a restart.
  virtual Result<std::vector<wire::JobView>> unfinished_jobs() = 0;
  /// Errors: kNotFound.
  virtual Result<wire::JobView> job(const JobId& id) = 0;

  // --- Robots and missions ----------------------------------------------------------------------------------------
  /// Errors: kConflict (the name is taken).
  virtual Result<RobotRecord> add_robot(RobotRecord robot) = 0;
  virtual Result<std::vector<RobotRecord>> robots() = 0;  // by name
  /// Errors: kNotFound.
  virtual Result<RobotRecord> robot(const RobotId& id) = 0;
  /// Nothing takes it off every map. Errors: kNotFound (robot or map).
  virtual Status set_robot_map(const RobotId& id, const std::optional<MapId>& map) = 0;
  /// Higher than ever before, also after a restart. Many are set apart on the disk at once, so that it goes on for a
  /// while where the disk is full. Errors: kNotFound.
  virtual Result<std::int64_t> next_epoch(const RobotId& id) = 0;
  /// With its missions and tokens. Errors: kNotFound.
  virtual Status remove_robot(const RobotId& id) = 0;
  /// Errors: kNotFound (the robot).
  virtual Result<wire::MissionView> add_mission(wire::MissionView mission) = 0;
  /// State, reason, epoch, seq, revision, path and path_index. Errors: kNotFound.
  virtual Status update_mission(const wire::MissionView& mission) = 0;
  /// The newest first, at most `limit`.
  virtual Result<std::vector<wire::MissionView>> missions(const RobotId& robot, int limit = 100) = 0;
  /// Errors: kNotFound.
  virtual Result<wire::MissionView> mission(const MissionId& id) = 0;

  /// What a plan said of pictures of the mission, besides what is kept of it; without particles, and of a picture that
  /// is known already the newest word. What is more than wire::kMaxMissionPlanPoses is left out. Errors: kNotFound.
  virtual Status add_plan_poses(const MissionId& mission, const std::vector<wire::PlanPoseView>& poses) = 0;
  /// In the order in which the pictures were taken; none of a mission that is not known.
  virtual Result<std::vector<wire::PlanPoseView>> plan_poses(const MissionId& mission) = 0;

  // --- Its condition ------------------------------------------------------------------------------------------------
  /// Files that came back are no longer missing; what is quarantined is of the start.
  virtual StoreCondition condition() = 0;

  // --- Repeated requests --------------------------------------------------------------------------------------------
  /// The answer given before to this caller, route and key, unless it is older than 24 h.
  virtual Result<std::optional<StoredAnswer>> answer(const RequestKey& key, TimeUs now_us) = 0;
  /// Success also when there is one already, which stays. Forgets answers older than 24 h.
  virtual Status keep_answer(const RequestKey& key, const StoredAnswer& answer, TimeUs now_us) = 0;
};

/// Opens or makes the database of a data folder, and brings an older one up to date. Missions that were under way are
/// kStopped with the reason kServerRestarted from then on. What lies among maps and pictures and no row names (an older
/// database was put in place, say) goes to the folder `quarantine`; nothing of it is removed.
/// Errors: kConflict (another process has the folder), kUnsupportedFormat (made by a newer version), kCorruptFile, kIo.
Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& data_directory);

}  // namespace homeward::db
