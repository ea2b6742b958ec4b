// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/commands/commands.h"

#include <unistd.h>

#include "calibration/files/error.h"

namespace insitu {

namespace fs = std::filesystem;

const std::vector<Command>& StageCommands() {
  static const std::vector<Command> commands = {
      {"calibrate", "the interior orientation of the cameras"},
      {"tie-points", "points that several photographs share, by COLMAP, where control is missing"},
      {"reconstruct",
       "where the photographs were taken from, polygons, sun and zenith, with a report"},
      {"undistort", "the input images: linear light without lens distortion"},
      {"light", "haze and daylight, measured in the photographs"},
      {"convert", "the planned building, from the architect's models"},
      {"render", "the building in the photographs"}};
  return commands;
}

const std::vector<Command>& OtherCommands() {
  static const std::vector<Command> commands = {
      {"montage", "all of these, as far as their results do not hold any more"},
      {"prepare", "the measuring page: everything in survey/, measured on the photographs"},
      {"new", "a site's folder from photographs, with files that explain themselves"},
      {"matte", "what stands in front, from a rough drawing"},
      {"materials", "the library of materials and lamps: its list, swatches, proposals"},
      {"batch", "views, variants, hours and qualities by a plan, here or by Slurm"},
      {"relight", "photographs and daylight of another hour, simulated"},
      {"spectra", "the spectra that stand behind colours, in a page"},
      {"view", "the viewing page: before and after, pixel by pixel; renders as they run"},
      {"import-survey", "control points and marks of other programs for a site"},
      {"export-survey", "those of a site for other programs"},
      {"demo-site", "a site whose truth is known, to try all this on"}};
  return commands;
}

fs::path OwnFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path FindProgram(const fs::path& folder, const std::string& name) {
  const fs::path program = folder / ("insitu-" + name);
  if (access(program.c_str(), X_OK) != 0) {
    throw InputError(program, "cannot be run; install insitu again, or build it by scripts/setup");
  }
  return program;
}

}  // namespace insitu
