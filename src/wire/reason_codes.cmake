# Writes from proto/reasons.json and proto/reasons.en.json, into HOMEWARD_REASONS_OUT:
#   wire/reason_codes.hpp     the enumeration of the codes
#   wire/reason_catalogue.cpp their names, parameters and English
# Included when the build is configured; also cmake -DHOMEWARD_PROTO=proto -DHOMEWARD_REASONS_OUT=out -P reason_codes.cmake.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${HOMEWARD_PROTO}/reasons.json
                                         ${HOMEWARD_PROTO}/reasons.en.json)
endif()
file(READ ${HOMEWARD_PROTO}/reasons.json reasons)
file(READ ${HOMEWARD_PROTO}/reasons.en.json english)
set(enumerators "")
set(rows "")
string(JSON count LENGTH "${reasons}" codes)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON code MEMBER "${reasons}" codes ${i})
  string(REPLACE "_" ";" parts ${code})
  set(name "k")
  foreach(part IN LISTS parts)
    string(SUBSTRING ${part} 0 1 first)
    string(SUBSTRING ${part} 1 -1 rest)
    string(TOUPPER ${first} first)
    string(APPEND name ${first}${rest})
  endforeach()
  string(APPEND enumerators "  ${name},\n")
  string(JSON template ERROR_VARIABLE missing GET "${english}" reasons ${code})
  if(missing)
    message(FATAL_ERROR "proto/reasons.en.json says nothing for the reason ${code}.")
  endif()
  set(parameters "")
  string(JSON parameter_count LENGTH "${reasons}" codes ${code} parameters)
  if(parameter_count GREATER 0)
    math(EXPR last_parameter "${parameter_count} - 1")
    foreach(p RANGE ${last_parameter})
      string(JSON parameter MEMBER "${reasons}" codes ${code} parameters ${p})
      string(JSON type GET "${reasons}" codes ${code} parameters ${parameter})
      string(SUBSTRING ${type} 0 1 first)
      string(SUBSTRING ${type} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND parameters "{\"${parameter}\", ParameterType::k${first}${rest}}, ")
    endforeach()
  endif()
  string(JSON kind GET "${reasons}" codes ${code} kind)
  string(APPEND rows "    {\"${code}\", \"${kind}\", R\"words(${template})words\", {${parameters}}},\n")
endforeach()
foreach(word between last destination)
  string(JSON word_${word} GET "${english}" words ${word})
endforeach()
file(CONFIGURE OUTPUT ${HOMEWARD_REASONS_OUT}/wire/reason_codes.hpp @ONLY CONTENT [[
// Made from proto/reasons.json by src/wire/reason_codes.cmake.
#pragma once

namespace homeward::wire {

/// What a reason says: a code of proto/reasons.json.
enum class ReasonCode {
@enumerators@};

}  // namespace homeward::wire
]])
file(CONFIGURE OUTPUT ${HOMEWARD_REASONS_OUT}/wire/reason_catalogue.cpp @ONLY CONTENT [[
// Made from proto/reasons.json and proto/reasons.en.json by src/wire/reason_codes.cmake.
#include "wire/reason_catalogue.hpp"

namespace homeward::wire {

const std::vector<ReasonRow>& reason_rows() {
  static const std::vector<ReasonRow> kRows = {
@rows@  };
  return kRows;
}

const ReasonWords& reason_words() {
  static const ReasonWords kWords = {R"words(@word_between@)words", R"words(@word_last@)words",
                                     R"words(@word_destination@)words"};
  return kWords;
}

}  // namespace homeward::wire
]])
