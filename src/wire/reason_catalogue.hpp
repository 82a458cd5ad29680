// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace homeward::wire {

/// The types of parameters of proto/reasons.json.
enum class ParameterType { kText, kCount, kDestination, kReason, kList, kSeries };

struct ReasonParameter {
  std::string_view name;
  ParameterType type;
};

/// A code of proto/reasons.json with its sentence of proto/reasons.en.json.
struct ReasonRow {
  std::string_view name;
  std::string_view kind;
  std::string_view english;
  std::vector<ReasonParameter> parameters;
};

/// What English puts between the items of a list, before the last one, and for a destination without a label.
struct ReasonWords {
  std::string_view between;
  std::string_view last;
  std::string_view destination;
};

/// One row for each code, in the order of the enumeration. Written when the build is configured (reason_codes.cmake).
const std::vector<ReasonRow>& reason_rows();
const ReasonWords& reason_words();

}  // namespace homeward::wire
