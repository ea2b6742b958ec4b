// SPDX-License-Identifier: GPL-3.0-or-later
// A render as a stream of text into a pipe, for whoever reads at the other end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "renderer/tiles/render_watcher.h"
#include "renderer/tiles/tile_stream.h"

namespace insitu {

// A reader that is slow gets the newest state when it reads again, one that has gone nothing more;
// the render waits for neither. At its end it is waited for while it reads.
class RenderStream : public RenderWatcher {
 public:
  // `file`: a descriptor of a pipe, socket or file, which stays open. SIGPIPE is ignored from now
  // on.
  RenderStream(int file, StreamCoding coding);
  ~RenderStream() override;

  void Begin(const std::string& name, const Raster& photo) override;
  void Take(const FinishedTile& tile) override;
  void End(bool is_whole) override;

  bool is_closed() const { return is_closed_; }  // by the reader
  int64_t bytes() const { return bytes_; }       // that were written

 private:
  void Run();
  std::string NextText(std::unique_lock<std::mutex>* lock);
  bool Write(const std::string& text);
  bool IsEnded();

  const int file_;
  const StreamCoding coding_;
  std::atomic<bool> is_closed_ = false;
  std::atomic<int64_t> bytes_ = 0;
  std::mutex mutex_;  // of what follows
  std::condition_variable news_;
  std::string head_;  // statements that come before any tile
  std::string tail_;  // and after all
  int width_ = 0, height_ = 0, done_ = 0;
  const Raster* photo_ = nullptr;
  std::map<int, std::vector<uint8_t>> tiles_;  // codes of those that are not sent
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace insitu
