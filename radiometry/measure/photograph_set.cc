// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/photograph_set.h"

#include <algorithm>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {
namespace {

void Multiply(const Eigen::Vector3f& factor, Raster* picture) {
  for (size_t i = 0; i < picture->data.size(); ++i) {
    picture->data[i] *= factor[static_cast<int>(i % 3)];
  }
}

}  // namespace

PhotographSet::PhotographSet(std::vector<std::filesystem::path> files, size_t most_bytes)
    : most_bytes_(most_bytes) {
  for (std::filesystem::path& file : files) {
    const Eigen::Vector2i size = ReadPhotographSize(file);
    Entry entry;
    entry.file = std::move(file);
    entry.bytes = 3 * sizeof(float) * static_cast<size_t>(size.x()) * static_cast<size_t>(size.y());
    photos_.push_back(std::move(entry));
  }
}

PhotographSet::PhotographSet(const std::vector<Photograph>& photos) : is_callers_(true) {
  for (const Photograph& photo : photos) {
    Entry entry;
    entry.photo = {std::shared_ptr<const Photograph>(), &photo};
    photos_.push_back(std::move(entry));
  }
}

// Lets those go that were not used for longest.
void PhotographSet::MakeRoom(size_t index) const {
  size_t held = photos_[index].bytes;
  for (const Entry& entry : photos_) held += entry.photo ? entry.bytes : 0;
  while (held > most_bytes_) {
    Entry* oldest = nullptr;
    for (Entry& entry : photos_) {
      if (entry.photo && (!oldest || entry.last_use < oldest->last_use)) oldest = &entry;
    }
    if (!oldest) return;
    oldest->photo = nullptr;
    held -= oldest->bytes;
  }
}

std::shared_ptr<const Photograph> PhotographSet::operator[](size_t index) const {
  Entry& entry = photos_.at(index);
  entry.last_use = ++uses_;
  if (entry.photo) return entry.photo;
  MakeRoom(index);
  auto photo = std::make_shared<Photograph>(ReadPhotograph(entry.file));
  if (entry.factor != Eigen::Vector3f::Ones()) Multiply(entry.factor, &photo->linear);
  entry.photo = std::move(photo);
  return entry.photo;
}

bool PhotographSet::IsAllHeld() const {
  size_t bytes = 0;
  for (const Entry& entry : photos_) bytes += entry.bytes;
  return bytes <= most_bytes_;
}

void PhotographSet::SetFactor(size_t index, const Eigen::Vector3f& factor) {
  INSITU_CHECK(!is_callers_);
  Entry& entry = photos_.at(index);
  entry.factor = factor;
  entry.photo = nullptr;
}

}  // namespace insitu
