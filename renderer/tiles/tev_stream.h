// SPDX-License-Identifier: GPL-3.0-or-later
// A render in the viewer tev, as its tiles come [https://github.com/Tom94/tev, src/Ipc.cpp]:
// packets over TCP, each with its length, little-endian.
#pragma once

#include <string>

#include "renderer/tiles/stream_writer.h"

namespace insitu {

constexpr int kTevPort = 14158;

// CreateImage and the photograph, then UpdateImage (version 3) for each tile: R, G, B, linear.
StreamFormat TevFormat();

// An open connection, closed at its end.
class TevConnection {
 public:
  // `address`: HOST:PORT, or HOST. Throws InputError that names it: not one, or nobody there within
  // three seconds.
  explicit TevConnection(const std::string& address);
  ~TevConnection();
  TevConnection(const TevConnection&) = delete;
  TevConnection& operator=(const TevConnection&) = delete;

  int socket() const { return socket_; }

 private:
  int socket_ = -1;
};

}  // namespace insitu
