// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/montage_stages.h"

#include <algorithm>

#include "calibration/files/error.h"
#include "calibration/foreground_matte.h"
#include "calibration/program/report_paths.h"
#include "calibration/site_cameras.h"
#include "radiometry/library/material_library.h"
#include "reconstruction/tie_points_site.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

bool Always(const MontageRequest&) { return true; }
Paths NoReports(const MontageRequest&) { return {}; }

Paths& operator+=(Paths& paths, const Paths& more) {
  paths.insert(paths.end(), more.begin(), more.end());
  return paths;
}

std::vector<std::string> Cameras(const MontageRequest& request) {
  return CamerasOf(ListCameraFolders(request.site));
}

// ---- calibrate -----------------------------------------------------------------------------

Paths CalibrationInputs(const MontageRequest& request) {
  return {request.site.boards(), request.site.photos(), request.site.description()};
}

Paths CalibrationReports(const MontageRequest& request) {
  Paths reports;
  for (const std::string& camera : Cameras(request)) {
    reports.push_back(request.site.calibration_report(camera));
  }
  return reports;
}

Paths CalibrationResults(const MontageRequest& request) {
  Paths results;
  for (const std::string& camera : Cameras(request)) {
    results += {request.site.camera(camera), request.site.calibration_report(camera),
                request.site.calibration_page(camera)};
  }
  return results;
}

// What later stages take of it.
Paths CalibratedCameras(const MontageRequest& request) {
  Paths cameras;
  for (const std::string& camera : Cameras(request)) {
    cameras += {request.site.camera(camera), request.site.calibration_report(camera)};
  }
  return cameras;
}

// ---- tie points ----------------------------------------------------------------------------

Paths TiePointInputs(const MontageRequest& request) {
  Paths inputs = CalibratedCameras(request);
  inputs += {request.site.photos(), request.site.survey() / "control_points.csv",
             request.site.survey() / "observations.csv", request.site.description()};
  return inputs;
}

// Those that were searched for once stay in use.
bool NeedsMatching(const MontageRequest& request) {
  return request.with_tie_points || fs::exists(request.site.tie_points()) ||
         NeedsTiePoints(request.site);
}

// ---- reconstruct ---------------------------------------------------------------------------

Paths ReconstructionInputs(const MontageRequest& request) {
  const SitePaths& site = request.site;
  Paths inputs = CalibratedCameras(request);
  inputs += {site.photos(), site.description(), site.tie_points()};
  for (const char* name :
       {"control_points.csv", "observations.csv", "polygons.json", "directions.json",
        "camera_positions.csv", "edges.csv", "constraints.json"}) {
    inputs.push_back(site.survey() / name);
  }
  return inputs;
}

// ---- undistort, light, convert, render -----------------------------------------------------

// A lens that the reconstruction adjusted goes before the calibrated one.
Paths UndistortionInputs(const MontageRequest& request) {
  Paths inputs = CalibratedCameras(request);
  inputs += {request.site.adjusted_camera().parent_path(), request.site.photos(),
             request.site.description()};
  return inputs;
}

// The description of the light names the input images with their cameras; what stands in front is
// no sky.
Paths LightInputs(const MontageRequest& request) {
  const SitePaths& site = request.site;
  Paths inputs = {site.scene(),
                  site.photos(),
                  site.description(),
                  site.survey() / "samples.json",
                  site.survey() / "materials.json",
                  site.survey() / "foreground"};
  inputs += LibraryFolders(site);
  for (const std::string& camera : CamerasOf(ListCameraFolders(site))) {
    inputs.push_back(site.pinhole_camera(camera));
  }
  return inputs;
}

// The survey and the scene tell where the site is, which the building is checked against.
Paths ConversionInputs(const MontageRequest& request) {
  const SitePaths& site = request.site;
  Paths inputs = {site.building(), site.survey() / "control_points.csv", site.scene()};
  return inputs += LibraryFolders(site);
}

Paths Building(const MontageRequest& request) {
  if (!request.with_building) return {};
  return {request.site.artificial(), request.site.artificial().replace_extension(".bin")};
}

// Of polygons, and what names them. A faulty survey is told by the stage that reads it first.
Paths Masks(const SitePaths& site) {
  Paths masks = {site.survey() / "polygons.json"};
  try {
    for (const auto& [polygon, file] : PolygonMasks(site)) masks.push_back(site.survey() / file);
  } catch (const InputError&) {
    return masks;
  }
  return masks;
}

Paths RenderInputs(const MontageRequest& request) {
  const SitePaths& site = request.site;
  Paths inputs = {site.environment(), site.input_image("").parent_path(), site.photos(),
                  site.survey() / "foreground", site.survey() / "shadows"};
  for (const fs::path& mask : Masks(site)) inputs.push_back(mask);
  if (!site.hour.empty()) inputs.push_back(site.hours() / site.hour);
  if (request.with_building) inputs.push_back(site.building());  // textures
  return inputs += Building(request);
}

Paths Montages(const MontageRequest& request) {
  Paths montages;
  for (const fs::path& photo : ListPhotographs(request.site)) {
    for (const char* ending : {".exr", ".png", ".jpg", ".tif", ".layers.exr", ".shadows.exr",
                               ".unseen.exr", ".parts.exr", ".uncertainty.csv"}) {
      montages.push_back(request.site.montage(photo.stem().string()) += ending);
    }
  }
  return montages;
}

Paths LightReports(const MontageRequest& request) { return {LightReportPath(request.site)}; }

Paths LightResults(const MontageRequest& request) {
  return {request.site.environment(), LightReportPath(request.site), LightPagePath(request.site)};
}

std::vector<MontageStage> MakeStages() {
  const auto one = [](fs::path (SitePaths::*path)() const) {
    return [path](const MontageRequest& request) { return Paths{(request.site.*path)()}; };
  };
  return {
      {"calibrate", {}, CalibrationInputs, CalibrationResults, CalibrationReports, Always},
      {"tie-points",
       {"calibrate"},
       TiePointInputs,
       one(&SitePaths::tie_points),
       NoReports,
       NeedsMatching},
      {"reconstruct",
       {"calibrate", "tie-points"},
       ReconstructionInputs,
       [](const MontageRequest& request) { return Paths{request.site.scene().parent_path()}; },
       one(&SitePaths::residual_report),
       Always},
      {"undistort",
       {"reconstruct"},
       UndistortionInputs,
       [](const MontageRequest& request) {
         return Paths{request.site.input_image("").parent_path()};
       },
       NoReports,
       Always},
      {"light", {"reconstruct", "undistort"}, LightInputs, LightResults, LightReports, Always},
      {"convert",
       {"reconstruct"},
       ConversionInputs,
       Building,
       NoReports,
       [](const MontageRequest& request) { return request.with_building; },
       true},
      {"render",
       {"undistort", "light", "convert"},
       RenderInputs,
       Montages,
       NoReports,
       Always,
       true,
       true},
  };
}

}  // namespace

const std::vector<MontageStage>& MontageStages() {
  static const std::vector<MontageStage> stages = MakeStages();
  return stages;
}

SitePaths RecordsOf(const MontageStage& stage, const MontageRequest& request) {
  return stage.is_of_design ? request.site : SitePaths{request.site.root};
}

std::string RecordNameOf(const MontageStage& stage, const MontageRequest& request) {
  return stage.makes_pictures ? request.site.result_name(stage.name) : stage.name;
}

size_t StageNamed(const std::string& name) {
  const std::vector<MontageStage>& stages = MontageStages();
  const auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const MontageStage& stage) { return stage.name == name; });
  if (found != stages.end()) return static_cast<size_t>(found - stages.begin());
  std::string names;
  for (const MontageStage& stage : stages) names += (names.empty() ? "" : ", ") + stage.name;
  throw InputError(name, "is no stage, expected one of " + names);
}

}  // namespace insitu
