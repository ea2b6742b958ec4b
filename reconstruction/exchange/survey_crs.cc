// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/survey_crs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/exchange/named_system.h"
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

constexpr double kFarOutside = 5;  // [deg], no neighbour's system is used so far off its area

std::vector<const SurveyFile*> AsConst(const std::vector<SurveyFile*>& files) {
  return {files.begin(), files.end()};
}

// `has_units`: lengths are metres already, by the units that the file states.
CoordinateSystem Known(const std::filesystem::path& path, const std::string& text, bool has_units,
                       std::vector<std::string>* report) {
  const NamedSystem named = SystemByWords(path, text);
  const CoordinateSystem& system = named.system;
  if (!named.remark.empty() &&
      std::find(report->begin(), report->end(), named.remark) == report->end()) {
    report->push_back(named.remark);
  }
  if (std::abs(system.metres_per_unit() - 1) > 1e-12 && !has_units) {
    throw InputError(
        path,
        "the coordinate system " + system.name() +
            " is not in metres; convert the file first, heights and all, or state the units of "
            "its columns");
  }
  if (system.metres_per_height() < 0 ||
      (std::abs(system.metres_per_height() - 1) > 1e-12 && !has_units)) {
    throw InputError(path,
                     "the coordinate system \"" + text + "\" has " +
                         (system.metres_per_height() < 0 ? "depths" : "heights in another unit") +
                         ", expected heights in metres; convert them first and name the "
                         "system without its heights");
  }
  return system;
}

// The system of all files, nullopt if none names any.
std::optional<CoordinateSystem> CommonSystem(const std::vector<SurveyFile*>& files,
                                             const std::optional<std::string>& file_crs,
                                             std::vector<std::string>* report) {
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
    if (named) system = Known(file->path, *named, file->has_units, report);
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
  const bool is_latitude_first = std::abs(position.x()) <= 90 && std::abs(position.y()) <= 180;
  throw ErrorAt(
      point,
      is_latitude_first
          ? "latitude stands before longitude, expected x, the longitude, first: exchange the two"
          : "no longitude and latitude; is the file in metres, or latitude first?");
}

// Coordinates far from where their system is used are of another one, or exchanged.
void CheckArea(const CoordinateSystem& system, const std::vector<const SurveyFile*>& files,
               std::vector<std::string>* report) {
  const auto area = system.is_local() ? std::nullopt : AreaOf(system);
  if (!area) return;
  const auto wgs84 = CoordinateSystem::FromText("EPSG:4326");
  INSITU_CHECK(wgs84.has_value());
  const CoordinateConversion to_degrees(system, *wgs84);
  const auto excess = [&](const Eigen::Vector2d& xy) {
    const auto place = to_degrees(xy / system.metres_per_unit());
    return place ? area->Excess(*place) : std::numeric_limits<double>::infinity();
  };
  size_t count = 0, outside = 0;
  const SurveyedPoint* worst = nullptr;
  double most = 0, least = std::numeric_limits<double>::infinity();
  for (const SurveyFile* file : files) {
    for (const auto* points : {&file->points, &file->centers}) {
      for (const SurveyedPoint& point : *points) {
        const double beyond = excess(point.position.head<2>());
        ++count;
        outside += beyond > 0;
        least = std::min(least, beyond);
        if (beyond <= most) continue;
        most = beyond;
        worst = &point;
      }
    }
  }
  if (worst == nullptr) return;
  const Eigen::Vector2d exchanged(worst->position.y(), worst->position.x());
  const std::string told =
      "lies outside the area of use of " + system.name() + " (" + area->name + ")" +
      (excess(exchanged) == 0 ? "; with x and y exchanged it would lie inside" : "");
  if (least > kFarOutside)
    throw ErrorAt(*worst, told + "; is it the right system, zone and hemisphere?");
  report->push_back("WARNING: " + std::to_string(outside) + " of " + std::to_string(count) +
                    " points, point \"" + worst->name + "\" farthest, " + told);
}

// PROJ wants the system's own unit, and we metres.
void Convert(const CoordinateSystem& source, const CoordinateSystem& target,
             const std::vector<SurveyFile*>& files) {
  const CoordinateConversion convert(source, target);
  for (SurveyFile* file : files) {
    for (SurveyedPoint* point : Positions(file)) {
      const auto xy = convert(point->position.head<2>() / source.metres_per_unit());
      if (!xy) throw ErrorAt(*point, "cannot be converted to " + target.name());
      point->position.head<2>() = *xy * target.metres_per_unit();
    }
  }
}

CoordinateSystem TargetSystem(const CoordinateSystem& source,
                              const std::optional<std::string>& target, const SurveyedPoint& first,
                              std::vector<std::string>* report) {
  if (!target) {
    return source.is_geographic()
               ? CoordinateSystem::UtmZone(first.position.x(), first.position.y())
               : source;
  }
  const CoordinateSystem system = Known("--crs", *target, false, report);
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
  std::vector<std::string> report;
  const auto source = CommonSystem(files, file_crs, &report);
  if (!source) {
    if (target) {
      throw InputError(files[0]->path,
                       "names no coordinate system to convert from, name it with "
                       "--file-crs");
    }
    const bool have_units =
        std::all_of(files.begin(), files.end(), [](const auto* file) { return file->has_units; });
    return {have_units
                ? "no coordinate system is named: coordinates are taken as they are, in metres by "
                  "the units "
                  "of their columns"
                : "no coordinate system is named: coordinates are taken as they are, in metres"};
  }
  PutEastFirst(files, *source, &report);
  if (source->is_geographic()) {
    for (SurveyFile* file : files) {
      for (const SurveyedPoint* point : Positions(file)) CheckDegrees(*point);
    }
  }
  CheckArea(*source, AsConst(files), &report);
  const CoordinateSystem system = TargetSystem(*source, target, *Positions(files[0])[0], &report);
  if (system == *source) {
    report.push_back("coordinates are in " + system.name() + " (" + system.Code() + ")");
    return report;
  }
  if (source->is_local()) {
    throw InputError(files[0]->path, "is in local coordinates, which have no place on the earth");
  }
  Convert(*source, system, files);
  if (target) CheckArea(system, AsConst(files), &report);
  report.push_back("coordinates are converted from " + source->name() + " (" + source->Code() +
                   ") to " + system.name() + " (" + system.Code() +
                   "); heights are kept as they are");
  return report;
}

}  // namespace insitu
