// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "contract/codecs.hpp"
#include "contract/schema_library.hpp"
#include "support/sample_map.hpp"
#include "support/sample_path.hpp"
#include "wire/build_json.hpp"
#include "wire/difference_json.hpp"
#include "wire/doubt_json.hpp"
#include "wire/edit_json.hpp"
#include "wire/error_table.hpp"
#include "wire/event_json.hpp"
#include "wire/graph_export.hpp"
#include "wire/graph_json.hpp"
#include "wire/inspect_json.hpp"
#include "wire/localised_json.hpp"
#include "wire/pair_json.hpp"
#include "wire/problem_json.hpp"
#include "wire/repeated_json.hpp"
#include "wire/replay_check_json.hpp"
#include "wire/route_json.hpp"
#include "wire/similarity_json.hpp"
#include "wire/state_row_json.hpp"
#include "wire/taught_json.hpp"
#include "wire/tour_json.hpp"
#include "wire/tracked_json.hpp"

namespace homeward::wire::encoders_test {
namespace {

using homeward::testing::sample_map;
using homeward::testing::schemas;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::vector<Eigen::Vector2d> kLayout = {{0.0, 0.25}, {1.0, 0.75}};

MissionView sample_mission() {
  MissionView mission;
  mission.id = MissionId("m1");
  mission.robot = RobotId("r1");
  mission.map = MapId("house");
  mission.revision = 4;
  mission.destination = DestinationId("d1");
  mission.place = PlaceId("p2");
  mission.path = {PlaceId("p1"), PlaceId("p2")};
  mission.arrival_probability = 0.97;
  mission.by = "anna";
  return mission;
}

RobotView sample_robot() {
  RobotView robot;
  robot.id = RobotId("r1");
  robot.name = "Chair";
  robot.online = true;
  robot.map = MapId("house");
  robot.state = DriveState::kDriving;
  robot.speed_mps = 0.5;
  robot.home = HomeReport{0.1, 0.9, 80};
  robot.belief = BeliefView{3, PlaceId("p1"), 0.8, {{PlaceId("p1"), 0.8}, {PlaceId("p2"), 0.1}}, false, 40.0, 12};
  robot.mission = sample_mission();
  robot.question = QuestionReport{3, PlaceId("p2"), "kitchen", 41.5};
  robot.lease = LeaseView{"secret", "anna", 3, 9000};
  robot.status_age_ms = 120;
  return robot;
}

TEST(Encoders, WriteMapsThatTheSchemasAccept) {
  const map::TopologicalMap map = sample_map();
  EXPECT_THAT(schemas().problems("inspect", inspect_to_json(map, 4096)), IsEmpty());
  EXPECT_THAT(schemas().problems("graph", graph_to_json(map, MapId("house"), kLayout)), IsEmpty());
  EXPECT_THAT(schemas().problems("graph", json::parse(export_graph(map, kLayout, ExportFormat::kJson))), IsEmpty());
}

TEST(Encoders, WriteTaughtPathsThatTheSchemaAccepts) {
  map::TopologicalMap map = sample_map();
  map.path = std::make_shared<const map::MapPath>(homeward::testing::sample_path());
  const json taught =
      taught_to_json("path.hwmap", map, {{ErrorCode::kTruncatedImage, "It ends too early.", "a/b.jpg"}});
  EXPECT_THAT(schemas().problems("taught", taught), IsEmpty());
  EXPECT_EQ(taught["arcs"][0]["from"], "00000.jpg");
  EXPECT_EQ(taught["arcs"][0]["scale"], json());
  EXPECT_NEAR(taught["arcs"][0]["bearing_rad"].get<double>(), std::atan2(1.0, 1.5), 1e-12);
  EXPECT_EQ(taught["arcs"][1]["bearing_rad"], json()) << "a turn on the spot";
  EXPECT_EQ(taught["cuts"][0], json::parse(R"({"after":"00002.jpg","on_from":null,"why":"geometry"})"));
  EXPECT_EQ(taught["bridged"], json::parse(R"([{"after":"00000.jpg","on_from":"00001.jpg","matched":37}])"));
  EXPECT_EQ(taught["closed_at"], json());
  map.path = std::make_shared<const map::MapPath>(homeward::testing::closed_sample_path());
  const json closed = taught_to_json("path.hwmap", map, {});
  EXPECT_THAT(schemas().problems("taught", closed), IsEmpty());
  EXPECT_EQ(closed["closed_at"], "00000.jpg");
  EXPECT_EQ(closed["arcs"].back()["from"], "00002.jpg");
  EXPECT_EQ(closed["arcs"].back()["to"], "00000.jpg");
}

TEST(Encoders, WriteTrackedPicturesThatTheSchemaAccepts) {
  TrackedView view;
  view.image = "031.jpg";
  view.pose = {1.5, -2.0, 0.3};
  view.particles = 500;
  view.may_be = {{view.pose, 0.9}, {{4.0, 2.0, -3.1}, 0.1}};
  EXPECT_THAT(schemas().problems("tracked", tracked_to_json(view)), IsEmpty());
  EXPECT_EQ(tracked_to_json(view)["x_m"], 1.5);
  for (const char* why : {"searching", "ambiguous", "not_in_plan"}) {
    view.lost = why;
    const json lost = tracked_to_json(view);
    EXPECT_THAT(schemas().problems("tracked", lost), IsEmpty()) << why;
    EXPECT_TRUE(lost["x_m"].is_null() && lost["theta_rad"].is_null()) << "what is not known is no pose";
  }
}

TEST(Encoders, WriteLocalisedPicturesThatTheSchemaAccepts) {
  LocalisedView view{"031.jpg", 4, {{PlaceId("p1"), 0.9}, {PlaceId("p2"), 0.05}}, 0.95, 0.97, false, 30.5, {}};
  EXPECT_THAT(schemas().problems("localised", localised_to_json(view)), IsEmpty());
  EXPECT_EQ(localised_to_json(view)["place"], "p1");
  EXPECT_FALSE(localised_to_json(view).contains("plan"));
  view.plan = PlanWitnessView{{1.5, -2.0, 0.3}, 0.05, "", "impossible", true};
  EXPECT_THAT(schemas().problems("localised", localised_to_json(view)), IsEmpty());
  EXPECT_EQ(localised_to_json(view)["plan"]["x_m"], 1.5);
  view.plan->lost = "searching";
  view.top.clear();
  const json lost = localised_to_json(view);
  EXPECT_THAT(schemas().problems("localised", lost), IsEmpty());
  EXPECT_TRUE(lost["plan"]["x_m"].is_null() && lost["place"].is_null()) << "what is not known is no pose";
}

TEST(Encoders, WriteRepeatedPicturesThatTheSchemaAccepts) {
  RepeatedView view{"031.jpg", 4,    "020.jpg", "040.jpg", 71,  90,   6,     0,  0.5,
                    -0.1,      0.03, 0.02,      0.4,       0.9, true, false, "", 6.5};
  EXPECT_THAT(schemas().problems("repeated", repeated_to_json(view)), IsEmpty());
  view.bearing_rad = std::nullopt;
  EXPECT_THAT(schemas().problems("repeated", repeated_to_json(view)), IsEmpty());
  view.lost = "features";
  const json lost = repeated_to_json(view);
  EXPECT_THAT(schemas().problems("repeated", lost), IsEmpty());
  EXPECT_TRUE(lost["steering_rad"].is_null()) << "what is not known steers nobody";
}

TEST(Encoders, WriteRoutesThatTheSchemasAccept) {
  const RouteView way{{PlaceId("p1"), PlaceId("p2")}, 4.5,  1.5,
                      map::LengthSource::kOdometry,   3.75, {{PlaceId("p1"), PlaceId("p2")}}};
  const RouteView other{
      {PlaceId("p1"), PlaceId("p3"), PlaceId("p2")}, 6.0, 6.0, map::LengthSource::kTourTime, 15.0, {}};
  const json routes = routes_to_json({way, other});
  EXPECT_THAT(schemas().problems("route", routes), IsEmpty());
  EXPECT_EQ(routes["others"][0], json::parse(R"({"places":["p1","p3","p2"],"cost_m":6.0,"length_m":6.0,
    "length_from":"tour_time","time_s":15.0,"weak":[],"shortcuts":[]})"));
  EXPECT_EQ(routes["weak"], json::parse(R"([{"from":"p1","to":"p2"}])"));
  const json none = no_route_to_json({PlaceId("p1"),
                                      PlaceId("p2"),
                                      true,
                                      1,
                                      {{map::ObstacleKind::kBlocked, PlaceId("p1"), PlaceId("p2")},
                                       {map::ObstacleKind::kAvoided, PlaceId(), PlaceId("p3")}}},
                                     sample_map());
  EXPECT_THAT(schemas().problems("no_route", none), IsEmpty());
  EXPECT_TRUE(none["obstacles"][1]["from"].is_null());
}

TEST(Encoders, TellWhatIsOtherInALaterStateOfAMap) {
  map::TopologicalMap after = sample_map();
  after.places[0].label = "porch";
  after.places.pop_back();
  after.edges.clear();
  after.destinations.clear();
  after.hypotheses[0].decision = map::Decision::kUndecided;
  const json value = difference_to_json(map::difference(sample_map(), after));
  EXPECT_THAT(schemas().problems("difference", value), IsEmpty());
  EXPECT_EQ(value["places"][0]["after"]["label"], "porch");
  EXPECT_EQ(value["places"][1]["change"], "removed");
  EXPECT_TRUE(value["places"][1]["after"].is_null());
  EXPECT_THAT(schemas().problems("difference", difference_to_json(map::difference(after, sample_map()))), IsEmpty());
}

TEST(Encoders, WriteRowsOfEveryStateThatTheSchemaAccepts) {
  for (const SurveyState state : {SurveyState::kNew, SurveyState::kKnownAgain, SurveyState::kTakenBack,
                                  SurveyState::kNextPlace, SurveyState::kReached, SurveyState::kBlocked,
                                  SurveyState::kTriesAgain, SurveyState::kGoesHome, SurveyState::kEnded}) {
    SurveyRow row;
    row.state = state;
    EXPECT_THAT(schemas().problems("state_row", state_row_to_json(row)), IsEmpty()) << state_name(row);
  }
  for (const SurveyEnd end : {SurveyEnd::kAllSeen, SurveyEnd::kBack, SurveyEnd::kStuck, SurveyEnd::kLimit}) {
    SurveyRow row;
    row.end = end;
    EXPECT_THAT(schemas().problems("state_row", state_row_to_json(row)), IsEmpty()) << survey_end_name(end);
  }
  for (const ThesisState state :
       {ThesisState::kExploration, ThesisState::kHoming, ThesisState::kPathPlanning, ThesisState::kDone}) {
    const ThesisRow row{state, {}, {}, {}, {}};
    EXPECT_THAT(schemas().problems("state_row", state_row_to_json(row)), IsEmpty()) << state_name(row);
  }
}

TEST(Encoders, TellOfDrafts) {
  DraftView draft;
  draft.id = DraftId("d1");
  draft.map = MapId("house");
  draft.by = "anna";
  draft.version = 3;
  draft.revision = 4;
  EXPECT_THAT(schemas().problems("draft", draft_to_json(draft)), IsEmpty());
  map::Edit edit;
  edit.image_a = ImageId("tour/00001.jpg");
  edit.change = 1;
  edit.lost = "There is no such picture.";
  draft.edits = {edit};
  draft.touches = {PlaceId("p1")};
  draft.overlaps = {{DraftId("d2"), "ben", "stairs", {PlaceId("p1")}}};
  draft.check = DraftCheck{JobId("j1"), 2};
  EXPECT_THAT(schemas().problems("draft", draft_to_json(draft)), IsEmpty());
  EXPECT_THAT(schemas().problems("logged_edit", logged_edit_to_json(edit)), IsEmpty());
  EXPECT_THAT(schemas().problems("event", event_to_json(draft, 5)), IsEmpty());
  EXPECT_THAT(schemas().problems("event", event_to_json(DraftGone{MapId("house"), DraftId("d1")}, 6)), IsEmpty());
}

TEST(Encoders, TellWhatAReplayCheckFoundInWordsToo) {
  const map::TopologicalMap map = sample_map();
  map::ReplayCheck check;
  check.pictures = 20;
  for (std::size_t kind = 0; kind < map::kWorsenings; ++kind) {
    const PlaceId other = kind < 3 ? PlaceId() : PlaceId("p2");
    check.worse.push_back({static_cast<map::Worsening>(kind), PlaceId("p1"), other, {ImageId("t/1.jpg")}, 4, 1, 2.5});
  }
  json value = replay_check_to_json(check, map, map);
  EXPECT_EQ(value["worse"][0]["words"], "At p1 it would not know where it is on 1 of 4 pictures.");
  EXPECT_FALSE(value["harmless"].get<bool>());
  const json of_draft = json::parse(R"({"format":"homeward-replay-check","version":1,"map":"house",
    "draft":"d1","draft_version":1,"revision":4})");
  for (const auto& [key, what] : of_draft.items()) {
    value[key] = what;
  }
  EXPECT_THAT(schemas().problems("replay_check", value), IsEmpty());
}

TEST(Encoders, SimilarityMatricesFitTheirSchema) {
  EXPECT_THAT(schemas().problems("similarity", similarity_to_json(1, 256, 1, {})), IsEmpty());
  EXPECT_THAT(schemas().problems("similarity", similarity_to_json(3, 256, 8, {ImageId("t/1.jpg"), ImageId("t/2.jpg")})),
              IsEmpty());
}

TEST(Encoders, TellWhatTwoPicturesHaveInCommon) {
  map::PicturePair pair;
  pair.image_a = ImageId("t/1.jpg");
  pair.image_b = ImageId("t/2.jpg");
  EXPECT_THAT(schemas().problems("pair", pair_to_json(pair)), IsEmpty());
  pair.distance = 0.5;
  pair.turn_rad = -3.14;
  pair.shift = -0.5;
  pair.matches = {{{0.0, 1.0}, {1.0, 0.0}, 0.3, true}};
  EXPECT_THAT(schemas().problems("pair", pair_to_json(pair)), IsEmpty());
}

std::vector<map::Doubt> sample_doubts() {
  map::Doubt same;
  same.image_a = ImageId("tour/00000.jpg");
  same.image_b = ImageId("tour/00002.jpg");
  same.place_a = PlaceId("p1");
  same.place_b = PlaceId("p2");
  same.probability = 0.5;
  same.effect = 0.5;
  same.hypothesis = 0;
  same.neighbours = {{PlaceId("p1"), PlaceId("p2"), true, 0.75}};
  map::Edit edit;
  edit.kind = map::EditKind::kMerge;
  edit.image_a = same.image_a;
  edit.image_b = same.image_b;
  same.if_yes = {edit};
  edit.kind = map::EditKind::kDecide;
  edit.text = "reject";
  same.if_no = {edit};
  map::Doubt mixed = same;
  mixed.kind = map::DoubtKind::kMixedPlace;
  mixed.state = map::Decision::kAccepted;
  mixed.place_b = mixed.place_a;
  mixed.hypothesis.reset();
  edit.kind = map::EditKind::kSplit;
  edit.images = {same.image_b};
  mixed.if_no = {edit};
  mixed.if_yes = {};
  map::Doubt way = mixed;
  way.kind = map::DoubtKind::kWay;
  way.by = map::Decider::kPerson;
  way.place_b = same.place_b;
  edit.kind = map::EditKind::kBlockEdge;
  edit.text = "false";
  edit.images = {};
  std::swap(edit.image_a, edit.image_b);
  way.if_yes = {edit};
  edit.kind = map::EditKind::kRemoveEdge;
  way.if_no = {edit};
  return {same, mixed, way};
}

TEST(Encoders, WriteDoubtsThatTheSchemaAccepts) {
  const json all = doubts_to_json(sample_doubts(), sample_map(), "m1", {DoubtsAbout::kAll, {}, {}, 0, 20});
  EXPECT_THAT(schemas().problems("doubts", all), IsEmpty());
  EXPECT_EQ(all["total"], 3);
  EXPECT_EQ(all["revision"], 4);
  EXPECT_EQ(all["doubts"][0]["if_yes"], json::parse(R"([{"kind":"merge","place":"p2","into":"p1"}])"));
  EXPECT_EQ(all["doubts"][0]["masses_after"], json::parse(R"({"true":0.1,"false":0.8,"unknown":0.1})"));
  EXPECT_EQ(all["doubts"][1]["if_no"], json::parse(R"([{"kind":"split","place":"p1","images":["tour/00002.jpg"]}])"));
  EXPECT_TRUE(all["doubts"][1]["support"].is_null());
  EXPECT_EQ(all["doubts"][2]["if_yes"],
            json::parse(R"([{"kind":"block_edge","from":"p2","to":"p1","blocked":false}])"));
  for (const json& doubt : all["doubts"]) {
    for (const char* answer : {"if_yes", "if_no"}) {
      EXPECT_TRUE(doubt[answer].empty() || edits_from_json({{"edits", doubt[answer]}})) << doubt[answer];
    }
  }
}

TEST(Encoders, WriteThoseDoubtsThatAreAskedFor) {
  const auto count = [](const DoubtFilter& filter) {
    const json page = doubts_to_json(sample_doubts(), sample_map(), "m1", filter);
    EXPECT_THAT(schemas().problems("doubts", page), IsEmpty());
    return std::pair(page["total"].get<int>(), page["doubts"].size());
  };
  EXPECT_EQ(count({}), std::pair(2, std::size_t{2}));
  EXPECT_EQ(count({DoubtsAbout::kUndecided, {}, {}, 0, 20}), std::pair(1, std::size_t{1}));
  EXPECT_EQ(count({DoubtsAbout::kClose, {}, {}, 0, 20}), std::pair(1, std::size_t{1}));
  EXPECT_EQ(count({DoubtsAbout::kDecided, {}, {}, 0, 20}), std::pair(1, std::size_t{1}));
  EXPECT_EQ(count({DoubtsAbout::kAll, map::DoubtKind::kWay, {}, 0, 20}), std::pair(1, std::size_t{1}));
  EXPECT_EQ(count({DoubtsAbout::kAll, {}, PlaceId("p2"), 0, 20}), std::pair(2, std::size_t{2}));
  EXPECT_EQ(count({DoubtsAbout::kAll, {}, {}, 2, 20}), std::pair(3, std::size_t{1}));
  EXPECT_EQ(count({DoubtsAbout::kAll, {}, {}, 5, 20}), std::pair(3, std::size_t{0}));
  EXPECT_EQ(count({DoubtsAbout::kAll, {}, {}, 0, 1}), std::pair(3, std::size_t{1}));
}

TEST(Encoders, TellEverythingOfAMap) {
  map::TopologicalMap map = sample_map();
  features::Appearance dark = map.places[1].appearances.front();
  dark.colour_moments = {0.06F, 0.0F, 0.0F, 0.05F, 0.0F, 0.0F, 0.04F, 0.0F, 0.0F};
  map.places[1].appearances.push_back(dark, ImageId("evening/00007.jpg"));
  dark.colour_moments.fill(std::numeric_limits<float>::quiet_NaN());
  map.places[1].appearances.push_back(dark);
  const json graph = graph_to_json(map, MapId("house"), kLayout);
  EXPECT_THAT(schemas().problems("graph", graph), IsEmpty());
  EXPECT_EQ(graph["revision"], 4);
  EXPECT_EQ(graph["places"][1],
            json::parse(R"({"id":"p2","label":"kitchen","name":"kitchen","prototype":"tour/00002.jpg",
    "members":["tour/00002.jpg"],"features":20,"brightness":0.0,
    "learnt":[{"image":"evening/00007.jpg","brightness":0.05},{"image":null,"brightness":0.0}],"x":1.0,"y":0.75})"));
  EXPECT_EQ(graph["edges"][1], json::parse(R"({"from":"p2","to":"p1","bearing_rad":null,"turn_rad":null,"length_m":1.5,
    "length_from":"unknown","confidence":0.1,"inliers":0,"weak":true,"blocked":true,"shortcut":false,"by":"person"})"));
  EXPECT_EQ(graph["destinations"][0],
            json::parse(R"({"id":"d1","place":"p2","image":"tour/00002.jpg","label":"kitchen","pictogram":""})"));
  EXPECT_EQ(graph["hypotheses"][0]["masses_after"], json::parse(R"({"true":0.1,"false":0.8,"unknown":0.1})"));
  const json inspect = inspect_to_json(sample_map(), 4096);
  EXPECT_EQ(inspect["images"], 3);
  EXPECT_EQ(inspect["bytes"], 4096);
  EXPECT_EQ(inspect["build_seconds"], 1.25);
}

TEST(Encoders, WriteEventsThatTheSchemaAccepts) {
  JobView job{JobId("j1"),
              JobKind::kBuild,
              MapId("house"),
              JobState::kFailed,
              "features",
              0.5,
              {},
              12,
              2,
              {in_words("2 of 40 pictures.")}};
  job.error = Error{ErrorCode::kTooFewFeatures, "The pictures are black.", "t1"};
  const MapInfoView map{MapId("house"), "House", MapState::kBuilding, 0, 0, 3, {TourId("t1")}, {}};
  RobotView unseen;
  unseen.id = RobotId("r2");
  const Snapshot snapshot{"0.1.0", {sample_robot(), unseen}, {job}, {map}};
  for (const Event& event : std::vector<Event>{snapshot, sample_robot(), job, map, sample_mission(), Heartbeat{}}) {
    const json written = event_to_json(event, 7);
    EXPECT_THAT(schemas().problems("event", written), IsEmpty()) << written.dump();
    EXPECT_EQ(written["seq"], 7);
  }
}

TEST(Encoders, NameEveryStateAsTheSchemasDo) {
  MissionView mission = sample_mission();
  for (int state = 0; state <= static_cast<int>(MissionState::kFailed); ++state) {
    mission.state = static_cast<MissionState>(state);
    EXPECT_THAT(schemas().problems("mission", mission_to_json(mission)), IsEmpty());
    EXPECT_EQ(mission_state(mission_state_name(mission.state)), mission.state);
  }
  JobView job{JobId("j1"), JobKind::kBuild, MapId("house"), JobState::kQueued, "", 0.0, {}, 12, 0, {}};
  for (int state = 0; state <= static_cast<int>(JobState::kCancelled); ++state) {
    job.state = static_cast<JobState>(state);
    EXPECT_THAT(schemas().problems("job", job_to_json(job)), IsEmpty());
    EXPECT_EQ(job_state(job_state_name(job.state)), job.state);
  }
  for (const JobKind kind : {JobKind::kBuild, JobKind::kAdd, JobKind::kRefine}) {
    job.kind = kind;
    EXPECT_THAT(schemas().problems("job", job_to_json(job)), IsEmpty());
  }
  MapInfoView map{MapId("house"), "House", MapState::kReady, 1, 2, 3, {TourId("t1")}, "hw2"};
  for (int mode = 0; mode <= static_cast<int>(RefineMode::kAuto); ++mode) {
    map.refine = static_cast<RefineMode>(mode);
    EXPECT_THAT(schemas().problems("map_info", map_info_to_json(map)), IsEmpty());
    EXPECT_EQ(refine_mode(refine_mode_name(map.refine)), map.refine);
  }
  EXPECT_FALSE(refine_mode("always"));
  RobotView robot = sample_robot();
  for (int state = 0; state <= static_cast<int>(DriveState::kFailed); ++state) {
    robot.state = static_cast<DriveState>(state);
    EXPECT_THAT(schemas().problems("robot", robot_to_json(robot)), IsEmpty());
  }
  for (const ErrorRow& row : error_table()) {
    EXPECT_THAT(schemas().problems("problem", problem_to_json(Error{row.code, "Why.", "here"})), IsEmpty());
  }
}

TEST(Encoders, TellWhatABuildMade) {
  BuildView build{"house.map", {}, {}, {}};
  EXPECT_THAT(schemas().problems("build", build_to_json(build, sample_map())), IsEmpty());
  build = {"house.map",
           "report/report.html",
           {{ErrorCode::kTruncatedImage, "The JPEG ends before its last row.", "tour/00003.jpg"}},
           {{map::TourWarning::Kind::kPictureOlder, ImageId("tour/00012.jpg")}}};
  const json written = build_to_json(build, sample_map());
  EXPECT_THAT(schemas().problems("build", written), IsEmpty());
  EXPECT_EQ(written["images"], 3);
  EXPECT_EQ(written["skipped"][0]["code"], "truncated_image");
  EXPECT_EQ(written["warnings"][0]["image"], "tour/00012.jpg");
  EXPECT_EQ(written["warnings"][0]["reason"]["code"], "picture_older");
}

TEST(Encoders, KeepTheSecretOfALeaseToItsHolder) {
  EXPECT_FALSE(robot_to_json(sample_robot())["lease"].contains("id"));
  const json own = lease_to_json(*sample_robot().lease);
  EXPECT_EQ(own["id"], "secret");
  EXPECT_THAT(schemas().problems("lease", own), IsEmpty());
}

TEST(Encoders, WriteNullForWhatIsNoNumber) {
  BeliefView belief;
  belief.probability = kNan;
  belief.ms = std::numeric_limits<double>::infinity();
  const json written = belief_to_json(belief);
  EXPECT_TRUE(written["probability"].is_null());
  EXPECT_TRUE(written["ms"].is_null());
  EXPECT_THAT(schemas().problems("belief", written), IsEmpty());

  map::TopologicalMap map = sample_map();
  map.edges[0].bearing_rad = kNan;
  EXPECT_TRUE(graph_to_json(map, MapId("house"), kLayout)["edges"][0]["bearing_rad"].is_null());
}

TEST(Encoders, WriteToursThatTheSchemaAccepts) {
  const TourView tour{TourId("t1"), "First", true, 3, sample_map().camera, 12, {1}};
  EXPECT_THAT(schemas().problems("tour_info", tour_info_to_json(tour)), IsEmpty());
  EXPECT_EQ(tour_info_to_json(tour)["state"], "complete");
}

TEST(GraphExport, WritesGraphMlWithEscapedText) {
  map::TopologicalMap map = sample_map();
  map.places[1].label = "Anna & <Otto>\x01";
  const std::string text = export_graph(map, kLayout, ExportFormat::kGraphMl);
  EXPECT_THAT(text, HasSubstr("<data key=\"label\">Anna &amp; &lt;Otto&gt;</data>"));
  EXPECT_THAT(text, HasSubstr("<edge source=\"p1\" target=\"p2\">"));
  EXPECT_THAT(text, HasSubstr("<data key=\"bearing_rad\">0.5</data>"));
}

TEST(GraphExport, WritesGeoJsonWithYUpwards) {
  const json value = json::parse(export_graph(sample_map(), kLayout, ExportFormat::kGeoJson));
  EXPECT_EQ(value["features"].size(), 4U);
  EXPECT_EQ(value["features"][1]["geometry"]["coordinates"], json::parse("[1.0, 0.25]"));
  EXPECT_EQ(value["features"][2]["geometry"]["type"], "LineString");
}

TEST(GraphExport, KnowsThreeFormats) {
  EXPECT_EQ(export_format("graphml"), ExportFormat::kGraphMl);
  EXPECT_FALSE(export_format("dot"));
}

TEST(RevisionTag, IsReadBackWithAndWithoutQuotes) {
  EXPECT_EQ(revision_from_tag(revision_tag(12)).value(), 12);
  EXPECT_EQ(revision_from_tag("r3").value(), 3);
  EXPECT_EQ(revision_from_tag("W/\"r4\"").value(), 4) << "as of an answer that was compressed";
  for (const char* wrong : {"", "r", "3", "\"r3", "r3x", "r-1", "W/", "W/\"r3", "*"}) {
    EXPECT_EQ(revision_from_tag(wrong).error().code, ErrorCode::kInvalidInput) << wrong;
  }
}

}  // namespace
}  // namespace homeward::wire::encoders_test
