// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "calibration/files/error_at.h"
#include "reconstruction/exchange/dbat_script.h"
#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {

SurveyFile ReadDbatSurvey(const std::filesystem::path& path) {
  const DbatScript script = ReadDbatScript(path);
  SurveyFile file;
  file.format = "script of DBAT with its tables";
  int fixed = 0;
  const auto add = [&](const DbatControlPoint& stated, ControlRole role) {
    SurveyedPoint point{stated.id, script.metres_per_unit * stated.position, std::nullopt, role,
                        stated.place};
    if (stated.sigma.isZero(0)) {
      ++fixed;
    } else {
      point.sigma = script.metres_per_unit * stated.sigma;
    }
    file.points.push_back(point);
  };
  for (const DbatControlPoint& point : script.control) add(point, ControlRole::kControl);
  for (const DbatControlPoint& point : script.check) add(point, ControlRole::kCheck);
  std::map<std::string, std::string> photos;
  for (const DbatImage& image : script.images) photos[image.id] = image.photo;
  for (const DbatMark& mark : script.marks) {
    const auto photo = photos.find(mark.image);
    if (photo == photos.end()) {
      throw ErrorAt(mark.place,
                    Sentence("dbatImage", "image \"{image}\" is not in the list of images",
                             {{"image", mark.image}}));
    }
    file.marks.push_back({photo->second, mark.point, mark.pixel.array() - kDbatFirstPixelCenter,
                          mark.sigma_px, mark.place});
  }
  if (fixed) {
    file.remarks.push_back(Sentence("remarkFixed", "{count} points are fixed there, without sigma",
                                    {{"count", fixed}}));
  }
  return file;
}

}  // namespace insitu
