// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/demo_site.h"

#include <cstdio>
#include <sstream>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "datasets_synthetic/board_photos.h"
#include "datasets_synthetic/bounced_light.h"
#include "datasets_synthetic/building_writer.h"
#include "datasets_synthetic/campus.h"
#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/forward_model.h"
#include "datasets_synthetic/pavilion.h"
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
                 DemoSiteSummary& summary) {
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

void WriteSurvey(const fs::path& folder, const Place& place, const FieldSurvey& survey,
                 const std::vector<RenderedView>& renderings, DemoSiteSummary& summary) {
  const Campus& campus = *place.campus;
  const ChosenSamples samples = ChooseSamples(renderings);
  WriteMeasurements(folder, campus, survey, {});
  WritePolygons(folder / "polygons.json", campus, BestViews(campus.natural, renderings));
  WriteDirections(folder / "directions.json", survey);
  WriteSamples(folder / "samples.json", campus, samples, place.daylight);
  WriteNaturalMaterials(folder / "materials.json", campus);
  summary.polygons = static_cast<int>(campus.natural.faces.size());
  summary.horizon_samples = static_cast<int>(samples.horizon.size());
  summary.haze_samples = static_cast<int>(samples.haze.size());
  summary.daylight_samples = static_cast<int>(samples.daylight.size());
}

void CountPoints(const FieldSurvey& survey, DemoSiteSummary& summary) {
  for (const SurveyPoint& point : survey.points) {
    summary.control_points += point.role == PointRole::kControl;
    summary.check_points += point.role == PointRole::kCheck;
    summary.observations += static_cast<int>(point.marks.size());
  }
  summary.sun_pairs = static_cast<int>(survey.sun_pairs.size());
  summary.zenith_pairs = static_cast<int>(survey.zenith_pairs.size());
}

}  // namespace

std::string DemoSiteSummary::BriefReport() const {
  std::ostringstream report;
  report << photos << " photographs, " << board_photos << " board photographs, " << polygons
         << " polygons\n"
         << control_points << " control and " << check_points << " check points, " << observations
         << " marks, " << sun_pairs << " sun and " << zenith_pairs << " zenith pairs\n"
         << "samples: " << horizon_samples << " horizon, " << haze_samples << " haze, "
         << daylight_samples << " daylight\n";
  return report.str();
}

DemoSiteSummary MakeDemoSite(const fs::path& folder, const DemoSiteOptions& options) {
  const auto step_done = [&options] {
    if (options.step_done) options.step_done();
  };
  const Campus campus = MakeCampus(options.width, options.height);
  const Pavilion pavilion = MakePavilion(campus.azimuth);
  const Place place{&campus, PavilionScene(pavilion), ClearMorning()};
  const BouncedLight light(place);
  DemoSiteSummary summary;
  std::vector<RenderedView> renderings;
  for (const View& view : campus.views) {
    renderings.push_back(RenderView(light, view, {options.strata}));
    WriteTruthImages(folder / "truth", view, renderings.back());
    WriteJpeg(folder / "photos" / (view.photo + ".jpg"), renderings.back().before,
              LinearTruth(folder, view));
    ++summary.photos;
    step_done();
  }
  if (options.with_boards) {
    const View& view = campus.views[0];
    WriteBoards(folder / "calibration", view.lens, LinearTruth(folder, view), summary);
  }
  step_done();
  const FieldSurvey survey = SurveyCampus(campus);
  CountPoints(survey, summary);
  WriteSurvey(folder / "survey", place, survey, renderings, summary);
  WriteSiteDescription(folder / "site.json", campus);
  WriteDxf(folder / "building/building.dxf", pavilion, campus.origin);
  WriteBuildingMaterials(folder / "building/materials.json", place.daylight);
  WriteTruth(folder / "truth/truth.json", campus, survey, place.daylight);
  step_done();
  return summary;
}

}  // namespace insitu::demo
