// SPDX-License-Identifier: Apache-2.0
#include "server/work/stored_drives.hpp"

#include "wire/appearance_blob.hpp"

namespace homeward::server {

Result<std::vector<std::vector<pipeline::DriveSight>>> drives_of(db::Store& store, const std::vector<MissionId>& drives,
                                                                 const map::TopologicalMap& map) {
  std::vector<std::vector<pipeline::DriveSight>> all;
  std::string other_features;
  for (const MissionId& id : drives) {
    const auto drive = store.drive(id);
    if (!drive && drive.error().code == ErrorCode::kNotFound) continue;  // newer ones took its place
    if (!drive) return pass_on(drive);
    if (drive->feature_config_id != map.feature_config_id) {
      other_features = drive->feature_config_id;
      continue;
    }
    std::vector<pipeline::DriveSight>& sights = all.emplace_back();
    for (const db::DriveSight& sight : drive->sights) {
      pipeline::DriveSight read;
      read.place = sight.place;
      if (!sight.place.empty()) {
        auto seen = wire::decode_appearance(sight.appearance, "missions/" + id.str());
        if (!seen) return pass_on(seen);
        read.seen = std::move(*seen);
      }
      sights.push_back(std::move(read));
    }
  }
  if (all.empty() && !other_features.empty()) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The drives saw features of the kind " + other_features + ", the map now has " + map.feature_config_id +
                    ": they cannot be compared.",
                map.name);
  }
  return all;
}

std::vector<pipeline::DriveSight> one_after_the_other(const std::vector<std::vector<pipeline::DriveSight>>& drives) {
  std::vector<pipeline::DriveSight> all;
  for (const std::vector<pipeline::DriveSight>& drive : drives) {
    all.insert(all.end(), drive.begin(), drive.end());
    all.emplace_back();
  }
  return all;
}

}  // namespace homeward::server
