// SPDX-License-Identifier: GPL-3.0-or-later
// The photographs of a site, however many: those used last are held, others read again when they
// are asked for.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <vector>

#include "calibration/photo/photograph.h"

namespace insitu {

class PhotographSet {
 public:
  // Holds up to `most_bytes` of linear light, at least one photograph.
  explicit PhotographSet(std::vector<std::filesystem::path> files, size_t most_bytes = 1500000000);
  // Those of the caller, which must outlive it.
  PhotographSet(const std::vector<Photograph>& photos);  // NOLINT(google-explicit-constructor)

  size_t size() const { return photos_.size(); }
  // Never null. Throws InputError as ReadPhotograph does. From one thread at a time.
  std::shared_ptr<const Photograph> operator[](size_t index) const;
  // Whether all are held once each has been asked for.
  bool IsAllHeld() const;

  // From now on the linear light of a photograph counts times this, by channel. Of one that was
  // read from its file.
  void SetFactor(size_t index, const Eigen::Vector3f& factor);

 private:
  struct Entry {
    std::filesystem::path file;
    Eigen::Vector3f factor = Eigen::Vector3f::Ones();
    size_t bytes = 0;  // of its linear light
    std::shared_ptr<const Photograph> photo = {};
    unsigned long last_use = 0;
  };
  void MakeRoom(size_t index) const;

  mutable std::vector<Entry> photos_;
  mutable unsigned long uses_ = 0;
  size_t most_bytes_ = 0;
  bool is_callers_ = false;
};

}  // namespace insitu
