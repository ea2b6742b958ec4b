// SPDX-License-Identifier: GPL-3.0-or-later
// What a page asks of a program of ours, and what it is told.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "calibration/files/sentence.h"

namespace insitu {

struct WebRequest {
  std::string method;                        // GET or POST
  std::string path;                          // "/api/tile"
  std::map<std::string, std::string> query;  // decoded
  std::string body;
};

struct WebResponse {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  int max_age = 0;  // [s] that the browser itself may keep it; 0: not at all
};

// Path and query of a request's target. nullopt unless it is an absolute path of names of letters,
// digits, "-", "_" and ".", none beginning with a point, and a query that can be decoded and names
// nothing twice.
std::optional<WebRequest> ParseTarget(std::string_view target);

// Of the query. Throws InputError: not there, or no whole number.
int QueryInteger(const WebRequest& request, const std::string& name);

// {"error": text}, in English alone.
WebResponse ErrorResponse(int status, const std::string& text);
// {"error": text, "error_said"}
WebResponse ErrorResponse(int status, const Sentence& sentence);

}  // namespace insitu
