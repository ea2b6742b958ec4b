// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/hours/site_hour.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "radiometry/light/simulated_daylight.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/site_sun.h"
#include "reconstruction/survey/read_survey.h"
#include "reconstruction/verdict/sun_verdict.h"

namespace insitu {
namespace {

constexpr double kClockDoubt = 1.0 * kDegree;  // of elevation: beyond it the clock is in doubt
constexpr size_t kTimeOfDay = 5;               // letters of "16:30"

[[noreturn]] void RefuseTime(const std::string& time) {
  throw InputError("hour",
                   Quoted(time) + " is no time, expected for example 16:30 or 2024-12-21T12:00");
}

// "16:30" of a day as a whole time without offset.
std::string WithDay(const std::string& time, const std::string& day) {
  return time.size() == kTimeOfDay ? day + "T" + time : time;
}

// As stated, or with the photographs' offset.
std::string WithOffset(const std::string& time, const std::string& local_time) {
  if (JulianDayOf(time)) return time;
  const size_t at = local_time.find_first_of("Z+-", local_time.find('T'));
  return at == std::string::npos ? time : time + local_time.substr(at);
}

std::string Tenths(double degrees) {
  const long tenths = std::lround(10 * degrees);
  return std::to_string(tenths / 10) + "_" + std::to_string(tenths % 10);
}

// What site.json and the photographs tell of when and where, with the measured sun.
std::optional<SunCircumstances> Circumstances(const SitePaths& site) {
  const SitePhotos photos = ReadSitePhotos(site);
  const Survey survey = ReadSurvey(site, photos.names, SurveyFolder::kOptional);
  return SunCircumstancesOf(site, photos, survey);
}

std::optional<Eigen::Vector3d> StatedNorth(const SitePaths& site) {
  if (!std::filesystem::exists(site.description())) return std::nullopt;
  const auto node = JsonNode::Load(site.description()).Find("true_north");
  if (!node) return std::nullopt;
  if (node->Vector3().norm() == 0) throw node->Error("expected a direction, not (0, 0, 0)");
  return node->Vector3().normalized();
}

void RequireSunAbove(const SiteHour& hour) {
  if (hour.position.elevation >= kLowestSimulatedSun) return;
  throw InputError("hour", "at " + hour.told + " the sun stands " +
                               Number("%.1f", hour.position.elevation / kDegree) +
                               " deg above the horizon, expected " +
                               Number("%.1f", kLowestSimulatedSun / kDegree) +
                               " or more: the daylight of a lower sun is not simulated");
}

SunPosition AlmanacAt(const SitePaths& site, const SunFrame& frame, const std::string& time) {
  if (!frame.place || frame.local_time.empty()) {
    throw InputError(site.description(),
                     "lacks latitude, longitude or local_time (or no sun pairs are measured), "
                     "expected them for the sun at another hour");
  }
  const auto day = JulianDayOf(time);
  if (!day) RefuseTime(time);
  return PositionOfSun(*day, *frame.place);
}

}  // namespace

std::string HourName(const HourRequest& hour, const std::string& day) {
  if (hour.sun) {
    return "az" + Tenths(hour.sun->azimuth / kDegree) + "el" +
           Tenths(hour.sun->elevation / kDegree);
  }
  const std::string& time = hour.time;
  const std::string whole = WithDay(time, day.empty() ? "2000-01-01" : day);
  if (!JulianDayOf(whole) && !JulianDayOf(whole + "Z")) RefuseTime(time);
  const std::string clock = whole.substr(11, 2) + whole.substr(14, 2);
  const bool is_same_day = time.size() == kTimeOfDay || whole.substr(0, 10) == day;
  return is_same_day ? clock : whole.substr(0, 10) + "T" + clock;
}

SunFrame SunFrameOf(const SitePaths& site, const NaturalEnvironment& measured) {
  SunFrame frame;
  frame.zenith = measured.light.zenith_direction;
  frame.north = StatedNorth(site).value_or(Eigen::Vector3d::UnitY());
  const SceneGeometry& scene = measured.scene;
  if (!scene.sun) return frame;
  auto circumstances = Circumstances(site);
  if (!circumstances) return frame;
  circumstances->true_north = frame.north;
  const auto verdict = JudgeSun(*scene.sun, scene.zenith, *circumstances);
  if (!verdict) return frame;
  frame.place = circumstances->place;
  frame.local_time = verdict->almanac.local_time;
  frame.turned = std::remainder(verdict->measured.azimuth - verdict->almanac.sun.azimuth, 2 * M_PI);
  frame.elevation_difference = verdict->measured.elevation - verdict->almanac.sun.elevation;
  frame.north = SunDirection({frame.turned, 0}, frame.north, frame.zenith);
  return frame;
}

SiteHour SiteHourAt(const SitePaths& site, const NaturalEnvironment& measured,
                    const HourRequest& request) {
  if (!measured.scene.sun) {
    throw InputError(site.environment(),
                     "no sun was measured in the photographs: the light of another hour cannot be "
                     "scaled from it, expected sun pairs in survey/directions.json");
  }
  const SunFrame frame = SunFrameOf(site, measured);
  SiteHour hour;
  hour.name = HourName(request, frame.Day());
  if (request.sun) {
    hour.told = "a chosen position of the sun";
    hour.position = *request.sun;
  } else {
    hour.told = WithOffset(WithDay(request.time, frame.Day()), frame.local_time);
    hour.position = AlmanacAt(site, frame, hour.told);
  }
  RequireSunAbove(hour);
  hour.sun = SunDirection(hour.position, frame.north, frame.zenith).normalized();
  if (std::abs(frame.elevation_difference) > kClockDoubt) {
    hour.remarks.push_back(
        "at the photographs' time " + frame.local_time + " the measured sun stands " +
        Number("%.1f", frame.elevation_difference / kDegree) +
        " deg higher than the almanac's: check local_time in site.json, the hour may be wrong");
  }
  return hour;
}

}  // namespace insitu
