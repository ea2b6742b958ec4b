// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/survey_crs.h"

#include <cmath>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {
namespace {

std::vector<SurveyedPoint*> Positions(SurveyFile* file) {
  std::vector<SurveyedPoint*> positions;
  for (SurveyedPoint& point : file->points) positions.push_back(&point);
  for (SurveyedPoint& center : file->centers) positions.push_back(&center);
  return positions;
}

InputError ErrorAt(const SurveyedPoint& point, const std::string& message) {
  return InputError(point.place.path, point.place.line, "point \"" + point.name + "\": " + message);
}

CoordinateSystem Known(const std::filesystem::path& path, const std::string& text) {
  const auto system = CoordinateSystem::FromText(text);
  if (!system) {
    throw InputError(path, "the coordinate system \"" + text +
                               "\" is not known to PROJ as a geographic, projected or local one, "
                               "expected for example EPSG:2056 or WGS84 UTM 32N");
  }
  if (std::abs(system->metres_per_unit() - 1) > 1e-12) {
    throw InputError(path, "the coordinate system " + system->name() +
                               " is not in metres; convert the file first, heights and all");
  }
  if (std::abs(system->metres_per_height() - 1) > 1e-12) {
    throw InputError(path,
                     "the coordinate system \"" + text + "\" has " +
                         (system->metres_per_height() < 0 ? "depths" : "heights in another unit") +
                         ", expected heights in metres; convert them first and name the "
                         "system without its heights");
  }
  return *system;
}

// The system of all files, nullopt if none names any.
std::optional<CoordinateSystem> CommonSystem(const std::vector<SurveyFile*>& files,
                                             const std::optional<std::string>& file_crs) {
  std::optional<CoordinateSystem> common;
  const SurveyFile* first = nullptr;
  for (const SurveyFile* file : files) {
    const std::optional<std::string>& named = file->crs ? file->crs : file_crs;
    if (!named && file->has_degrees) {
      throw InputError(file->path,
                       "longitudes and latitudes of an unnamed coordinate system, name "
                       "it with --file-crs, for example EPSG:4326");
    }
    std::optional<CoordinateSystem> system;
    if (named) system = Known(file->path, *named);
    if (system && file->has_degrees && !system->is_geographic()) {
      throw InputError(file->path, "has longitudes and latitudes by its header, but " +
                                       system->name() +
                                       " is no system of degrees; name theirs, for example "
                                       "EPSG:4326, and that of the result with --crs");
    }
    if (first && (common.has_value() != system.has_value() || (common && !(*common == *system)))) {
      const auto name = [](const auto& any) { return any ? any->name() : "no named system"; };
      throw InputError(file->path, "is in " + name(system) + ", but " + first->path.string() +
                                       " in " + name(common) +
                                       ": mixed coordinate systems, import them one by one with "
                                       "--crs, or name the missing one with --file-crs");
    }
    if (!first) first = file;
    common = system;
  }
  return common;
}

void PutEastFirst(const std::vector<SurveyFile*>& files, const CoordinateSystem& system,
                  std::vector<std::string>* report) {
  for (SurveyFile* file : files) {
    if (!file->has_axes_of_crs || !system.has_north_first()) continue;
    for (SurveyedPoint* point : Positions(file)) {
      std::swap(point->position.x(), point->position.y());
      if (point->sigma) std::swap(point->sigma->x(), point->sigma->y());
    }
    report->push_back(file->path.filename().string() + ": north comes first in " + system.name() +
                      ", east is put first");
  }
}

void CheckDegrees(const SurveyedPoint& point) {
  const Eigen::Vector3d& position = point.position;
  if (std::abs(position.x()) <= 180 && std::abs(position.y()) <= 90) return;
  throw ErrorAt(point, "no longitude and latitude; is the file in metres, or latitude first?");
}

void Convert(const CoordinateSystem& source, const CoordinateSystem& target,
             const std::vector<SurveyFile*>& files) {
  const CoordinateConversion convert(source, target);
  for (SurveyFile* file : files) {
    for (SurveyedPoint* point : Positions(file)) {
      const auto xy = convert(point->position.head<2>());
      if (!xy) throw ErrorAt(*point, "cannot be converted to " + target.name());
      point->position.head<2>() = *xy;
    }
  }
}

CoordinateSystem TargetSystem(const CoordinateSystem& source,
                              const std::optional<std::string>& target,
                              const SurveyedPoint& first) {
  if (!target) {
    return source.is_geographic()
               ? CoordinateSystem::UtmZone(first.position.x(), first.position.y())
               : source;
  }
  const CoordinateSystem system = Known("--crs", *target);
  if (system.is_geographic() || system.is_local()) {
    throw InputError("--crs", system.name() + " is not in metres, expected a projected system");
  }
  return system;
}

}  // namespace

std::vector<std::string> ConvertToOneSystem(const std::optional<std::string>& file_crs,
                                            const std::optional<std::string>& target,
                                            std::vector<SurveyFile>* all) {
  std::vector<SurveyFile*> files;  // those that hold coordinates
  for (SurveyFile& file : *all) {
    if (!Positions(&file).empty()) files.push_back(&file);
  }
  if (files.empty()) return {};
  const auto source = CommonSystem(files, file_crs);
  if (!source) {
    if (target) {
      throw InputError(files[0]->path,
                       "names no coordinate system to convert from, name it with "
                       "--file-crs");
    }
    return {"no coordinate system is named: coordinates are taken as they are, in metres"};
  }
  std::vector<std::string> report;
  PutEastFirst(files, *source, &report);
  if (source->is_geographic()) {
    for (SurveyFile* file : files) {
      for (const SurveyedPoint* point : Positions(file)) CheckDegrees(*point);
    }
  }
  const CoordinateSystem system = TargetSystem(*source, target, *Positions(files[0])[0]);
  if (system == *source) {
    report.push_back("coordinates are in " + system.name() + " (" + system.Code() + ")");
    return report;
  }
  if (source->is_local()) {
    throw InputError(files[0]->path, "is in local coordinates, which have no place on the earth");
  }
  Convert(*source, system, files);
  report.push_back("coordinates are converted from " + source->name() + " (" + source->Code() +
                   ") to " + system.name() + " (" + system.Code() +
                   "); heights are kept as they are");
  return report;
}

}  // namespace insitu
