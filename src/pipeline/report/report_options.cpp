// SPDX-License-Identifier: Apache-2.0
#include "pipeline/report/report_options.hpp"

#include <algorithm>
#include <array>
#include <ctime>

namespace homeward::pipeline {

std::string report_date(TimeUs t_us) {
  constexpr TimeUs kSecond = 1'000'000;
  const auto seconds = static_cast<std::time_t>(t_us / kSecond);
  std::tm local{};
  std::array<char, 64> text{};
  if (localtime_r(&seconds, &local) == nullptr) return {};
  std::strftime(text.data(), text.size(), "%e %B %Y", &local);
  const std::string date = text.data();
  return date.substr(std::min(date.find_first_not_of(' '), date.size()));
}

}  // namespace homeward::pipeline
