// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "db/secrets.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_people_test {
namespace {

class StorePeople : public StoreTest {};

TEST_F(StorePeople, ArePresentAfterReopening) {
  const auto added = store().add_user(person("Anna", wire::Role::kCarer));
  ASSERT_TRUE(added);
  open();
  const auto found = store().user_by_name("anna");
  ASSERT_TRUE(found && *found);
  EXPECT_EQ((*found)->id, added->id);
  EXPECT_EQ((*found)->role, wire::Role::kCarer);
  EXPECT_EQ((*found)->password_hash, "argon of Anna");
  EXPECT_EQ(store().user(added->id)->value().name, "Anna");
  EXPECT_FALSE(store().user_by_name("Berta")->has_value());
}

TEST_F(StorePeople, HaveNamesOfTheirOwn) {
  ASSERT_TRUE(store().add_user(person("Anna", wire::Role::kCarer)));
  const auto again = store().add_user(person("ANNA", wire::Role::kViewer));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kConflict);
  EXPECT_EQ(store().users()->size(), 1U);
}

TEST_F(StorePeople, KeepAnAdmin) {
  const User admin = *store().add_user(person("Anna", wire::Role::kAdmin));
  EXPECT_EQ(store().remove_user(admin.id).error().code, ErrorCode::kConflict);
  EXPECT_EQ(store().set_role(admin.id, wire::Role::kViewer).error().code, ErrorCode::kConflict);
  EXPECT_EQ(store().user(admin.id)->value().role, wire::Role::kAdmin);
  ASSERT_TRUE(store().add_user(person("Berta", wire::Role::kAdmin)));
  EXPECT_TRUE(store().remove_user(admin.id));
  EXPECT_EQ(store().remove_user(admin.id).error().code, ErrorCode::kNotFound);
}

TEST_F(StorePeople, SessionsEndByTimeByHandAndWithANewPassword) {
  const User user = *store().add_user(person("Anna", wire::Role::kRider));
  const auto sign_in = [&](const std::string& hash) { return store().add_session({hash, user.id, 10, 100}); };
  ASSERT_TRUE(sign_in("a"));
  const auto sessions = store().sessions();
  ASSERT_EQ(sessions->size(), 1U);
  EXPECT_EQ(sessions->front().hash, "a");
  EXPECT_EQ(sessions->front().user, user.id);
  EXPECT_EQ(sessions->front().created_us, 10);
  EXPECT_EQ(sessions->front().expires_us, 100);
  ASSERT_TRUE(store().remove_session("a"));
  EXPECT_TRUE(store().sessions()->empty());
  ASSERT_TRUE(sign_in("b"));
  ASSERT_TRUE(store().set_password_hash(user.id, "new"));
  EXPECT_TRUE(store().sessions()->empty());
  ASSERT_TRUE(sign_in("c"));
  ASSERT_TRUE(store().add_session({"d", user.id, 100, 200}));
  ASSERT_EQ(store().sessions()->size(), 1U) << "what has ended goes when somebody signs in";
  EXPECT_EQ(store().sessions()->front().hash, "d");
  EXPECT_EQ(store().add_session({"e", UserId("nobody"), 1, 2}).error().code, ErrorCode::kNotFound);
}

TEST_F(StorePeople, TokensAreRevokedAndGoWithTheirRobot) {
  RobotRecord robot;
  robot.name = "chair";
  robot = *store().add_robot(robot);
  Token token;
  token.name = "chair's own";
  token.hash = secret_hash("secret");
  token.robot = robot.id;
  token = *store().add_token(token);
  ASSERT_FALSE(token.id.empty());
  const Token found = store().tokens()->front();
  EXPECT_EQ(found.hash, secret_hash("secret"));
  EXPECT_EQ(found.robot, robot.id);
  EXPECT_EQ(found.role, wire::Role::kRobot);
  Token second;
  second.hash = "other";
  second.role = wire::Role::kInstaller;
  second.expires_us = 10;
  second = *store().add_token(second);
  ASSERT_EQ(store().tokens()->size(), 2U);
  EXPECT_EQ(store().tokens()->back().expires_us, 10);
  ASSERT_TRUE(store().revoke_token(second.id));
  ASSERT_EQ(store().tokens()->size(), 1U);
  EXPECT_EQ(store().tokens()->front().id, token.id);
  EXPECT_EQ(store().revoke_token(second.id).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store().remove_robot(robot.id));
  EXPECT_TRUE(store().tokens()->empty());
}

TEST_F(StorePeople, TheSetUpSecretWorksOnce) {
  ASSERT_TRUE(store().set_setup_hash("right"));
  EXPECT_EQ(store().finish_setup("wrong", person("Eve", wire::Role::kAdmin)).error().code, ErrorCode::kForbidden);
  const auto admin = store().finish_setup("right", person("Anna", wire::Role::kViewer));
  ASSERT_TRUE(admin);
  EXPECT_EQ(admin->role, wire::Role::kAdmin);
  EXPECT_FALSE(store().setup_hash()->has_value());
  EXPECT_EQ(store().finish_setup("right", person("Eve", wire::Role::kAdmin)).error().code, ErrorCode::kForbidden);
  EXPECT_EQ(store().users()->size(), 1U);
}

TEST(Secrets, AreRandomUrlSafeAndHashedAsBlake2b) {
  EXPECT_EQ(random_id().size(), 22U);
  EXPECT_EQ(random_secret().size(), 43U);
  EXPECT_NE(random_secret(), random_secret());
  EXPECT_THAT(random_secret(), ::testing::MatchesRegex("[A-Za-z0-9_-]+"));
  // BLAKE2b-256 of "" and SHA-256 of "abc" (FIPS 180-2, appendix B.1).
  EXPECT_EQ(secret_hash(""), "0e5751c026e543b2e8ab2eb06099daa1d1e5df47778f7787faab45cdf12fe3a8");
  const std::array<std::uint8_t, 3> abc = {'a', 'b', 'c'};
  EXPECT_EQ(sha256_hex(abc), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace homeward::db::store_people_test
