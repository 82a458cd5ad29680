// SPDX-License-Identifier: Apache-2.0
#include "server/routes/evidence_routes.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "map/lookup.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/doubt_json.hpp"
#include "wire/json_reader.hpp"
#include "wire/pair_json.hpp"

namespace homeward::server {
namespace {

/// Null where the query does not have it.
const std::string* asked(const Request& request, const char* name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? nullptr : &found->second;
}

Error wrong(const char* name, const std::string& message) {
  return {ErrorCode::kInvalidInput, message, "query/" + std::string(name)};
}

Status read_count(const Request& request, const char* name, std::size_t least, std::size_t most, std::size_t& count) {
  const std::string* text = asked(request, name);
  if (text == nullptr) return {};
  const char* last = text->data() + text->size();
  const auto [end, trouble] = std::from_chars(text->data(), last, count);
  if (trouble == std::errc{} && end == last && count >= least && count <= most) return {};
  return tl::unexpected<Error>(
      wrong(name, "Between " + std::to_string(least) + " and " + std::to_string(most) + " can be asked for."));
}

/// One of a query's words, by the names of an enumeration; untouched where it is not there.
template <class Enum, class Names, class Value>
Status read_choice(const Request& request, const char* name, const Names& names, Value& value) {
  const std::string* text = asked(request, name);
  if (text == nullptr) return {};
  const std::optional<Enum> found = names.find(*text);
  if (!found) {
    std::string known;
    for (const auto& one : names.all()) known += (known.empty() ? "" : ", ") + std::string(one);
    return tl::unexpected<Error>(wrong(name, "'" + wire::shown(*text) + "' is none of " + known + "."));
  }
  value = *found;
  return {};
}

Result<wire::DoubtFilter> filter_in(const Request& request) {
  wire::DoubtFilter filter;
  if (const Status read = read_choice<wire::DoubtsAbout>(request, "about", wire::kDoubtsAboutNames, filter.about);
      !read)
    return pass_on(read);
  if (const Status read = read_choice<map::DoubtKind>(request, "kind", map::kDoubtKindNames, filter.kind); !read)
    return pass_on(read);
  if (const std::string* place = asked(request, "place")) filter.place = PlaceId(*place);
  if (const Status read = read_count(request, "offset", 0, 1'000'000, filter.offset); !read) return pass_on(read);
  if (const Status read = read_count(request, "limit", 1, wire::kMaxDoubts, filter.limit); !read) return pass_on(read);
  return filter;
}

Response list_doubts(MapService& maps, const Request& request) {
  const auto filter = filter_in(request);
  if (!filter) return problem_of(filter);
  const MapId map(request.parameter("map"));
  const auto loaded = maps.load(map);
  if (!loaded) return problem_of(loaded);
  if (filter->place && map::find_place((*loaded)->map, *filter->place) == nullptr) {
    return problem({ErrorCode::kUnknownPlace, "The map has no place " + filter->place->str() + ".", "query/place"});
  }
  return json_response(200, wire::doubts_to_json(*maps.doubts(*loaded), (*loaded)->map, map.str(), *filter));
}

Response pair(MapService& maps, const Request& request) {
  std::array<ImageId, 2> images;
  std::size_t at = 0;
  for (const char* name : {"image_a", "image_b"}) {
    const std::string* given = asked(request, name);
    if (given == nullptr || given->empty()) return problem(wrong(name, std::string("Name a picture as ") + name + "."));
    images.at(at++) = ImageId(*given);
  }
  const auto found = maps.pair(MapId(request.parameter("map")), images[0], images[1]);
  if (!found) return problem_of(found);
  Response response = json_response(200, wire::pair_to_json(*found));
  response.headers["cache-control"] = "private, max-age=3600";
  return response;
}

}  // namespace

void add_evidence_routes(Router& router, MapService& maps) {
  MapService* m = &maps;
  router.add({operation("list_doubts"), [m](Request& request) { return list_doubts(*m, request); }});
  router.add({operation("get_pair"), [m](Request& request) { return pair(*m, request); }});
}

}  // namespace homeward::server
