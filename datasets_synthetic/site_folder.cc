// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/site_folder.h"

#include <cstdio>
#include <iomanip>
#include <sstream>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "datasets_synthetic/board_photos.h"
#include "datasets_synthetic/bounced_light.h"
#include "datasets_synthetic/building_writer.h"
#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/forward_model.h"
#include "datasets_synthetic/sample_choice.h"
#include "datasets_synthetic/survey_writer.h"
#include "datasets_synthetic/truth_writer.h"

namespace insitu::demo {
namespace {

namespace fs = std::filesystem;

// A linear image that has no EXIF to hand on: our photographs carry none.
fs::path LinearTruth(const fs::path& folder, const View& view) {
  return folder / "truth" / ("before_" + view.photo + ".exr");
}

void WriteBoards(const fs::path& folder, const Lens& lens, const fs::path& metadata_source,
                 SiteSummary& summary) {
  for (const Raster& photo : BoardPhotos(lens)) {
    char name[32];
    std::snprintf(name, sizeof name, "board_%02d.jpg", ++summary.board_photos);
    WriteJpeg(folder / name, photo, metadata_source);
  }
  std::ostringstream board;
  board << "type chessboard\ninterior_corners_x " << kBoardCorners << "\ninterior_corners_y "
        << kBoardCorners << "\nsquare_m " << kBoardSquare
        << "\nnote flat; same camera and focus as the site photographs\n";
  WriteWhole(folder / "board.txt", board.str());
}

// As mrcal writes a lens.
void WriteCameraFile(const fs::path& path, const Lens& lens) {
  std::ostringstream text;
  text << std::setprecision(17) << "{\n    'lensmodel':  'LENSMODEL_OPENCV8',\n"
       << "    'intrinsics': [ " << lens.focal_x << ", " << lens.focal_y << ", " << lens.center_x
       << ", " << lens.center_y;
  for (const double coefficient : lens.distortion) text << ", " << coefficient;
  text << " ],\n    'extrinsics': [ 0, 0, 0, 0, 0, 0 ],\n    'imagersize': [ " << lens.width << ", "
       << lens.height << " ],\n}\n";
  WriteWhole(path, text.str());
}

void WriteSurvey(const fs::path& folder, const Place& place, const FieldSurvey& survey,
                 const std::vector<RenderedView>& renderings, SiteSummary& summary) {
  const Site& site = *place.site;
  const ChosenSamples samples = ChooseSamples(site.survey, renderings);
  ChosenSamples printed = samples;
  printed.haze = samples.mirrored;
  WriteMeasurements(folder, site, survey, {});
  WritePolygons(folder / "polygons.json", site, BestViews(site.natural, renderings));
  WriteDirections(folder / "directions.json", survey);
  WriteSamples(folder / "samples.json", site, samples, place.daylight);
  if (!printed.haze.empty()) {
    WriteSamples(folder / "samples_paper.json", site, printed, place.daylight);
  }
  WriteNaturalMaterials(folder / "materials.json", site);
  summary.polygons = static_cast<int>(site.natural.faces.size());
  summary.horizon_samples = static_cast<int>(samples.horizon.size());
  summary.haze_samples = static_cast<int>(samples.haze.size());
  summary.daylight_samples = static_cast<int>(samples.daylight.size());
}

void CountPoints(const FieldSurvey& survey, SiteSummary& summary) {
  for (const SurveyPoint& point : survey.points) {
    summary.control_points += point.role == PointRole::kControl;
    summary.check_points += point.role == PointRole::kCheck;
    summary.observations += static_cast<int>(point.marks.size());
  }
  summary.sun_pairs = static_cast<int>(survey.sun_pairs.size());
  summary.zenith_pairs = static_cast<int>(survey.zenith_pairs.size());
}

}  // namespace

std::string SiteSummary::BriefReport() const {
  std::ostringstream report;
  report << photos << " photographs, " << board_photos << " board photographs, " << polygons
         << " polygons\n"
         << control_points << " control and " << check_points << " check points, " << observations
         << " marks, " << sun_pairs << " sun and " << zenith_pairs << " zenith pairs\n"
         << "samples: " << horizon_samples << " horizon, " << haze_samples << " haze, "
         << daylight_samples << " daylight\n";
  return report.str();
}

SiteSummary WriteSite(const fs::path& folder, const SiteDescription& description,
                      const SiteOptions& options) {
  const auto step_done = [&options] {
    if (options.step_done) options.step_done();
  };
  const Site& site = description.site;
  const Place place{&site, BuildingScene(description.building), description.daylight};
  BouncedLightOptions bounces;
  bounces.keep_cells_wide = options.is_example;
  const BouncedLight light(place, bounces);
  SiteSummary summary;
  std::vector<RenderedView> renderings;
  for (const View& view : site.views) {
    renderings.push_back(RenderView(light, view, {options.strata, options.is_example}));
    WriteTruthImages(folder / "truth", view, renderings.back());
    WriteJpeg(folder / "photos" / (view.photo + ".jpg"), renderings.back().before,
              LinearTruth(folder, view));
    ++summary.photos;
    step_done();
  }
  if (options.with_boards) {
    const View& view = site.views[0];
    WriteBoards(folder / "calibration", view.lens, LinearTruth(folder, view), summary);
  } else {
    WriteCameraFile(folder / "calibration/camera.cameramodel", site.views[0].lens);
  }
  step_done();
  const FieldSurvey survey = SurveySite(site);
  CountPoints(survey, summary);
  WriteSurvey(folder / "survey", place, survey, renderings, summary);
  WriteSiteDescription(folder / "site.json", site);
  WriteDxf(folder / "building/building.dxf", description.building, site.origin);
  WriteBuildingMaterials(folder / "building/materials.json", description.building, place.daylight);
  WriteTruth(folder / "truth/truth.json", site, survey, place.daylight);
  step_done();
  return summary;
}

}  // namespace insitu::demo
