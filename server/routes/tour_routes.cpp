// SPDX-License-Identifier: Apache-2.0
#include "server/routes/tour_routes.hpp"

#include <charconv>
#include <cmath>

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/camera_json.hpp"
#include "wire/scans_json.hpp"
#include "wire/tour_json.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;

constexpr std::int64_t kLastNumber = 999'999;

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<std::int64_t> image_number(const Request& request) {
  const auto number = number_in<std::int64_t>(request.parameter("n"));
  if (!number || *number < 0 || *number > kLastNumber) {
    return fail(ErrorCode::kInvalidInput, "A picture's number is a whole number from 0 to 999999.", "path/n");
  }
  return *number;
}

// "x,y,theta" in metres and radians.
Result<Pose2> odometry_in(const std::string& text) {
  std::array<double, 3> values{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const auto value = number_in<double>(rest.substr(0, end));
    const bool last = end == rest.size();
    if (!value || !std::isfinite(*value) || last != (i == 2)) {
      return fail(ErrorCode::kInvalidInput, "Odometry is \"x,y,theta\" in metres and radians.", "X-Homeward-Odometry");
    }
    values[i] = *value;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return Pose2{values[0], values[1], values[2]};
}

// A program reads and writes its own tours alone, whose pictures are of somebody's home; nothing for a person.
std::optional<std::string> uploader_of(const Caller& caller) {
  if (caller.role != wire::Role::kRobot) return std::nullopt;
  return caller.robot.empty() ? caller.id : caller.robot;
}

Response add_tour(TourService& tours, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.line("name", 200);
  const auto camera = reader.take(wire::camera_from_json(reader.value("camera"), reader.path_of("camera")));
  if (name.empty()) reader.problem("name", "A tour needs a name.");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto tour = tours.add(name, camera, uploader_of(request.caller));
  if (!tour) return problem_of(tour);
  return json_response(201, wire::tour_info_to_json(*tour));
}

Response put_image(TourService& tours, const Request& request) {
  ImageUpload upload;
  upload.tour = TourId(request.parameter("tour"));
  const auto number = image_number(request);
  if (!number) return problem_of(number);
  upload.number = *number;
  const auto file = percent_decoded(request.header("x-homeward-filename"));
  if (!file) return problem(400, "Bad request", "X-Homeward-Filename has a broken escape.");
  upload.file = *file;
  if (const std::string text = request.header("x-homeward-t-us"); !text.empty()) {
    upload.t_us = number_in<TimeUs>(text);
    if (!upload.t_us || *upload.t_us < 0) {
      return problem({ErrorCode::kInvalidInput, "The time is whole microseconds since 1970.", "X-Homeward-T-Us"});
    }
  }
  if (const std::string text = request.header("x-homeward-odometry"); !text.empty()) {
    const auto pose = odometry_in(text);
    if (!pose) return problem_of(pose);
    upload.odometry = *pose;
  }
  upload.bytes = request.bytes();
  if (upload.bytes.empty()) {
    return problem({ErrorCode::kUnsupportedImage, "The body is empty; it has to be a JPEG or PNG picture.", "body"});
  }
  const auto receipt = tours.put_image(upload);
  if (!receipt) return problem_of(receipt);
  return json_response(receipt->is_new ? 201 : 200,
                       {{"n", receipt->number}, {"image", receipt->image.str()}, {"bytes", receipt->bytes}});
}

Response get_image(db::Store& store, const Request& request) {
  const auto number = image_number(request);
  if (!number) return problem_of(number);
  const auto bytes = store.image_bytes(TourId(request.parameter("tour")), *number);
  if (!bytes) return problem_of(bytes);
  const bool png = bytes->size() > 1 && (*bytes)[0] == 0x89;
  Response response = bytes_response(*bytes, png ? "image/png" : "image/jpeg");
  response.headers["cache-control"] = "private, max-age=3600";
  return response;
}

Response put_sweep(TourService& tours, const Request& request) {
  const auto number = image_number(request);
  if (!number) return problem_of(number);
  const auto file = percent_decoded(request.header("x-homeward-filename"));
  if (!file) return problem(400, "Bad request", "X-Homeward-Filename has a broken escape.");
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  auto sweep = wire::sweep_from_json(*body, "body");
  if (!sweep) return problem_of(sweep);
  const Status status = tours.put_sweep(TourId(request.parameter("tour")), {*number, *file, std::move(*sweep)});
  return status ? empty_response(204) : problem_of(status);
}

Response put_marks(TourService& tours, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto marks = wire::marks_from_json(*body, "body");
  if (!marks) return problem_of(marks);
  const Status status = tours.set_marks(TourId(request.parameter("tour")), *marks);
  if (!status) return problem_of(status);
  return json_response(200, wire::marks_to_json(*marks));
}

Response list_tours(TourService& tours, const Request& request) {
  const auto views = tours.list(uploader_of(request.caller));
  if (!views) return problem_of(views);
  json list = json::array();
  for (const wire::TourView& view : *views) list.push_back(wire::tour_info_to_json(view));
  return json_response(200, {{"tours", list}});
}

}  // namespace

void add_tour_routes(Router& router, TourService& tours, db::Store& store) {
  TourService* service = &tours;
  db::Store* db = &store;
  router.add({operation("list_tours"), [service](Request& request) { return list_tours(*service, request); }});
  router.add({operation("add_tour"), [service](Request& request) { return add_tour(*service, request); }});
  // All others are of one tour.
  const auto add = [&](const Operation& operation, const Handler& handler) {
    router.add({operation, [service, handler](Request& request) {
                  if (const auto uploader = uploader_of(request.caller)) {
                    const Status own = service->check_uploader(TourId(request.parameter("tour")), *uploader);
                    if (!own) return problem_of(own);
                  }
                  return handler(request);
                }});
  };
  add(operation("get_tour"), [service](Request& request) {
    const auto tour = service->get(TourId(request.parameter("tour")));
    return tour ? json_response(200, wire::tour_info_to_json(*tour)) : problem_of(tour);
  });
  add(operation("remove_tour"), [db](Request& request) {
    const Status removed = db->remove_tour(TourId(request.parameter("tour")));
    return removed ? empty_response(204) : problem_of(removed);
  });
  add(operation("put_image"), [service](Request& request) { return put_image(*service, request); });
  add(operation("get_image"), [db](Request& request) { return get_image(*db, request); });
  add(operation("put_sweep"), [service](Request& request) { return put_sweep(*service, request); });
  add(operation("put_marks"), [service](Request& request) { return put_marks(*service, request); });
  add(operation("complete_tour"), [service](Request& request) {
    const auto tour = service->complete(TourId(request.parameter("tour")));
    return tour ? json_response(200, wire::tour_info_to_json(*tour)) : problem_of(tour);
  });
}

}  // namespace homeward::server
