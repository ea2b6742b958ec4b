// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "calibration/program/site.h"
#include "reconstruction/exchange/export_survey.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/survey/read_survey.h"

namespace {

using insitu::InputError;

struct Request {
  insitu::SitePaths site;
  std::string format, crs;
  std::filesystem::path out;
};

insitu::SurveyExport Exported(const Request& request, const insitu::Survey& survey,
                              const std::vector<std::filesystem::path>& photographs) {
  if (request.format == "odm") {
    if (request.crs.empty()) {
      throw InputError("--crs",
                       "is missing: OpenDroneMap needs the coordinate system of the survey");
    }
    return insitu::ExportOdm(survey, photographs, request.crs, request.out);
  }
  const insitu::SitePhotos photos = insitu::ReadSitePhotos(request.site);
  return insitu::ExportDbat(survey, photos.cameras, photos.paths, request.out);
}

insitu::SurveyExport Export(const Request& request) {
  const std::vector<std::filesystem::path> photographs = insitu::ListPhotographs(request.site);
  std::vector<std::string> names;
  for (const auto& photograph : photographs) names.push_back(photograph.stem().string());
  const insitu::Survey survey = insitu::ReadSurvey(request.site, names);
  insitu::SurveyExport done = Exported(request, survey, photographs);
  for (const insitu::LoneMark& lone : survey.lone_marks) {
    done.report.push_back("left out: point '" + lone.mark.point + "', marked on photo '" +
                          lone.mark.photo + "' alone" + lone.question.text());
  }
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  insitu::ProgramOptions program(
      "Writes a site's control points and marks for another program, so that anyone can check the "
      "adjustment: tables and script of DBAT, or gcp_list.txt of OpenDroneMap. Results for COLMAP: "
      "insitu-reconstruct --colmap-model.",
      "insitu-export-survey");
  program.Site(&request.site);
  program.Value("--format", &request.format, "dbat or odm",
                {.is_required = true, .one_of = {"dbat", "odm"}});
  program.Value("--out", &request.out, "folder to write to", {.is_required = true});
  program.Value("--crs", &request.crs, "coordinate system of the survey, for odm: EPSG:2056");
  program.Footer("Example:\n  insitu-export-survey sites/mill --format dbat --out /tmp/mill_dbat");
  return insitu::RunProgram(program, argc, argv, [&] {
    const insitu::SurveyExport done = Export(request);
    for (const auto& path : done.written) std::cout << "written: " << path.string() << "\n";
    for (const std::string& line : done.report) std::cout << line << "\n";
  });
}
