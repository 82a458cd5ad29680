// SPDX-License-Identifier: Apache-2.0
#include "server/work/build_record.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "pipeline/report/report_page.hpp"
#include "pipeline/similarity_picture.hpp"
#include "wire/map_reasons.hpp"
#include "wire/reason.hpp"
#include "wire/similarity_blob.hpp"

namespace homeward::server {

namespace {

Result<std::string> drawn_report(const pipeline::BuiltMap& built, const StoredTours& tours,
                                 const pipeline::BuildOptions& options, TimeUs now_us, const std::stop_token& stop) {
  pipeline::ReportOptions report;
  report.date = pipeline::report_date(now_us);
  report.threads = options.threads;
  report.seed = options.seed;
  for (const map::TourWarning& warning : built.notes.warnings) {
    report.warnings.push_back({wire::english(wire::reason_of(warning)), warning.image.str()});
  }
  try {
    return pipeline::report_page(built, tours.views(), report, stop);
  } catch (const std::exception& trouble) {  // of the libraries that draw
    return fail(ErrorCode::kInternal, trouble.what());
  }
}

}  // namespace

Result<db::MapBuild> build_record(const pipeline::BuiltMap& built, const StoredTours& tours,
                                  const pipeline::BuildOptions& options, TimeUs now_us, const std::stop_token& stop) {
  db::MapBuild record;
  record.similarity = wire::encode_similarity(pipeline::similarity_of(built));
  auto page = drawn_report(built, tours, options, now_us, stop);
  if (stop.stop_requested()) return fail(ErrorCode::kCancelled, "The build was cancelled.");
  if (page) {
    record.report = std::move(*page);
  } else {
    spdlog::warn("the report of a build cannot be drawn: {} ({})", page.error().message, page.error().where);
  }
  return record;
}

}  // namespace homeward::server
