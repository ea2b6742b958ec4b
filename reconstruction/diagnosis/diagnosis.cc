// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

std::string Text(const Diagnosis& diagnosis) {
  return diagnosis.place.path.filename().string() + ":" + std::to_string(diagnosis.place.line) +
         ": " + diagnosis.message.text();
}

Json::Value SaidNames(const std::vector<std::string>& names) {
  constexpr size_t kShown = 4;
  Json::Value list = Sentence("nameOne", "'{name}'", {{"name", names.front()}}).ToJson();
  for (size_t i = 1; i < names.size(); ++i) {
    if (i == kShown && names.size() > kShown + 1) {
      const auto others = static_cast<Json::UInt64>(names.size() - kShown);
      return Sentence("nameOthers", "{first} and {count} others",
                      {{"first", list}, {"count", others}})
          .ToJson();
    }
    const Sentence::Values values = {{"first", list}, {"name", names[i]}};
    list = i + 1 == names.size() ? Sentence("nameAnd", "{first} and '{name}'", values).ToJson()
                                 : Sentence("nameNext", "{first}, '{name}'", values).ToJson();
  }
  return list;
}

Json::Value SaidPhotos(const std::vector<std::string>& names) {
  const Sentence::Values values = {{"names", SaidNames(names)}};
  return names.size() > 1 ? Sentence("photoMany", "photos {names}", values).ToJson()
                          : Sentence("photoSingle", "photo {names}", values).ToJson();
}

}  // namespace insitu
