// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include <zlib.h>

#include "server/front/compressed_answers.hpp"
#include "server/http/access.hpp"
#include "server/http/router.hpp"
#include "support/server_fixture.hpp"

namespace homeward::server::front_test {
namespace {

TEST(Router, FindsByMethodAndPathAndDecodesParameters) {
  Router router;
  constexpr AllowedRoles kAnyone = AllowedRoles::anyone();
  router.add({{"get_map", "GET", "/maps/{map}", kAnyone}, {}});
  router.add({{"remove_map", "DELETE", "/maps/{map}", kAnyone}, {}});
  router.add({{"import_map", "GET", "/maps/import", kAnyone, Lane::kWork, 1}, {}});
  EXPECT_EQ(router.find("GET", "/maps/a%20b").parameters.at("map"), "a b");
  EXPECT_EQ(router.find("HEAD", "/maps/a").route->operation.method, "GET");
  EXPECT_EQ(router.find("GET", "/maps/import").route->operation.max_body, 1U) << "a path spelled out beats a parameter";
  EXPECT_EQ(router.find("PUT", "/maps/a").route, nullptr);
  EXPECT_EQ(router.find("PUT", "/maps/a").allowed, "DELETE, GET, HEAD, OPTIONS");
  EXPECT_EQ(router.find("GET", "/maps/").route, nullptr) << "an empty parameter is none";
  EXPECT_EQ(router.find("GET", "/maps/a/b").allowed, "");
  EXPECT_EQ(router.find("GET", "/maps/a%00").route, nullptr);
}

TEST(Access, AnswersToItsOwnNamesAlone) {
  const AccessPolicy access({"Home.Local"});
  EXPECT_TRUE(access.host_allowed("localhost:8080"));
  EXPECT_TRUE(access.host_allowed("[::1]:8080"));
  EXPECT_TRUE(access.host_allowed("home.local"));
  EXPECT_FALSE(access.host_allowed("evil.example"));
  EXPECT_FALSE(access.host_allowed("localhost.evil.example"));
  EXPECT_FALSE(access.host_allowed(""));
  EXPECT_FALSE(access.host_allowed("localhost:80@evil.example")) << "that names evil.example";
  EXPECT_FALSE(access.host_allowed("evil@localhost"));
  EXPECT_FALSE(access.host_allowed("[::1]evil.example"));
  EXPECT_FALSE(access.host_allowed("localhost:8080 "));
  EXPECT_TRUE(access.origin_allowed("http://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(access.origin_allowed("http://localhost:9999", "localhost:8080")) << "another port is another site";
  EXPECT_FALSE(access.origin_allowed("null", "localhost:8080"));
  EXPECT_FALSE(access.origin_allowed("http://evil.example", "evil.example"));
}

TEST(Access, BelievesNobodyButItsProxiesForWhomTheyAsk) {
  const AccessPolicy access({}, {"10.0.0.9"});
  const auto sender = [&](const std::string& remote, const std::string& forwarded) {
    Request request;
    request.remote = remote;
    if (!forwarded.empty()) request.headers["x-forwarded-for"] = forwarded;
    return access.sender_of(request);
  };
  EXPECT_EQ(sender("10.0.0.9", "1.2.3.4"), "1.2.3.4");
  EXPECT_EQ(sender("10.0.0.9", "9.9.9.9, 2001:db8::1"), "2001:db8::1")
      << "what a client has written itself comes first";
  EXPECT_EQ(sender("10.0.0.8", "1.2.3.4"), "10.0.0.8");
  EXPECT_EQ(sender("10.0.0.9", ""), "10.0.0.9");
  EXPECT_EQ(sender("10.0.0.9", "<script>"), "10.0.0.9");
  EXPECT_EQ(sender("10.0.0.9", "1.2.3.4.5"), "10.0.0.9");
}

TEST(AllowedRoles, EachRoleIncludesThoseBeforeIt) {
  using wire::Role;
  const AllowedRoles installer = AllowedRoles::at_least(Role::kInstaller);
  EXPECT_TRUE(installer.allow(Role::kAdmin));
  EXPECT_FALSE(installer.allow(Role::kCarer));
  EXPECT_FALSE(installer.allow(Role::kRobot));
  EXPECT_FALSE(installer.includes_anyone());
  const AllowedRoles teacher = AllowedRoles::at_least_or_robot(Role::kInstaller);
  EXPECT_TRUE(teacher.allow(Role::kRobot));
  EXPECT_TRUE(teacher.allow(Role::kAdmin));
  EXPECT_FALSE(teacher.allow(Role::kCarer));
  EXPECT_FALSE(AllowedRoles::at_least(Role::kViewer).allow(Role::kRobot));
  EXPECT_FALSE(AllowedRoles::at_least(Role::kRobot).allow(Role::kAdmin));
  EXPECT_TRUE(AllowedRoles::at_least(Role::kRobot).allow(Role::kRobot));
}

TEST(AllowedRoles, AreWrittenAsInTheContract) {
  using wire::Role;
  EXPECT_EQ(AllowedRoles::anyone().text(), "anyone");
  EXPECT_EQ(AllowedRoles::at_least(Role::kRider).text(), "rider");
  EXPECT_EQ(AllowedRoles::at_least_or_robot(Role::kInstaller).text(), "installer, robot");
}

TEST(Message, BrokenEscapesAreRefused) {
  EXPECT_EQ(percent_decoded("a%2Fb").value_or(""), "a/b");
  EXPECT_FALSE(percent_decoded("%2").has_value());
  EXPECT_FALSE(percent_decoded("%zz").has_value());
  EXPECT_FALSE(percent_decoded("%00").has_value());
  EXPECT_EQ(parse_query("from=p1&to=p%202&x")->at("to"), "p 2");
  EXPECT_EQ(cookie_value("a=1; homeward_session=x; b=2", "homeward_session"), "x");
  EXPECT_EQ(cookie_value("xhomeward_session=x", "homeward_session"), "");
}

TEST(Config, PlainHttpForOthersHasToBeAskedFor) {
  AppConfig config;
  config.data = "data";
  EXPECT_TRUE(problems(config).empty());
  config.address = "0.0.0.0";
  EXPECT_EQ(problems(config).size(), 1U);
  config.allow_plain_http = true;
  EXPECT_TRUE(problems(config).empty());
  config.trusted_proxies = {"127.0.0.1", "::1"};
  EXPECT_TRUE(problems(config).empty());
  config.trusted_proxies.insert("proxy.local");
  EXPECT_EQ(problems(config).size(), 1U) << "what is never met would be believed in vain";
}

class FrontTest : public testing::ServerTest {};

TEST_F(FrontTest, ForeignHostsAndOriginsAreRefused) {
  EXPECT_EQ(admin->get("/api/v1/maps", {{"Host", "evil.example"}}).status, 403);
  EXPECT_EQ(admin->post("/api/v1/robots", {{"name", "r"}}, {{"Origin", "http://evil.example"}}).status, 403);
  admin->defaults.clear();
  EXPECT_EQ(admin->post("/api/v1/robots", {{"name", "r"}}).status, 403) << "a cookie needs an origin";
  EXPECT_EQ(admin->get("/api/v1/robots").status, 200);
  EXPECT_TRUE(admin->get("/api/v1/robots").json().at("robots").empty());
}

TEST_F(FrontTest, SpeaksProperHttp) {
  const testing::Answer head = admin->send("HEAD", "/api/v1/maps");
  EXPECT_EQ(head.status, 200);
  EXPECT_TRUE(head.body.empty());
  EXPECT_EQ(admin->send("OPTIONS", "/api/v1/maps").headers["allow"], "GET, HEAD, OPTIONS, POST");
  EXPECT_EQ(admin->send("PATCH", "/api/v1/maps").status, 405);
  EXPECT_EQ(admin->get("/api/v1/nothing").status, 404);
  EXPECT_EQ(admin->get("/api/v1/events").status, 426);
  EXPECT_EQ(admin->post("/api/v1/nothing", {{"a", 1}}).status, 404);
  EXPECT_EQ(admin->post("/index.html", {{"a", 1}}).status, 405);
  EXPECT_EQ(admin->send("POST", "/api/v1/robots", "{broken").status, 400);
  EXPECT_EQ(admin->post("/api/v1/robots", {{"name", "r"}, {"extra", 1}}).status, 422);
  EXPECT_EQ(admin->send("POST", "/api/v1/robots", std::string(2'000'000, 'x')).status, 413);
  EXPECT_EQ(admin->get("/api/v1/maps", {{"X-Long", std::string(20'000, 'x')}}).status, 431);
  const testing::Answer health = admin->get("/healthz");
  EXPECT_EQ(health.status, 200);
  EXPECT_EQ(health.headers.at("x-content-type-options"), "nosniff");
  EXPECT_NE(health.headers.at("content-security-policy").find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_EQ(admin->get("/readyz").status, 200);
  EXPECT_NE(admin->get("/metrics").body.find("homeward_http_requests_total"), std::string::npos);
  EXPECT_NE(admin->get("/api/docs").body.find("openapi: 3.1"), std::string::npos);
}

TEST(EntityTags, AreFoundInListsWeakOrNot) {
  EXPECT_TRUE(names_tag("\"a\"", "\"a\""));
  EXPECT_TRUE(names_tag("W/\"a\"", "\"a\""));
  EXPECT_TRUE(names_tag(" \"x,y\" , W/\"b\",\t\"a\"", "\"a\""));
  EXPECT_TRUE(names_tag("*", "\"a\""));
  EXPECT_FALSE(names_tag("", "\"a\""));
  EXPECT_FALSE(names_tag("\"b\", \"c\"", "\"a\""));
  EXPECT_FALSE(names_tag("a", "\"a\""));
  EXPECT_FALSE(names_tag("\"a", "\"a\""));
  EXPECT_FALSE(names_tag("\"b\" \"a", "\"a\""));
}

TEST(Compression, IsForWhoTakesIt) {
  EXPECT_TRUE(accepts_gzip("gzip"));
  EXPECT_TRUE(accepts_gzip("deflate, gzip;q=0.5, br"));
  EXPECT_FALSE(accepts_gzip("gzip;q=0"));
  EXPECT_FALSE(accepts_gzip("gzip;q=0.000"));
  EXPECT_FALSE(accepts_gzip("br, x-gzip"));
  EXPECT_FALSE(accepts_gzip(""));
}

TEST(Compression, ComesBackAsItWas) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "place p" + std::to_string(i) + ", ";
  const std::string bytes = gzip(text);
  EXPECT_LT(bytes.size(), text.size() / 3);
  std::string back(text.size() + 1, '\0');
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(back.data());
  stream.avail_out = static_cast<uInt>(back.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  back.resize(stream.total_out);
  inflateEnd(&stream);
  EXPECT_EQ(back, text);
}

TEST_F(FrontTest, LongTextIsCompressedForWhoTakesIt) {
  const std::filesystem::path web = config.data / "web";
  std::filesystem::create_directories(web);
  std::ofstream(web / "index.html") << std::string(5000, 'a');
  config.web = web;
  restart();
  const testing::Headers takes = {{"Accept-Encoding", "gzip, br"}};
  for (int i = 0; i < 2; ++i) {
    testing::Answer page = admin->get("/", takes);
    EXPECT_EQ(page.headers["content-encoding"], "gzip");
    EXPECT_LT(page.body.size(), 200U);
    EXPECT_EQ(page.headers["etag"].substr(0, 3), "W/\"");
    EXPECT_EQ(admin->get("/", {{"If-None-Match", page.headers["etag"]}}).status, 304);
  }
  testing::Answer plain = admin->get("/");
  EXPECT_FALSE(plain.headers.contains("content-encoding"));
  EXPECT_EQ(plain.headers["vary"], "accept-encoding");
  EXPECT_EQ(plain.body.size(), 5000U);
  testing::Answer shorter = admin->get("/api/v1/maps", takes);
  EXPECT_FALSE(shorter.headers.contains("content-encoding"));
}

TEST_F(FrontTest, AKeyBelongsToOneRequest) {
  const testing::Headers key = {{"Idempotency-Key", "k1"}};
  const testing::Answer first = admin->post(
      "/api/v1/tours", {{"name", "a"}, {"camera", wire::camera_to_json(testing::small_panorama_camera())}}, key);
  ASSERT_EQ(first.status, 201) << first.body;
  const testing::Answer again = admin->post(
      "/api/v1/tours", {{"name", "a"}, {"camera", wire::camera_to_json(testing::small_panorama_camera())}}, key);
  EXPECT_EQ(again.body, first.body);
  const testing::Answer other = admin->post(
      "/api/v1/tours", {{"name", "b"}, {"camera", wire::camera_to_json(testing::small_panorama_camera())}}, key);
  EXPECT_EQ(other.status, 422) << other.body;
  EXPECT_EQ(other.json().at("where"), "Idempotency-Key");
}

TEST_F(FrontTest, SaysThatItIsNotReadyWithoutWhatItWasGiven) {
  const std::string tour = add_tour();
  ASSERT_EQ(put_image(tour, 0, testing::room_picture(1, 1)), 201);
  app.reset();
  const std::filesystem::path picture = config.data / "tours" / tour / "0.jpg";
  std::filesystem::rename(picture, config.data / "picture");
  start();
  testing::HttpClient stranger(app->port());
  const testing::Answer not_ready = stranger.get("/readyz");
  EXPECT_EQ(not_ready.status, 503);
  EXPECT_NE(not_ready.body.find("1 file"), std::string::npos) << not_ready.body;
  EXPECT_EQ(not_ready.body.find(tour), std::string::npos) << "anybody may ask";
  std::filesystem::rename(config.data / "picture", picture);
  EXPECT_EQ(stranger.get("/readyz").status, 200);
}

TEST_F(FrontTest, ServesTheDashboardAndNothingBesideIt) {
  const std::filesystem::path web = config.data / "web";
  std::filesystem::create_directories(web / "assets");
  std::ofstream(web / "index.html") << "<p>home</p>";
  std::ofstream(web / "assets" / "a.js") << "1";
  std::ofstream(config.data / "secret.txt") << "secret";
  config.web = web;
  restart();
  const testing::Answer page = admin->get("/");
  EXPECT_EQ(page.body, "<p>home</p>");
  EXPECT_EQ(admin->get("/", {{"If-None-Match", page.headers.at("etag")}}).status, 304);
  EXPECT_EQ(admin->get("/", {{"If-None-Match", "\"old\", W/" + page.headers.at("etag")}}).status, 304);
  EXPECT_EQ(admin->get("/settings/users").body, "<p>home</p>") << "a page of the dashboard";
  EXPECT_EQ(admin->get("/assets/a.js").headers["content-type"], "text/javascript; charset=utf-8");
  EXPECT_EQ(admin->get("/assets/b.js").status, 404);
  for (const char* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt"}) {
    EXPECT_EQ(admin->get(path).body.find("secret\n"), std::string::npos) << path;
    EXPECT_NE(admin->get(path).body, "secret") << path;
  }
}

}  // namespace
}  // namespace homeward::server::front_test
