// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/hours/relight_site.h"

#include <algorithm>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"
#include "radiometry/light/simulated_daylight.h"
#include "radiometry/light_report.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "renderer/hours/relit_image.h"

namespace insitu {
namespace {

std::string StatementFor(const SiteHour& hour, double aerosol_depth) {
  return "simulated daylight, not the photograph's: " + hour.told + ", sun at azimuth " +
         Number("%.1f", hour.position.azimuth / kDegree) + " deg, elevation " +
         Number("%.1f", hour.position.elevation / kDegree) +
         " deg; sun and sky measured in the photographs are scaled as a cloudless sky's (Bird, "
         "Riordan 1986; aerosol depth " +
         Number("%.2f", aerosol_depth) +
         "), surfaces are relit by polygons alone, shadows of what no polygon stands for stay";
}

// What linear values are multiplied by to come into the site's unit, or back.
Raster Times(Raster image, const Eigen::Vector3d& factor) {
  const Eigen::Vector3f by = factor.cast<float>();
  if (factor == Eigen::Vector3d::Ones()) return image;
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] *= by[i % 3];
  return image;
}

class SiteRelighting {
 public:
  SiteRelighting(const SitePaths& site, const NaturalEnvironment& measured,
                 const SimulatedDaylight& simulated)
      : site_(site),
        measured_(measured),
        gains_(ReadPhotoGains(site)),
        relighting_(measured, simulated),
        simulated_(simulated) {}

  // `camera` saw `source`; one of the site's photographs, with its lens or without.
  void Write(size_t photo, const Camera& camera, const std::filesystem::path& source,
             const std::filesystem::path& target) const {
    RequirePhotographSize(source, camera.width(), camera.height());
    PosedCamera posed = measured_.scene.cameras[photo];
    posed.camera = camera;
    const Eigen::Vector3d& gain = gains_[photo];
    const Raster in_unit = Times(ReadPhotograph(source).linear, gain.cwiseInverse());
    WriteExr(target, Times(relighting_.Relit(posed, in_unit), gain));
  }

  // The measured one's file with another light, air and images; the standard deviations of what was
  // measured are not those of what is simulated.
  void WriteEnvironmentOf(const SitePaths& at_hour, const Json::Value& simulation) const {
    NaturalEnvironment environment = measured_;
    environment.light = simulated_.light;
    environment.air = relighting_.air();
    for (size_t i = 0; i < environment.input_images.size(); ++i) {
      environment.input_images[i].file =
          at_hour.relit_input_image(environment.scene.cameras[i].photo);
    }
    const Json::Value described = DescriptionOf(environment, at_hour.environment());
    Json::Value json = ReadJson(site_.environment());
    json["light"] = described["light"];
    json["air"] = described["air"];
    for (Json::ArrayIndex i = 0; i < json["scene"]["cameras"].size(); ++i) {
      json["scene"]["cameras"][i]["input_image"] = described["scene"]["cameras"][i]["input_image"];
    }
    json["simulation"] = simulation;
    WriteJson(at_hour.environment(), json);
  }

 private:
  const SitePaths& site_;
  const NaturalEnvironment& measured_;
  const std::vector<Eigen::Vector3d> gains_;
  const Relighting relighting_;
  const SimulatedDaylight& simulated_;
};

Json::Value SimulationJson(const RelitSite& relit, const SimulatedDaylight& simulated,
                           const SpectralBins& bins) {
  Json::Value json;
  json["statement"] = relit.statement;
  json["hour"] = relit.hour.told;
  json["sun_azimuth_deg"] = relit.hour.position.azimuth / kDegree;
  json["sun_elevation_deg"] = relit.hour.position.elevation / kDegree;
  json["aerosol_depth"] = simulated.aerosol_depth;
  json["sun_ratio"] = BinsJson(simulated.sun_ratio, bins);
  json["sky_ratio"] = BinsJson(simulated.sky_ratio, bins);
  json["remarks"] = Json::Value(Json::arrayValue);
  for (const std::string& remark : relit.hour.remarks) json["remarks"].append(remark);
  return json;
}

}  // namespace

RelitSite RelightSite(const SitePaths& site, const HourRequest& request) {
  INSITU_CHECK(site.hour.empty());
  const NaturalEnvironment measured = ReadEnvironment(site);
  RelitSite relit;
  relit.hour = SiteHourAt(site, measured, request);
  const SpectralBins& bins = measured.spectra.bins();
  const auto simulated =
      DaylightUnder(measured.light, relit.hour.sun, measured.scene.origin.z(), bins);
  if (!simulated) {
    throw InputError(site.environment(),
                     "the measured sun is too low or dark for the light of another hour to be "
                     "scaled from it");
  }
  relit.aerosol_depth = simulated->aerosol_depth;
  relit.statement = StatementFor(relit.hour, simulated->aerosol_depth);
  SitePaths at_hour = site;
  at_hour.hour = relit.hour.name;
  std::filesystem::remove(at_hour.environment());  // until all is written, nothing is to be trusted
  const SiteRelighting relighting(site, measured, *simulated);
  const std::vector<std::filesystem::path> photographs = ListPhotographs(site);
  Progress progress("relighting", static_cast<int>(2 * measured.scene.cameras.size()));
  for (size_t i = 0; i < measured.scene.cameras.size(); ++i) {
    const std::string& photo = measured.scene.cameras[i].photo;
    const InputImage& image = measured.input_images[i];
    relighting.Write(i, image.camera, image.file, at_hour.relit_input_image(photo));
    progress.Step();
    const auto file = std::find_if(photographs.begin(), photographs.end(),
                                   [&](const auto& path) { return path.stem() == photo; });
    if (file == photographs.end()) {
      throw InputError(site.photos(), "lacks the photograph " + photo + ", which " +
                                          site.environment().string() + " names");
    }
    relighting.Write(i, measured.scene.cameras[i].camera, *file, at_hour.relit_photo(photo));
    progress.Step();
    ++relit.photos;
  }
  relighting.WriteEnvironmentOf(at_hour, SimulationJson(relit, *simulated, bins));
  return relit;
}

}  // namespace insitu
