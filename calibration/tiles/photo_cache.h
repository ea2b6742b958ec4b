// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs in memory: each decoded once, those left longest given up.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "calibration/tiles/photo_pyramid.h"

namespace insitu {

// What one decoding yields: a photograph, or its overview.
struct PyramidKey {
  int photo = 0;
  bool is_overview = false;
  bool operator==(const PyramidKey&) const = default;
  bool operator<(const PyramidKey& other) const {
    return std::tie(photo, is_overview) < std::tie(other.photo, other.is_overview);
  }
};

class PhotoCache {
 public:
  explicit PhotoCache(size_t most_bytes) : most_bytes_(most_bytes) {}

  // What `decode` yields, once for all who ask meanwhile; what it throws, all of them get, and the
  // next one tries again. What is in use stays in memory until its last user lets go of it.
  std::shared_ptr<PhotoPyramid> Get(const PyramidKey& key,
                                    const std::function<std::shared_ptr<PhotoPyramid>()>& decode);

 private:
  struct Entry {
    std::shared_future<std::shared_ptr<PhotoPyramid>> pyramid;
    size_t bytes = 0;                            // 0: being decoded
    std::list<PyramidKey>::iterator place = {};  // among used_
  };
  void Keep(const PyramidKey& key, size_t bytes);

  const size_t most_bytes_;
  std::mutex mutex_;
  std::map<PyramidKey, Entry> entries_;
  std::list<PyramidKey> used_;  // the last one first
  size_t bytes_ = 0;
};

}  // namespace insitu
