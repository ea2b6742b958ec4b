// SPDX-License-Identifier: GPL-3.0-or-later
// What was found wrong with a survey, and what its parts look at.
#pragma once

#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/sentence.h"
#include "calibration/lens/camera.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct Diagnosis {
  enum class Kind {
    kFault,     // the input contradicts itself, and agrees when corrected so
    kMisfit,    // something does not fit, and no correction is known: a gross error
    kQuestion,  // it fits, but is hardly meant so
  };
  FilePlace place;
  Sentence message;  // what is wrong, what shows it, what to do
  Kind kind = Kind::kFault;
  std::string unused_control = {};  // the control point, where it is one that nothing refers to
};

// "observations.csv:12: message".
std::string Text(const Diagnosis& diagnosis);

// Names in quotes, as QuotedList has them, and "photo 'a'", "photos 'a' and 'b'"; to be values of a
// message.
Json::Value SaidNames(const std::vector<std::string>& names);
Json::Value SaidPhotos(const std::vector<std::string>& names);

// What is diagnosed; `cameras` go with `photos`.
struct DiagnosisInput {
  const Survey& survey;
  const std::vector<std::string>& photos;
  const std::vector<Camera>& cameras;
};

}  // namespace insitu
