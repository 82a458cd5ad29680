// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "map/taught_path.hpp"
#include "pipeline/teach_path.hpp"
#include "server/work/build_jobs.hpp"
#include "server/work/stored_tours.hpp"
#include "wire/reason.hpp"

namespace homeward::server {

Result<wire::JobState> BuildJobs::teach(wire::JobView& job, const db::MapRecord& record, const std::stop_token& stop) {
  const TourId& tour = record.tours.front();
  const auto tours = open_tours(store_, record.tours);
  if (!tours) return pass_on(tours);
  const auto images = store_.tour_images(tour);
  if (!images) return pass_on(images);
  const auto bytes = [&](std::size_t index) { return store_.image_bytes(tour, images->at(index).number); };
  auto taught = pipeline::teach_path(*tours->sources.front(), tours->camera, record.name, repeat::dense_teaching(),
                                     bytes, progress_of(job), stop);
  if (!taught) return pass_on(taught);
  job.skipped = static_cast<std::int64_t>(taught->skipped.size());
  job.stage = "thumbnails";
  tell(job);
  db::Thumbnails thumbnails;
  if (const Status made = add_thumbnails(taught->map, *tours, stop, thumbnails); !made) return pass_on(made);
  const auto now = store_.map(job.map);
  if (!now) return pass_on(now);
  taught->map.revision = now->revision + 1;
  const std::size_t cuts = taught->map.path->taught.cuts.size();
  const auto kept = maps_.keep_learnt(job.map, taught->map, thumbnails, now->revision, {});
  if (!kept) return pass_on(kept);
  if (cuts > 0)
    job.notes.push_back({wire::ReasonCode::kPathInPieces, {{"pieces", static_cast<std::int64_t>(cuts) + 1}}});
  spdlog::info("job {}: map {} is a path of {} key images from {} pictures, cut {} times", job.id.str(), job.map.str(),
               kept->places, kept->images, cuts);
  return wire::JobState::kDone;
}

}  // namespace homeward::server
