// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/error_at.h"

namespace insitu {

SaidError ErrorAt(const FilePlace& place, const Sentence& message) {
  return {InputError(place.path, place.line, message.text()), place, message};
}

Sentence MessageOf(const std::exception& error) {
  const Sentence whole = SentenceOf(error);
  const Json::Value said = whole.ToJson()["text_said"];
  const Json::Value message = said.isObject() ? said["values"]["message"] : Json::Value();
  return message.isObject() ? Sentence::SaidIn(message, "text") : whole;
}

}  // namespace insitu
