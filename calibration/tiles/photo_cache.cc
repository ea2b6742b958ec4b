// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_cache.h"

#include <utility>

namespace insitu {

std::shared_ptr<PhotoPyramid> PhotoCache::Get(
    const PyramidKey& key, const std::function<std::shared_ptr<PhotoPyramid>()>& decode) {
  std::unique_lock lock(mutex_);
  if (const auto found = entries_.find(key); found != entries_.end()) {
    used_.splice(used_.begin(), used_, found->second.place);
    const auto pyramid = found->second.pyramid;
    lock.unlock();
    return pyramid.get();
  }
  std::promise<std::shared_ptr<PhotoPyramid>> promise;
  used_.push_front(key);
  entries_[key] = {promise.get_future().share(), 0, used_.begin()};
  lock.unlock();
  try {
    auto pyramid = decode();
    Keep(key, pyramid->bytes());
    promise.set_value(pyramid);
    return pyramid;
  } catch (...) {
    lock.lock();
    const auto entry = entries_.extract(key);
    used_.erase(entry.mapped().place);
    promise.set_exception(std::current_exception());
    throw;
  }
}

// Gives up others, the last one used last, until this one has room.
void PhotoCache::Keep(const PyramidKey& key, size_t bytes) {
  const std::lock_guard lock(mutex_);
  entries_.at(key).bytes = bytes;
  bytes_ += bytes;
  for (auto place = used_.end(); bytes_ > most_bytes_ && place != used_.begin();) {
    --place;
    const auto found = entries_.find(*place);
    if (*place == key || found->second.bytes == 0) continue;
    bytes_ -= found->second.bytes;
    entries_.erase(found);
    place = used_.erase(place);
  }
}

}  // namespace insitu
