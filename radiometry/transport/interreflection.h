// SPDX-License-Identifier: GPL-3.0-or-later
// Light that surfaces send each other, before and after a building is put among them. What the
// photographs show of a natural surface is its radiance with all interreflection before, so
//
//   E_before = sun + sky + (photographed radiance of what is around),   rho = L_0 / E_before,
//   E_after  = the same with the planned building, its radiance and the natural surfaces' changes,
//   L_after  = rho E_after,
//
// and what changes is in one balance: blocked sun, sky and surroundings, light of the building and
// of what it lights. Stands where the paper has one ambient light for all, [Durisch92, Eq. (4)].
#pragma once

#include <optional>
#include <vector>

#include "radiometry/light/daylight.h"
#include "radiometry/transport/cosine_directions.h"
#include "radiometry/transport/solved_light.h"
#include "radiometry/transport/surroundings.h"

namespace insitu {

struct InterreflectionOptions {
  std::optional<int> bounces = {};  // at most; nullopt: until they change nothing. 0: the sky alone
  int patch_directions = 256;       // gathered at a piece
  int point_directions = 512;       // gathered at a point that is asked for

  void Check() const;  // throws CheckError that names the field that is wrong
};

// Irradiance at a point, the sun's own and the lamps' own left out.
struct GatheredLight {
  Spectrum sky_before = Spectrum::Zero();  // as if the planned building did not stand
  Spectrum surroundings_before = Spectrum::Zero();
  Spectrum change = Spectrum::Zero();  // what the building adds and takes; exactly zero without any
  double sky = 0;                      // projected solid angle of the sky before [sr], at most pi
  // Mean radiance of the sky that is seen before, over the open sky's; 1 if that is uniform.
  Spectrum relative_sky = Spectrum::Ones();
  double unseen = 0;    // of what no photograph shows, before [sr]
  double inside = 0;    // share of directions that end on the back of a face: 1 within a solid
  double nearness = 0;  // mean of 1 / distance over all directions, the sky's 0 [1/m]
};

// The same by origin: sky + surroundings is before + change, bounced - the blocked ones the change.
struct GatheredParts {
  Spectrum sky = Spectrum::Zero();           // that arrives after
  Spectrum surroundings = Spectrum::Zero();  // of site and planned faces, after
  Spectrum sky_blocked = Spectrum::Zero();   // what the planned faces keep away, >= 0
  Spectrum surroundings_blocked = Spectrum::Zero();
  // What the planned faces send, and what the other surfaces send more or, in shadow, less.
  Spectrum bounced = Spectrum::Zero();

  void Add(double weight, const GatheredParts& parts);
};

class Interreflection {
 public:
  // Finds the pieces and what they see. `scene` must outlive it; `grid` is fine where light is
  // wanted: about the planned building, or about the samples.
  Interreflection(const TransportScene& scene, const Daylight& light, const PatchGrid& grid,
                  const InterreflectionOptions& options = {});

  // The same as it was once solved: by Solution() of one with the same scene, light, grid, options.
  Interreflection(const TransportScene& scene, const Daylight& light, const PatchGrid& grid,
                  const SolvedLight& solved, const InterreflectionOptions& options = {});
  SolvedLight Solution() const;

  // The radiance of every piece under a daylight of the geometry and of the sky's shape given at
  // first; its sky_radiance is the open sky's. What no photograph
  // shows reflects as the mean of its material does, or of the whole site.
  void Solve(const Daylight& light);

  // Thread-safe once solved. What a point meets does not change with the daylight.
  GatheredLight At(const SurfacePoint& surface) const { return Gathered(Meet(surface)); }
  std::vector<Meeting> Meet(const SurfacePoint& surface) const;
  GatheredLight Gathered(const std::vector<Meeting>& meetings) const;
  GatheredParts PartsAt(const SurfacePoint& surface) const;

  // Diffuse reflection of a polygon where no photograph shows it [1/sr].
  const Spectrum& MeanBrdf(int polygon) const { return brdf_of_polygon_[polygon]; }

  int patches() const { return static_cast<int>(surroundings_.patches().all().size()); }

 private:
  // What both public ones begin with.
  Interreflection(const TransportScene& scene, const Daylight& light, Patches patches,
                  const InterreflectionOptions& options);

  // What is met from a piece before: the sums of photographed radiances and of the sky's, how often
  // ground beyond, and which pieces no photograph shows.
  struct SeenFromPiece {
    Spectrum photographed = Spectrum::Zero(), sky = Spectrum::Zero();  // sky: relative radiance
    int beyond = 0;
    std::vector<int> unseen;
  };

  const std::vector<Patch>& Pieces() const { return surroundings_.patches().all(); }
  void GatherMeetings();
  void SumSeen();
  Spectrum GatheredBefore(size_t piece) const;
  void SolveBefore(const Daylight& light);
  void SetBrdfs(const std::vector<Spectrum>& irradiance);
  void SetBeyond();
  void SolveAfter(const Daylight& light);
  bool IsUnseen(int patch) const;  // by photographs; false where the sky alone counts
  bool IsDirect() const { return options_.bounces == 0; }
  Spectrum RadianceBefore(int patch) const;
  Spectrum RadianceAfter(const Meeting& meeting) const;
  Spectrum ChangeAlong(const Meeting& meeting) const;
  bool SweepPlanned(const Daylight& light);
  void SweepNatural(const Daylight& light);

  const TransportScene& scene_;
  InterreflectionOptions options_;
  CosineDirections patch_directions_, point_directions_;
  Surroundings surroundings_;
  std::vector<std::vector<Meeting>> meetings_;  // of each piece
  std::vector<SeenFromPiece> seen_;             // of each natural piece

  Spectrum sky_ = Spectrum::Zero(), beyond_ = Spectrum::Zero();  // radiances
  std::vector<Spectrum> before_;                                 // radiance of each natural piece
  std::vector<Spectrum> brdf_;                                   // of each natural piece [1/sr]
  std::vector<Spectrum> change_;      // of the radiance of each natural piece
  std::vector<Spectrum> irradiance_;  // of each planned piece
  std::vector<Spectrum> brdf_of_polygon_;
};

}  // namespace insitu
