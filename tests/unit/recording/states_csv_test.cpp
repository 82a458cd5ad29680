// SPDX-License-Identifier: Apache-2.0
#include "recording/states_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording/survey_rows.hpp"
#include "support/sample_recording.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::recording::states_csv_test {
namespace {

using ::testing::HasSubstr;

class StatesCsv : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "exploration.hwrec"; }

  /// Two steps, 40 ms apart, with these rows before them.
  void record(std::vector<wire::StateRow> first, std::vector<wire::StateRow> second) const {
    auto writer = db::RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
    ASSERT_TRUE(writer) << writer.error().message;
    db::RecordedStep steps[] = {homeward::testing::sample_recorded_step(1), homeward::testing::sample_recorded_step(2)};
    steps[0].rows = std::move(first);
    steps[1].rows = std::move(second);
    ASSERT_TRUE((*writer)->append(steps));
    ASSERT_TRUE((*writer)->finish({true, "The mission ended."}));
  }

  homeward::testing::ScratchFolder folder_;
};

TEST_F(StatesCsv, HasOfASurveyWhatItFoundAndDecidedInOrder) {
  exploration::SurveyRow fresh;
  fresh.picture = 0;
  exploration::SurveyRow next;
  next.state = exploration::SurveyState::kNextPlace;
  next.picture = 0;
  next.floor_from_robot = {1.5, -0.25, 0.5};
  next.place_m = {3.5, 0.75};
  next.gain_m2 = 1.25;
  next.cost_m = 2.0;
  exploration::SurveyRow again;
  again.state = exploration::SurveyState::kKnownAgain;
  again.picture = 71;
  again.known = 12;
  again.agreement = 0.875;
  exploration::SurveyRow ended;
  ended.state = exploration::SurveyState::kEnded;
  ended.end = exploration::SurveyEnd::kBack;
  record(to_recorded({fresh, next}), to_recorded({again, ended}));
  const auto table = states_csv(file());
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(*table,
            "step,after_s,state,picture,x_m,y_m,theta_rad,known,agreement,place_x_m,place_y_m,gain_m2,cost_m,end\n"
            "1,0.000,new,0,0.000,0.000,0.0000,,,,,,,\n"
            "1,0.000,next_place,0,1.500,-0.250,0.5000,,,3.500,0.750,1.250,2.000,\n"
            "2,0.040,known_again,71,0.000,0.000,0.0000,12,0.875,,,,,\n"
            "2,0.040,ended,,0.000,0.000,0.0000,,,,,,,back\n");
}

TEST_F(StatesCsv, HasOfTheThesisItsNodesAndDirections) {
  record({wire::ThesisRow{wire::ThesisState::kExploration, {0, 1}, {}, 0.5, {}}},
         {wire::ThesisRow{wire::ThesisState::kHoming, {3, 1}, 271.613, -1.5, {0.25, 3.0}},
          wire::ThesisRow{wire::ThesisState::kPathPlanning, {1, 0, 2}, {}, {}, {}},
          wire::ThesisRow{wire::ThesisState::kDone, {}, {}, {}, {}}});
  const auto table = states_csv(file());
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(*table,
            "step,after_s,state,nodes,dissimilarity,direction_rad,left_rad\n"
            "1,0.000,exploration,0-1,,0.5000,\n"
            "2,0.040,exploration_homing,3-1,271.613,-1.5000,0.2500 3.0000\n"
            "2,0.040,path_planning,1-0-2,,,\n"
            "2,0.040,done,,,,\n");
}

TEST_F(StatesCsv, AMissionHasNone) {
  record({}, {});
  const auto table = states_csv(file());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::kEmptyInput);
  EXPECT_THAT(table.error().message, HasSubstr("no table of states"));
  EXPECT_THAT(table.error().where, HasSubstr("exploration.hwrec"));
}

TEST_F(StatesCsv, ThereIsNoneOfAFileThatIsNotThere) {
  const auto table = states_csv(file());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace homeward::recording::states_csv_test
