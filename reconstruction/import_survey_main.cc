// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "reconstruction/exchange/import_survey.h"

namespace {

void AddOptions(insitu::ProgramOptions* program, insitu::SurveyImportOptions* options) {
  program->Value("--sigma-m", &options->sigma_m, "of points whose file states no accuracy [m]",
                 {.check = insitu::OptionCheck::kPositive});
  program->Value("--mark-sigma-px", &options->mark_sigma_px,
                 "of marks whose file states no accuracy [px]",
                 {.check = insitu::OptionCheck::kPositive});
  program->Value("--file-crs", &options->file_crs,
                 "coordinate system of files that name none, e.g. EPSG:2056");
  program->Value("--crs", &options->crs,
                 "coordinate system to convert to; default: as read, or the UTM zone of degrees");
  program->Value(
      "--unit", &options->reading.unit,
      "of lengths whose columns state none: m, mm, cm, \"US survey feet\", \"international feet\"");
  program->Value("--check", &options->check_points, "points to keep out of the adjustment");
  program->Flag("--keep-unsurveyed", &options->keeps_unsurveyed,
                "keep marks of points without coordinates, for vertices of polygons");
  program->Flag("--replace", &options->may_replace, "replace survey files that are there already");
}

std::map<std::string, std::string> Pairs(const char* option, const std::vector<std::string>& texts,
                                         const std::string& expected) {
  std::map<std::string, std::string> pairs;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw insitu::InputError(option, "\"" + text + "\", expected " + expected);
    pairs[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return pairs;
}

}  // namespace

int main(int argc, char** argv) {
  insitu::SitePaths site;
  std::vector<std::filesystem::path> files;
  std::vector<std::string> photos, columns;
  insitu::SurveyImportOptions options;
  insitu::ProgramOptions program(
      "Reads control points and marks as other programs write them (OpenDroneMap, OpenSfM, Pix4D, "
      "Metashape, MicMac, DBAT, AICON, JAG3D, COLMAP, tables with a header), each recognised by "
      "its content, and writes survey/control_points.csv and observations.csv.",
      "insitu-import-survey");
  program.Site(&site);
  program.Value("FILE", &files, "files to read and merge",
                {.is_required = true, .check = insitu::OptionCheck::kFile});
  program.Value("--photo", &photos, "NAME=SITE_PHOTO: a photo that the files name otherwise");
  program.Value("--column", &columns,
                "QUANTITY=TITLE: which column of a table is meant; name, photo, east, north, "
                "height, sigma_east, "
                "sigma_north, sigma_height, sigma_plan, sigma, role");
  AddOptions(&program, &options);
  program.Footer(
      "Example:\n  insitu-import-survey sites/mill points.csv gcp_list.txt --sigma-m 0.02 "
      "--mark-sigma-px 0.5");
  return insitu::RunProgram(program, argc, argv, [&] {
    options.photo_names = Pairs("--photo", photos, "NAME=SITE_PHOTO");
    options.reading.columns = Pairs("--column", columns, "QUANTITY=TITLE");
    for (const std::string& line : insitu::ImportSurveyInto(site, files, options).report) {
      std::cout << line << "\n";
    }
  });
}
