// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/build_map.hpp"

namespace homeward::pipeline {

/// A stretch of a tour inside one place.
struct Visit {
  int place = 0;
  int first = 0;  // indices of images
  int last = 0;
};

/// A piece of a tour whose edges are weak: driven once more, with more pictures, it would be sure.
struct WeakStretch {
  int first = 0;  // indices of images, in tour order
  int last = 0;
  int edges = 0;  // ways between two places, both directions counted once
  double length_m = 0.0;
  double least_confidence = 1.0;
};

/// Two places that look alike and are kept apart.
struct LookAlike {
  int place_a = 0;
  int place_b = 0;
  double distance = 0.0;    // visual distance D of the prototypes
  std::optional<int> hops;  // edges between them; nothing: no way
  int hypothesis = -1;      // index of the map's hypothesis between the two, the most similar; -1: none
};

/// The step from one picture of a tour to the next.
struct Gap {
  int before = 0;         // index of the image before it
  double length = 0.0;    // metres with odometry, else visual distance
  double distance = 0.0;  // visual distance, infinite where the two pictures have nothing in common
};

/// What a report tells and a map does not say by itself.
struct ReportFacts {
  bool metric = false;                 // lengths are metres
  std::vector<int> place_of;           // of each image; -1: none
  std::vector<int> prototype_of;       // of each place, index of an image; -1: none
  std::vector<Visit> visits;           // in tour order
  std::vector<int> visits_of;          // number of each place
  std::vector<int> component_of;       // of each place
  int parts = 0;                       // of the map that no edge joins
  std::vector<WeakStretch> weak;       // in tour order
  int weak_edges = 0;                  // both directions counted once
  int edges = 0;                       // the same way
  int weak_off_tour = 0;               // weak edges that no tour drove
  std::vector<LookAlike> look_alikes;  // most alike first
  std::vector<Gap> gaps;               // longest first
  std::vector<char> joined;            // of each hypothesis: its two pictures are in one place, by whatever way
  int open = 0;                        // undecided hypotheses that are not joined
  std::vector<int> uncertain_first;    // indices of hypotheses
};

ReportFacts gather_facts(const BuiltMap& built);

/// How much is known for or against a hypothesis, whichever is more: 0 where nothing is, 1 where there is no doubt.
double certainty(const map::Hypothesis& hypothesis);

/// "kitchen (p12)", escaped for HTML.
std::string place_name(const map::Place& place);

/// The file's name of an image without its tour, escaped for HTML.
std::string picture_name(const ImageId& image);

}  // namespace homeward::pipeline
