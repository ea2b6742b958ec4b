// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/left_out_reasons.h"

namespace insitu {

Sentence ReasonOfPhoto(size_t known, bool can_resect) {
  if (known == 0) return Sentence("photoThree", "needs three control points");
  if (known == 1) return Sentence("photoTwo", "needs two more control points");
  if (known == 2) return Sentence("photoOne", "needs one more control point");
  const int count = static_cast<int>(known);
  if (!can_resect) {
    return Sentence("photoOnLine",
                    "its {count} known points lie on one line, one more well beside it",
                    {{"count", count}});
  }
  return Sentence("photoNoPlace",
                  "no place of the camera explains its {count} known points: is one marked in the "
                  "wrong place or under the wrong name?",
                  {{"count", count}});
}

Sentence ReasonOfPoint(size_t rays, const std::set<std::string>& photos) {
  if (rays == 1) return Sentence("pointOneRay", "one ray, needs a second photograph");
  if (rays > 1) {
    return Sentence("pointHardlyMeets",
                    "its rays hardly meet, needs a photograph from another side");
  }
  if (photos.empty()) return Sentence("pointNoRay", "no ray, needs two photographs");
  if (photos.size() == 1) {
    return Sentence("pointPhotoOut", "one ray, and its photo {photo} is not placed",
                    {{"photo", *photos.begin()}});
  }
  return Sentence("pointPhotosOut", "none of its {count} photos is placed",
                  {{"count", static_cast<int>(photos.size())}});
}

Sentence NoVertex(const std::string& name) {
  return Sentence("noVertex", "its vertex {name} is not determined", {{"name", name}});
}

Sentence NoPoint(const std::string& name) {
  return Sentence("noPoint", "its point {name} is not determined", {{"name", name}});
}

Sentence NoEnd(const std::string& name) {
  return Sentence("noEnd", "its end {name} is not determined", {{"name", name}});
}

Sentence NoPolygon(const std::string& name) {
  return Sentence("noPolygon", "its polygon {name} is not determined", {{"name", name}});
}

}  // namespace insitu
